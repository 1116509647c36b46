#include "engine/sheet/modified.h"

#include <algorithm>
#include <cmath>

namespace dem::sheet {
namespace {

// A removal that leaves less than this share of a spring's stiffness along it is weakened to leave this share.
constexpr double least_share = 1e-4;
// No removal leaves a pair freer than this many times its spring's own compliance: removals around one loose fragment
// would otherwise each make it 1/least_share softer, without bound.
constexpr double most_compliance = 1e5;

double dot_paths(const PathVector& a, const PathVector& b, const Dissection& d) {
  std::size_t i = 0, j = 0, at = 0, bt = 0;
  double total = 0;
  while (i < a.nodes.size() && j < b.nodes.size()) {
    const auto length = [&](int node) {
      return 2 * static_cast<std::size_t>(d.nodes[static_cast<std::size_t>(node)].own());
    };
    if (a.nodes[i] == b.nodes[j]) {
      const auto n = length(a.nodes[i]);
      total += dot(a.values.data() + at, b.values.data() + bt, n);
      at += n, bt += n, ++i, ++j;
    } else if (a.nodes[i] < b.nodes[j]) {
      at += length(a.nodes[i++]);
    } else {
      bt += length(b.nodes[j++]);
    }
  }
  return total;
}

}  // namespace

int ModifiedFactor::factorise(const BlockMatrix& matrix, PivotRule rule) {
  paths_.clear();
  lower_.clear();
  pivots_.clear();
  weakened_ = 0;
  return factor_.factorise(matrix, rule);
}

int ModifiedFactor::factorise(const BlockMatrix& matrix, std::span<const std::uint8_t> stale, PivotRule rule) {
  paths_.clear();
  lower_.clear();
  pivots_.clear();
  weakened_ = 0;
  return factor_.factorise(matrix, stale, rule);
}

double ModifiedFactor::change(double c, int i, int j, std::array<double, 2> n, std::span<const std::uint8_t> fixed) {
  const Dissection& d = factor_.dissection();
  std::vector<std::pair<int, std::array<double, 2>>> load;
  double sign = 1;
  for (const int p : {i, j}) {
    const auto held = fixed[static_cast<std::size_t>(p)];
    load.push_back(
        {d.position[static_cast<std::size_t>(p)], {(held & 1) ? 0 : sign * n[0], (held & 2) ? 0 : sign * n[1]}});
    sign = -1;
  }
  PathVector y = factor_.forward_path(load);
  const auto m = paths_.size();
  std::vector<double> row(m);
  for (std::size_t k = 0; k < m; ++k) {
    row[k] = dot_paths(paths_[k], y, d);
    for (std::size_t p = 0; p < k; ++p) row[k] -= row[p] * lower_[k][p];
  }
  // row holds L D l; what is left of b^T K^-1 b after the changes so far is the compliance along b.
  double compliance = dot(y.values.data(), y.values.data(), y.values.size());
  for (std::size_t k = 0; k < m; ++k) {
    const double l = row[k] / pivots_[k];
    compliance -= row[k] * l;
    row[k] = l;
  }
  // The pivot of a removal is -(1/|c| - compliance): it vanishes when nothing else holds the pair along b.
  if (c < 0 && 1 + c * compliance < least_share) {
    const double after = std::min(compliance / least_share, most_compliance / -c);
    c = std::min(0.0, 1 / after - 1 / compliance);
    ++weakened_;
  }
  paths_.push_back(std::move(y));
  lower_.push_back(std::move(row));
  pivots_.push_back(1 / c + compliance);  // infinite for one left out: it corrects nothing
  return c;
}

void ModifiedFactor::correct(std::span<float> y) const {
  const Dissection& d = factor_.dissection();
  const auto m = paths_.size();
  std::vector<double> a(m);
  const auto each = [&](const PathVector& path, auto&& visit) {
    std::size_t at = 0;
    for (const int node : path.nodes) {
      const auto& own = d.nodes[static_cast<std::size_t>(node)];
      const auto n = 2 * static_cast<std::size_t>(own.own());
      visit(2 * static_cast<std::size_t>(own.begin), at, n);
      at += n;
    }
  };
  for (std::size_t k = 0; k < m; ++k) {
    double total = 0;
    each(paths_[k], [&](std::size_t to, std::size_t at, std::size_t n) {
      total += dot(paths_[k].values.data() + at, y.data() + to, n);
    });
    for (std::size_t p = 0; p < k; ++p) total -= lower_[k][p] * a[p];
    a[k] = total;
  }
  for (std::size_t k = 0; k < m; ++k) a[k] /= pivots_[k];
  for (std::size_t k = m; k-- > 0;) {
    for (std::size_t p = 0; p < k; ++p) a[p] -= lower_[k][p] * a[k];
  }
  for (std::size_t k = 0; k < m; ++k) {
    each(paths_[k], [&](std::size_t to, std::size_t at, std::size_t n) {
      const float* v = paths_[k].values.data() + at;
      float* out = y.data() + to;
      const auto share = static_cast<float>(a[k]);
      for (std::size_t q = 0; q < n; ++q) out[q] -= share * v[q];
    });
  }
}

void ModifiedFactor::solve(std::span<double> b) {
  const Dissection& d = factor_.dissection();
  const auto nodes = d.nodes.size();
  active_.assign(nodes, 0);
  y_.resize(b.size());
#pragma omp parallel for schedule(static) num_threads(threads_)
  for (std::size_t k = 0; k < nodes; ++k) {
    const auto begin = 2 * static_cast<std::size_t>(d.nodes[k].begin),
               end = 2 * static_cast<std::size_t>(d.nodes[k].end);
    bool loaded = false;
    for (auto i = begin; i < end; ++i) {
      y_[i] = static_cast<float>(b[i]);
      loaded = loaded || b[i] != 0;
    }
    active_[k] = loaded ? 1 : 0;
  }
  for (std::size_t k = 0; k + 1 < nodes; ++k) {
    if (active_[k]) active_[static_cast<std::size_t>(d.nodes[k].parent)] = 1;
  }
  factor_.forward(y_, active_);
  if (!paths_.empty()) correct(y_);
  factor_.backward(y_);
#pragma omp parallel for simd schedule(static) num_threads(threads_)
  for (std::size_t i = 0; i < b.size(); ++i) b[i] = static_cast<double>(y_[i]);
}

}  // namespace dem::sheet
