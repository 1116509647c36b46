#include "engine/sheet/factor.h"

#include <algorithm>

namespace dem::sheet {
namespace {

constexpr int task_particles = 2000;  // subtrees smaller than this (or an eighth of the lattice) are one task
constexpr int small_particles = 100;  // subtrees smaller than this are factorised as one

}  // namespace

Lattice::Line Lattice::line(int row, int direction) const {
  const int start = row * columns;
  if (direction == 0) return {start, start + columns - 1, 1};
  if (row + 1 >= rows) return {start, start, 0};
  const int shift = shifted(row) ? 1 : 0;
  if (direction == 1) return {start, start + columns - shift, columns + shift};
  return {start + 1 - shift, start + columns, columns - 1 + shift};
}

int Lattice::neighbour(int particle, int direction) const {
  const int row = particle / columns;
  const int column = particle % columns;
  const int shift = shifted(row) ? 1 : 0;
  int c = column, r = row;
  switch (direction) {
    case 0:
      c += 1;
      break;
    case 1:
      c += shift, r += 1;
      break;
    case 2:
      c += shift - 1, r += 1;
      break;
    case 3:
      c -= 1;
      break;
    case 4:
      c += shift - 1, r -= 1;
      break;
    default:
      c += shift, r -= 1;
      break;
  }
  if (c < 0 || c >= columns || r < 0 || r >= rows) return -1;
  return r * columns + c;
}

Dissection::Dissection(const Lattice& sheet, int leaf_particles) : lattice(sheet) {
  const auto n = static_cast<std::size_t>(lattice.particles());
  order.reserve(n);
  position.assign(n, -1);
  node_of.reserve(n);
  divide(0, lattice.columns, 0, lattice.rows, leaf_particles);
  panel_offset.resize(nodes.size());
  for (std::size_t k = nodes.size(); k-- > 0;) {
    panel_offset[k] = panel_size;
    panel_size += ThinPanel::lines(2 * nodes[k].own(), 2 * nodes[k].front());
  }
  for (const Node& node : nodes) {
    update_offset.push_back(update_size);
    update_size += 2 * node.boundary.size();
  }
  find_runs();
}

int Dissection::Node::row_of(int at) const {
  if (at < end) return at - begin;
  return own() + static_cast<int>(std::lower_bound(boundary.begin(), boundary.end(), at) - boundary.begin());
}

void Dissection::find_runs() {
  const auto add = [](std::vector<Run>& runs, std::size_t first, int from, int to, bool apart) {
    if (runs.size() > first && !apart && runs.back().from + runs.back().count == from &&
        runs.back().to + runs.back().count == to) {
      ++runs.back().count;
    } else {
      runs.push_back({from, to, 1});
    }
  };
  for (const Node& node : nodes) {
    const std::size_t gathers = gathers_.size(), hand_ups = hand_ups_.size();
    gathers_begin_.push_back(gathers);
    hand_ups_begin_.push_back(hand_ups);
    const Node* parent = node.parent < 0 ? nullptr : &nodes[static_cast<std::size_t>(node.parent)];
    for (int k = 0; k < node.rest(); ++k) {
      const int at = node.boundary[static_cast<std::size_t>(k)];
      add(gathers_, gathers, at, k, false);
      if (parent == nullptr) continue;
      const int row = parent->row_of(at);
      add(hand_ups_, hand_ups, k, row, row == parent->own());
    }
  }
  gathers_begin_.push_back(gathers_.size());
  hand_ups_begin_.push_back(hand_ups_.size());
}

std::span<const Dissection::Run> Dissection::gathered(int node) const {
  const auto k = static_cast<std::size_t>(node);
  return {gathers_.data() + gathers_begin_[k], gathers_.data() + gathers_begin_[k + 1]};
}

std::span<const Dissection::Run> Dissection::handed_up(int node) const {
  const auto k = static_cast<std::size_t>(node);
  return {hand_ups_.data() + hand_ups_begin_[k], hand_ups_.data() + hand_ups_begin_[k + 1]};
}

int Dissection::divide(int c0, int c1, int r0, int r1, int leaf) {
  const int width = c1 - c0, height = r1 - r0;
  Node node;
  node.first = static_cast<int>(nodes.size());
  int own[4] = {c0, c1, r0, r1};
  if (width * height > leaf && std::max(width, height) >= 3) {
    if (width >= height) {
      const int middle = c0 + width / 2;
      node.child[0] = divide(c0, middle, r0, r1, leaf);
      node.child[1] = divide(middle + 1, c1, r0, r1, leaf);
      own[0] = middle, own[1] = middle + 1;
    } else {
      const int middle = r0 + height / 2;
      node.child[0] = divide(c0, c1, r0, middle, leaf);
      node.child[1] = divide(c0, c1, middle + 1, r1, leaf);
      own[2] = middle, own[3] = middle + 1;
    }
  }
  const int index = static_cast<int>(nodes.size());
  node.begin = static_cast<int>(order.size());
  for (int r = own[2]; r < own[3]; ++r) {
    for (int c = own[0]; c < own[1]; ++c) {
      const int particle = r * lattice.columns + c;
      position[static_cast<std::size_t>(particle)] = static_cast<int>(order.size());
      order.push_back(particle);
      node_of.push_back(index);
    }
  }
  node.end = static_cast<int>(order.size());
  for (const int child : node.child) {
    if (child >= 0) nodes[static_cast<std::size_t>(child)].parent = index;
  }
  nodes.push_back(std::move(node));
  if (index + 1 == static_cast<int>(nodes.size()) && width == lattice.columns && height == lattice.rows) {
    // The root is known: every particle has its position, so boundaries can be found from the top down.
    struct Box {
      int node, c0, c1, r0, r1;
    };
    std::vector<Box> stack{{index, c0, c1, r0, r1}};
    while (!stack.empty()) {
      const Box b = stack.back();
      stack.pop_back();
      connect(b.node, b.c0, b.c1, b.r0, b.r1);
      const Node& n = nodes[static_cast<std::size_t>(b.node)];
      if (n.child[0] < 0) continue;
      if (b.c1 - b.c0 >= b.r1 - b.r0) {
        const int middle = b.c0 + (b.c1 - b.c0) / 2;
        stack.push_back({n.child[0], b.c0, middle, b.r0, b.r1});
        stack.push_back({n.child[1], middle + 1, b.c1, b.r0, b.r1});
      } else {
        const int middle = b.r0 + (b.r1 - b.r0) / 2;
        stack.push_back({n.child[0], b.c0, b.c1, b.r0, middle});
        stack.push_back({n.child[1], b.c0, b.c1, middle + 1, b.r1});
      }
    }
  }
  return index;
}

void Dissection::connect(int index, int c0, int c1, int r0, int r1) {
  Node& node = nodes[static_cast<std::size_t>(index)];
  const auto inside = [&](int particle) {
    const int r = particle / lattice.columns, c = particle % lattice.columns;
    return c >= c0 && c < c1 && r >= r0 && r < r1;
  };
  const auto visit = [&](int c, int r) {
    if (c < 0 || c >= lattice.columns || r < 0 || r >= lattice.rows) return;
    const int particle = r * lattice.columns + c;
    for (int d = 0; d < 6; ++d) {
      const int other = lattice.neighbour(particle, d);
      if (other >= 0 && inside(other)) {
        node.boundary.push_back(position[static_cast<std::size_t>(particle)]);
        return;
      }
    }
  };
  for (int c = c0 - 1; c <= c1; ++c) visit(c, r0 - 1), visit(c, r1);
  for (int r = r0; r < r1; ++r) visit(c0 - 1, r), visit(c1, r);
  std::sort(node.boundary.begin(), node.boundary.end());

  const int n = lattice.particles();
  for (int at = node.begin; at < node.end; ++at) {
    const int particle = order[static_cast<std::size_t>(at)];
    for (int d = 0; d < 6; ++d) {
      const int other = lattice.neighbour(particle, d);
      if (other < 0 || position[static_cast<std::size_t>(other)] <= at) continue;
      const int slot = d < 3 ? d * n + particle : (d - 3) * n + other;
      node.entries.push_back({slot, node.row_of(position[static_cast<std::size_t>(other)]), at - node.begin});
    }
  }
}

Factor::Factor(const Dissection& dissection, int threads, Again again)
    : dissection_(&dissection),
      threads_(threads),
      again_(again),
      panels_(dissection.panel_size),
      schur_(dissection.nodes.size()),
      updates_(dissection.update_size) {}

int Factor::subtree(int index) const {
  const auto& node = dissection_->nodes[static_cast<std::size_t>(index)];
  return node.end - dissection_->nodes[static_cast<std::size_t>(node.first)].begin;
}

bool Factor::small(int index) const { return subtree(index) <= small_particles; }

ThinPanel Factor::panel(int index) {
  const auto& node = dissection_->nodes[static_cast<std::size_t>(index)];
  return {panels_.data() + dissection_->panel_offset[static_cast<std::size_t>(index)], 2 * node.own(),
          2 * node.front()};
}

void Factor::eliminate(int index, Job& job) {
  const Dissection& d = *dissection_;
  const auto& node = d.nodes[static_cast<std::size_t>(index)];
  const BlockMatrix& matrix = job.matrix;
  const int ns = 2 * node.own();
  const int nf = 2 * node.front();
  std::vector<float> columns(Panel<float>::size(ns, nf));
  const Panel<float> panel{columns.data(), ns, nf};
  auto& schur = schur_[static_cast<std::size_t>(index)];
  schur.assign(Packed<float>::size(2 * node.rest()), 0.0F);
  const Packed<float> rest{schur.data(), 2 * node.rest()};
  std::vector<float> diagonal(static_cast<std::size_t>(ns));
  const auto fixed = [&](int row) {
    const int position =
        row < node.own() ? node.begin + row : node.boundary[static_cast<std::size_t>(row - node.own())];
    return matrix.fixed[static_cast<std::size_t>(d.order[static_cast<std::size_t>(position)])];
  };
  for (int p = 0; p < node.own(); ++p) {
    const auto particle = static_cast<std::size_t>(d.order[static_cast<std::size_t>(node.begin + p)]);
    const Block& b = matrix.diagonal[particle];
    const std::uint8_t held = matrix.fixed[particle];
    float* x = panel.column(2 * p) + 2 * p;
    float* y = panel.column(2 * p + 1) + 2 * p + 1;
    x[0] = (held & 1) ? 1.0F : static_cast<float>(b[0]);
    x[1] = held ? 0.0F : static_cast<float>(b[1]);
    y[0] = (held & 2) ? 1.0F : static_cast<float>(b[2]);
    diagonal[static_cast<std::size_t>(2 * p)] = x[0];
    diagonal[static_cast<std::size_t>(2 * p + 1)] = y[0];
  }
  for (const auto& e : node.entries) {
    const Block& b = matrix.coupling[static_cast<std::size_t>(e.coupling)];
    const std::uint8_t hr = fixed(e.row), hc = fixed(e.column);
    const double rx = (hr & 1) ? 0 : 1, ry = (hr & 2) ? 0 : 1, cx = (hc & 1) ? 0 : 1, cy = (hc & 2) ? 0 : 1;
    float* x = panel.column(2 * e.column) + 2 * e.row;
    float* y = panel.column(2 * e.column + 1) + 2 * e.row;
    x[0] = static_cast<float>(rx * cx * b[0]);
    y[0] = static_cast<float>(rx * cy * b[1]);
    x[1] = static_cast<float>(ry * cx * b[1]);
    y[1] = static_cast<float>(ry * cy * b[2]);
  }
  for (const int c : node.child) {
    if (c < 0) continue;
    const auto& child = d.nodes[static_cast<std::size_t>(c)];
    auto& update = schur_[static_cast<std::size_t>(c)];
    const Packed<float> from{update.data(), 2 * child.rest()};
    const auto runs = d.handed_up(c);
    for (std::size_t run = 0; run < runs.size(); ++run) {
      for (int j = 2 * runs[run].from; j < 2 * (runs[run].from + runs[run].count); ++j) {
        const float* in = from.column(j);
        const int column = j + 2 * (runs[run].to - runs[run].from);
        float* out = column < ns ? panel.column(column) : rest.column(column - ns) - ns;
        for (std::size_t r = run; r < runs.size(); ++r) {
          const int shift = 2 * (runs[r].to - runs[r].from), end = 2 * (runs[r].from + runs[r].count);
#pragma GCC ivdep
          for (int i = std::max(j, 2 * runs[r].from); i < end; ++i) out[i + shift] += in[i];
        }
      }
    }
    if (again_ == Again::whole || small(index)) std::vector<float>().swap(update);
  }
  job.raised[static_cast<std::size_t>(index)] = partial_cholesky(panel, rest, diagonal, job.rule);
  compress({panel.data, ns, nf}, this->panel(index));
}

void Factor::visit(int index, Job& job) {
  const auto& node = dissection_->nodes[static_cast<std::size_t>(index)];
  if (!job.stale[static_cast<std::size_t>(index)]) return;
  if (small(index)) {
    for (int i = node.first; i <= index; ++i) eliminate(i, job);
    return;
  }
  const bool task = subtree(index) > std::min(task_particles, dissection_->lattice.particles() / 8);
#pragma omp task if (task) default(shared)
  visit(node.child[0], job);
  visit(node.child[1], job);
#pragma omp taskwait
  eliminate(index, job);
}

void Factor::close(std::vector<std::uint8_t>& stale) const {
  for (std::size_t k = 0; k + 1 < stale.size(); ++k) {
    if (stale[k]) stale[static_cast<std::size_t>(dissection_->nodes[k].parent)] = 1;
  }
  for (std::size_t k = stale.size() - 1; k-- > 0;) {
    const int parent = dissection_->nodes[k].parent;
    if (small(parent) && stale[static_cast<std::size_t>(parent)]) stale[k] = 1;
  }
}

double Factor::operations(std::span<const std::uint8_t> stale) const {
  double total = 0;
  for (std::size_t k = 0; k < stale.size(); ++k) {
    if (!stale[k]) continue;
    const double s = 2 * dissection_->nodes[k].own(), m = 2 * dissection_->nodes[k].rest();
    total += s * s * s / 3 + s * s * m + s * m * m;
  }
  return total;
}

int Factor::factorise(const BlockMatrix& matrix, PivotRule rule) {
  return factorise(matrix, std::vector<std::uint8_t>(dissection_->nodes.size(), 1), rule);
}

int Factor::factorise(const BlockMatrix& matrix, std::span<const std::uint8_t> stale, PivotRule rule) {
  const auto count = dissection_->nodes.size();
  Job job{matrix, stale, rule, std::vector<int>(count, 0)};
#pragma omp parallel num_threads(threads_)
#pragma omp single
  visit(static_cast<int>(count) - 1, job);
  int total = 0;
  for (const int r : job.raised) total += r;
  return total;
}

// What children hand up, then the sweep over the node's own; what is left is handed on.
void Factor::hand_up(int index, const ThinPanel& panel, std::span<const int> children, std::vector<float>& t) {
  const Dissection& d = *dissection_;
  const auto& node = d.nodes[static_cast<std::size_t>(index)];
  const int pad = panel.own() - panel.ns;
  for (const int c : children) {
    const float* updates = updates_.data() + d.update_offset[static_cast<std::size_t>(c)];
    for (const Dissection::Run& run : d.handed_up(c)) {
      const float* in = updates + 2 * run.from;
      float* out = t.data() + 2 * run.to + (run.to < node.own() ? 0 : pad);
#pragma GCC ivdep
      for (int k = 0; k < 2 * run.count; ++k) out[k] += in[k];
    }
  }
  panel_forward(panel, t.data());
  const auto rest = t.begin() + panel.own();
  std::copy(rest, rest + 2 * node.rest(), updates_.data() + d.update_offset[static_cast<std::size_t>(index)]);
}

void Factor::forward_node(int index, float* y, const std::uint8_t* active, std::vector<float>& t) {
  const auto& node = dissection_->nodes[static_cast<std::size_t>(index)];
  const ThinPanel panel = this->panel(index);
  t.assign(panel.vector(), 0.0F);
  float* own = y + 2 * node.begin;
  std::copy(own, own + panel.ns, t.begin());
  int children[2], count = 0;
  for (const int c : node.child) {
    if (c >= 0 && active[c]) children[count++] = c;
  }
  hand_up(index, panel, std::span(children, static_cast<std::size_t>(count)), t);
  std::copy(t.begin(), t.begin() + panel.ns, own);
}

void Factor::visit_up(int index, float* y, const std::uint8_t* active) {
  const auto& d = *dissection_;
  const auto& node = d.nodes[static_cast<std::size_t>(index)];
  if (!active[index]) return;
  if (node.end - d.nodes[static_cast<std::size_t>(node.first)].begin <= task_particles) {
    std::vector<float> t;
    for (int i = node.first; i <= index; ++i) {
      if (active[i]) forward_node(i, y, active, t);
    }
    return;
  }
#pragma omp task default(shared)
  visit_up(node.child[0], y, active);
  visit_up(node.child[1], y, active);
#pragma omp taskwait
  std::vector<float> t;
  forward_node(index, y, active, t);
}

void Factor::forward(std::span<float> y, std::span<const std::uint8_t> active) {
#pragma omp parallel num_threads(threads_)
#pragma omp single
  visit_up(static_cast<int>(dissection_->nodes.size()) - 1, y.data(), active.data());
}

void Factor::backward_node(int index, float* x, std::vector<float>& t) {
  const auto& node = dissection_->nodes[static_cast<std::size_t>(index)];
  const ThinPanel panel = this->panel(index);
  if (t.size() < panel.vector()) t.resize(panel.vector());
  float* own = x + 2 * node.begin;
  std::copy(own, own + panel.ns, t.begin());
  std::fill(t.begin() + panel.ns, t.begin() + panel.own(), 0.0F);
  float* rest = t.data() + panel.own();
  for (const Dissection::Run& run : dissection_->gathered(index)) {
    std::copy_n(x + 2 * run.from, 2 * run.count, rest + 2 * run.to);
  }
  std::fill(rest + 2 * node.rest(), t.data() + panel.vector(), 0.0F);
  panel_backward(panel, t.data());
  std::copy(t.begin(), t.begin() + panel.ns, own);
}

void Factor::visit_down(int index, float* x) {
  const auto& d = *dissection_;
  const auto& node = d.nodes[static_cast<std::size_t>(index)];
  if (node.end - d.nodes[static_cast<std::size_t>(node.first)].begin <= task_particles) {
    std::vector<float> t;
    for (int i = index; i >= node.first; --i) backward_node(i, x, t);
    return;
  }
  std::vector<float> t;
  backward_node(index, x, t);
#pragma omp task default(shared)
  visit_down(node.child[0], x);
  visit_down(node.child[1], x);
#pragma omp taskwait
}

void Factor::backward(std::span<float> x) {
#pragma omp parallel num_threads(threads_)
#pragma omp single
  visit_down(static_cast<int>(dissection_->nodes.size()) - 1, x.data());
}

PathVector Factor::forward_path(std::span<const std::pair<int, std::array<double, 2>>> load) {
  const Dissection& d = *dissection_;
  PathVector path;
  for (const auto& [position, force] : load) {
    for (int n = d.node_of[static_cast<std::size_t>(position)]; n >= 0;
         n = d.nodes[static_cast<std::size_t>(n)].parent) {
      path.nodes.push_back(n);
    }
  }
  std::sort(path.nodes.begin(), path.nodes.end());
  path.nodes.erase(std::unique(path.nodes.begin(), path.nodes.end()), path.nodes.end());
  std::vector<float> t;
  for (const int index : path.nodes) {
    const auto& node = d.nodes[static_cast<std::size_t>(index)];
    const ThinPanel panel = this->panel(index);
    t.assign(panel.vector(), 0.0F);
    for (const auto& [position, force] : load) {
      if (position < node.begin || position >= node.end) continue;
      const auto row = static_cast<std::size_t>(2 * (position - node.begin));
      t[row] += static_cast<float>(force[0]);
      t[row + 1] += static_cast<float>(force[1]);
    }
    int children[2], count = 0;
    for (const int c : node.child) {
      if (c >= 0 && std::binary_search(path.nodes.begin(), path.nodes.end(), c)) children[count++] = c;
    }
    hand_up(index, panel, std::span(children, static_cast<std::size_t>(count)), t);
    path.values.insert(path.values.end(), t.begin(), t.begin() + panel.ns);
  }
  return path;
}

}  // namespace dem::sheet
