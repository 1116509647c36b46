#include "engine/sheet/factor.h"

#include <algorithm>

namespace dem::sheet {
namespace {

constexpr int task_particles = 2000;  // subtrees smaller than this are one task

}  // namespace

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
  std::size_t panel = 0, update = 0;
  for (const Node& node : nodes) {
    panel_offset.push_back(panel);
    update_offset.push_back(update);
    // Odd multiples of eight rows: columns start on different cache sets.
    const int rows = (2 * node.front() + 7) / 8;
    leading.push_back(8 * (rows | 1));
    panel += static_cast<std::size_t>(leading.back()) * static_cast<std::size_t>(2 * node.own());
    update += 2 * node.boundary.size();
  }
  panel_offset.push_back(panel);
  update_offset.push_back(update);
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

  const auto row_of = [](const Node& n, int at) {
    if (at < n.end) return at - n.begin;
    const auto found = std::lower_bound(n.boundary.begin(), n.boundary.end(), at);
    return n.own() + static_cast<int>(found - n.boundary.begin());
  };
  if (node.parent >= 0) {
    const Node& parent = nodes[static_cast<std::size_t>(node.parent)];  // connected before its children
    for (const int at : node.boundary) node.place_in_parent.push_back(row_of(parent, at));
  }
  const int n = lattice.particles();
  for (int at = node.begin; at < node.end; ++at) {
    const int particle = order[static_cast<std::size_t>(at)];
    for (int d = 0; d < 6; ++d) {
      const int other = lattice.neighbour(particle, d);
      if (other < 0 || position[static_cast<std::size_t>(other)] <= at) continue;
      const int slot = d < 3 ? d * n + particle : (d - 3) * n + other;
      node.entries.push_back({slot, row_of(node, position[static_cast<std::size_t>(other)]), at - node.begin});
    }
  }
}

Factor::Factor(const Dissection& dissection, int threads)
    : dissection_(&dissection),
      threads_(threads),
      panels_(dissection.panel_offset.back()),
      inverse_(2 * dissection.order.size()),
      updates_(dissection.update_offset.back()) {}

void Factor::eliminate(int index, const BlockMatrix& matrix, PivotRule rule, std::vector<std::vector<double>>& updates,
                       std::vector<int>& raised) {
  const Dissection& d = *dissection_;
  const auto& node = d.nodes[static_cast<std::size_t>(index)];
  if (node.child[0] >= 0) {
    const bool task = node.end - d.nodes[static_cast<std::size_t>(node.first)].begin > task_particles;
#pragma omp task if (task) default(shared)
    eliminate(node.child[0], matrix, rule, updates, raised);
    eliminate(node.child[1], matrix, rule, updates, raised);
#pragma omp taskwait
  }
  const int ns = 2 * node.own(), nf = 2 * node.front();
  const auto ld = static_cast<std::size_t>(d.leading[static_cast<std::size_t>(index)]);
  std::vector<double> front(ld * static_cast<std::size_t>(nf), 0.0);
  const auto at = [&](int row, int column) -> double& {
    return front[static_cast<std::size_t>(column) * ld + static_cast<std::size_t>(row)];
  };
  std::vector<double> diagonal(static_cast<std::size_t>(ns));
  const auto fixed = [&](int row) {
    const int position =
        row < node.own() ? node.begin + row : node.boundary[static_cast<std::size_t>(row - node.own())];
    return matrix.fixed[static_cast<std::size_t>(d.order[static_cast<std::size_t>(position)])];
  };
  for (int p = 0; p < node.own(); ++p) {
    const auto particle = static_cast<std::size_t>(d.order[static_cast<std::size_t>(node.begin + p)]);
    const Block& b = matrix.diagonal[particle];
    const std::uint8_t held = matrix.fixed[particle];
    at(2 * p, 2 * p) = (held & 1) ? 1.0 : b[0];
    at(2 * p + 1, 2 * p + 1) = (held & 2) ? 1.0 : b[2];
    at(2 * p + 1, 2 * p) = held ? 0.0 : b[1];
    diagonal[static_cast<std::size_t>(2 * p)] = at(2 * p, 2 * p);
    diagonal[static_cast<std::size_t>(2 * p + 1)] = at(2 * p + 1, 2 * p + 1);
  }
  for (const auto& e : node.entries) {
    const Block& b = matrix.coupling[static_cast<std::size_t>(e.coupling)];
    const std::uint8_t hr = fixed(e.row), hc = fixed(e.column);
    const double rx = (hr & 1) ? 0 : 1, ry = (hr & 2) ? 0 : 1, cx = (hc & 1) ? 0 : 1, cy = (hc & 2) ? 0 : 1;
    at(2 * e.row, 2 * e.column) = rx * cx * b[0];
    at(2 * e.row, 2 * e.column + 1) = rx * cy * b[1];
    at(2 * e.row + 1, 2 * e.column) = ry * cx * b[1];
    at(2 * e.row + 1, 2 * e.column + 1) = ry * cy * b[2];
  }
  for (const int c : node.child) {
    if (c < 0) continue;
    const auto& child = d.nodes[static_cast<std::size_t>(c)];
    auto& update = updates[static_cast<std::size_t>(c)];
    const auto m = 2 * child.boundary.size();
    for (std::size_t j = 0; j < m; ++j) {
      const int column = 2 * child.place_in_parent[j / 2] + static_cast<int>(j % 2);
      const double* in = update.data() + j * m;
      double* out = front.data() + static_cast<std::size_t>(column) * ld;
      for (std::size_t i = j; i < m; ++i) out[2 * child.place_in_parent[i / 2] + static_cast<int>(i % 2)] += in[i];
    }
    std::vector<double>().swap(update);
  }
  raised[static_cast<std::size_t>(index)] = partial_cholesky(front.data(), ld, ns, nf, diagonal, rule);
  float* panel = panels_.data() + d.panel_offset[static_cast<std::size_t>(index)];
  for (int j = 0; j < ns; ++j) {
    const double* in = front.data() + static_cast<std::size_t>(j) * ld;
    for (int i = j; i < nf; ++i)
      panel[static_cast<std::size_t>(j) * ld + static_cast<std::size_t>(i)] = static_cast<float>(in[i]);
    inverse_[static_cast<std::size_t>(2 * node.begin + j)] = 1.0 / in[j];
  }
  const auto m = static_cast<std::size_t>(nf - ns);
  auto& update = updates[static_cast<std::size_t>(index)];
  update.resize(m * m);
  for (std::size_t j = 0; j < m; ++j) {
    const double* in = front.data() + (static_cast<std::size_t>(ns) + j) * ld + static_cast<std::size_t>(ns);
    std::copy(in + j, in + m, update.data() + j * m + j);
  }
}

int Factor::factorise(const BlockMatrix& matrix, PivotRule rule) {
  const auto count = dissection_->nodes.size();
  std::vector<std::vector<double>> updates(count);
  std::vector<int> raised(count, 0);
#pragma omp parallel num_threads(threads_)
#pragma omp single
  eliminate(static_cast<int>(count) - 1, matrix, rule, updates, raised);
  int total = 0;
  for (const int r : raised) total += r;
  return total;
}

void Factor::forward_node(int index, double* y, const std::uint8_t* active, std::vector<double>& t) {
  const Dissection& d = *dissection_;
  const auto& node = d.nodes[static_cast<std::size_t>(index)];
  const int ns = 2 * node.own(), nf = 2 * node.front();
  t.assign(static_cast<std::size_t>(nf), 0.0);
  double* own = y + 2 * node.begin;
  std::copy(own, own + ns, t.begin());
  for (const int c : node.child) {
    if (c < 0 || !active[c]) continue;
    const auto& child = d.nodes[static_cast<std::size_t>(c)];
    const double* in = updates_.data() + d.update_offset[static_cast<std::size_t>(c)];
    for (std::size_t k = 0; k < child.boundary.size(); ++k) {
      const auto row = 2 * static_cast<std::size_t>(child.place_in_parent[k]);
      t[row] += in[2 * k];
      t[row + 1] += in[2 * k + 1];
    }
  }
  const auto ld = static_cast<std::size_t>(d.leading[static_cast<std::size_t>(index)]);
  panel_forward(panels_.data() + d.panel_offset[static_cast<std::size_t>(index)], ld, ns, nf,
                inverse_.data() + 2 * node.begin, t.data());
  std::copy(t.begin(), t.begin() + ns, own);
  std::copy(t.begin() + ns, t.end(), updates_.data() + d.update_offset[static_cast<std::size_t>(index)]);
}

void Factor::visit_up(int index, double* y, const std::uint8_t* active) {
  const auto& d = *dissection_;
  const auto& node = d.nodes[static_cast<std::size_t>(index)];
  if (!active[index]) return;
  if (node.end - d.nodes[static_cast<std::size_t>(node.first)].begin <= task_particles) {
    std::vector<double> t;
    for (int i = node.first; i <= index; ++i) {
      if (active[i]) forward_node(i, y, active, t);
    }
    return;
  }
#pragma omp task default(shared)
  visit_up(node.child[0], y, active);
  visit_up(node.child[1], y, active);
#pragma omp taskwait
  std::vector<double> t;
  forward_node(index, y, active, t);
}

void Factor::forward(std::span<double> y, std::span<const std::uint8_t> active) {
#pragma omp parallel num_threads(threads_)
#pragma omp single
  visit_up(static_cast<int>(dissection_->nodes.size()) - 1, y.data(), active.data());
}

void Factor::backward_node(int index, double* x, std::vector<double>& t) {
  const Dissection& d = *dissection_;
  const auto& node = d.nodes[static_cast<std::size_t>(index)];
  const int ns = 2 * node.own(), nf = 2 * node.front();
  t.resize(static_cast<std::size_t>(nf));
  double* own = x + 2 * node.begin;
  std::copy(own, own + ns, t.begin());
  for (std::size_t k = 0; k < node.boundary.size(); ++k) {
    const double* in = x + 2 * node.boundary[k];
    t[static_cast<std::size_t>(ns) + 2 * k] = in[0];
    t[static_cast<std::size_t>(ns) + 2 * k + 1] = in[1];
  }
  const auto ld = static_cast<std::size_t>(d.leading[static_cast<std::size_t>(index)]);
  panel_backward(panels_.data() + d.panel_offset[static_cast<std::size_t>(index)], ld, ns, nf,
                 inverse_.data() + 2 * node.begin, t.data());
  std::copy(t.begin(), t.begin() + ns, own);
}

void Factor::visit_down(int index, double* x) {
  const auto& d = *dissection_;
  const auto& node = d.nodes[static_cast<std::size_t>(index)];
  if (node.end - d.nodes[static_cast<std::size_t>(node.first)].begin <= task_particles) {
    std::vector<double> t;
    for (int i = index; i >= node.first; --i) backward_node(i, x, t);
    return;
  }
  std::vector<double> t;
  backward_node(index, x, t);
#pragma omp task default(shared)
  visit_down(node.child[0], x);
  visit_down(node.child[1], x);
#pragma omp taskwait
}

void Factor::backward(std::span<double> x) {
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
  std::vector<double> t;
  for (const int index : path.nodes) {
    const auto& node = d.nodes[static_cast<std::size_t>(index)];
    const int ns = 2 * node.own(), nf = 2 * node.front();
    t.assign(static_cast<std::size_t>(nf), 0.0);
    for (const auto& [position, force] : load) {
      if (position < node.begin || position >= node.end) continue;
      t[static_cast<std::size_t>(2 * (position - node.begin))] += force[0];
      t[static_cast<std::size_t>(2 * (position - node.begin) + 1)] += force[1];
    }
    for (const int c : node.child) {
      if (c < 0 || !std::binary_search(path.nodes.begin(), path.nodes.end(), c)) continue;
      const auto& child = d.nodes[static_cast<std::size_t>(c)];
      const double* in = updates_.data() + d.update_offset[static_cast<std::size_t>(c)];
      for (std::size_t k = 0; k < child.boundary.size(); ++k) {
        const auto row = 2 * static_cast<std::size_t>(child.place_in_parent[k]);
        t[row] += in[2 * k];
        t[row + 1] += in[2 * k + 1];
      }
    }
    const auto ld = static_cast<std::size_t>(d.leading[static_cast<std::size_t>(index)]);
    panel_forward(panels_.data() + d.panel_offset[static_cast<std::size_t>(index)], ld, ns, nf,
                  inverse_.data() + 2 * node.begin, t.data());
    path.values.insert(path.values.end(), t.begin(), t.begin() + ns);
    std::copy(t.begin() + ns, t.end(), updates_.data() + d.update_offset[static_cast<std::size_t>(index)]);
  }
  return path;
}

}  // namespace dem::sheet
