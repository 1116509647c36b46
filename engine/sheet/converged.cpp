#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>

#include "engine/core/errors.h"
#include "engine/sheet/dense.h"
#include "engine/sheet/patch.h"
#include "engine/sheet/solver.h"
#include "engine/sheet/stiffness.h"

namespace dem::sheet {
namespace {

constexpr int usual_solves = 2;  // of a relaxation with a good factor
// A part of the factor is made anew when solves beyond the usual ones have cost what that is likely to cost.
constexpr double least_worth = 1, operations_a_solve = 6e8;
constexpr double gross_change = 0.05;     // of a spring's stiffness: the factor follows wherever that is
constexpr double slight_change = 0.0005;  // the factor follows where it was seen to fall short
constexpr double least_heat = 0.01;       // share of the unbalanced force that a solve left there
constexpr int tile = 16;                  // particles a side of the squares in which that is noted
// Springs in patches that turned since the factor was made are changes to it, where a step left more than a share.
constexpr double turned_change = 0.03, turned_share = 0.02;  // of a spring's stiffness; of the unbalanced force
constexpr std::size_t most_turned = 20;                      // of them at a time
constexpr double least_change = 1e-3;  // of a spring's stiffness along an axis: less is left to the next factor
constexpr int most_changes = 300;      // rank beyond which corrections cost more than a new factor
constexpr int most_weakened = 8;       // removals that left a pair unheld, before a new factor
// Patches are laid around what is unbalanced by a share of the largest unbalanced force: all of it, or else none;
// after a step that left much, around the worst of it.
constexpr double peak_share = 0.02, worst_share = 0.05, much = 0.1;
constexpr std::size_t most_hot = 2000, most_patches = 3, most_worst = 6;
// A direction of conjugate gradients is solved to this share of its load: roughly while steps gain little.
constexpr double finest = 0.02, roughest = 0.4;
constexpr double slight_load = 1e-4;  // of the largest unbalanced force: what waits for a later step
constexpr double longest_step = 0.2;  // of a particle radius, in one step
// A relaxation that has not ended after so many solves, and again after as many more, lets its worst places settle.
constexpr int first_settling = 200, next_settling = 200;

}  // namespace

struct ConvergedSolver::Impl {
  ConvergedSettings settings;
  Dissection dissection;
  ModifiedFactor factor;
  bool factorised = false;
  SolverWork done;
  BlockMatrix matrix;                           // what the factor holds but for the changes
  std::vector<ConvergedState::Change> changes;  // since the last factorisation
  std::map<int, Block> changed;                 // by slot: what the factor holds of those that changed since
  double extra_solves = 0;                      // counted towards the next one
  bool load_moved = false;                      // since the last whole one
  std::vector<std::uint8_t> held;               // of each slot: whether the factor has it, changes included
  std::vector<double> heat;         // of each tile: the largest share of the unbalanced force that a solve left there
  std::vector<int> node_of_slot;    // where the tree holds each
  std::vector<std::uint8_t> stale;  // of each node of the tree
  std::vector<int> watched;         // slots that are not joined
  std::vector<int> pressed;         // those of them that the last step of this relaxation left in contact
  double worth = 0;                 // solves that cost as much as the last factorisation
  Patches patches;
  std::vector<double> u;  // load, then displacement, in elimination order
  TangentOperator operator_of_state;
  struct Directions {
    std::vector<double> r, p, z, vx, vy, wx, wy;
  } directions;  // of conjugate gradients: kept, for their memory costs more than their numbers

  Impl(const Sheet& sheet, ConvergedSettings s)
      : settings(s),
        dissection(sheet.lattice),
        factor(dissection, s.threads, Factor::Again::parts),
        patches(s.threads),
        operator_of_state(s.threads) {
    u.assign(2 * static_cast<std::size_t>(sheet.particles()), 0.0);
    heat.assign(static_cast<std::size_t>(tiles_across() * tiles_up()), 0.0);
    node_of_slot = nodes_of_slots(sheet);
  }

  // The node that eliminates the first of a slot's particles: it holds the coupling, and what it changes reaches the
  // other particle's node, further up.
  std::vector<int> nodes_of_slots(const Sheet& sheet) const {
    std::vector<int> nodes(static_cast<std::size_t>(sheet.slots()), 0);
    const auto at = [&](int particle) { return dissection.position[static_cast<std::size_t>(particle)]; };
    for (int slot = 0; slot < sheet.slots(); ++slot) {
      const auto k = static_cast<std::size_t>(slot);
      if (sheet.stiffness[k] <= 0) continue;
      nodes[k] = dissection.node_of[static_cast<std::size_t>(std::min(at(sheet.first(slot)), at(sheet.second(slot))))];
    }
    return nodes;
  }

  int tiles_across() const { return (dissection.lattice.columns + tile - 1) / tile; }
  int tiles_up() const { return (dissection.lattice.rows + tile - 1) / tile; }

  // Notes where a solve left unbalanced forces: there the factor is out of date. `before` it, the largest was so much.
  void warm(const Sheet& sheet, const Forces& forces, double before) {
    const int columns = sheet.lattice.columns, across = tiles_across();
#pragma omp parallel for schedule(static) num_threads(settings.threads)
    for (int t = 0; t < tiles_up(); ++t) {
      for (int r = t * tile; r < std::min(sheet.lattice.rows, (t + 1) * tile); ++r) {
        for (int c = 0; c < columns; ++c) {
          const double share = open(sheet, forces, static_cast<std::size_t>(r * columns + c)) / before;
          double& most = heat[static_cast<std::size_t>(t * across + c / tile)];
          most = share > most ? share : most;
        }
      }
    }
  }

  // For each tile, whether it or one next to it is one where the factor falls short.
  std::vector<std::uint8_t> hot_tiles() const {
    const int across = tiles_across(), up = tiles_up();
    std::vector<std::uint8_t> hot(heat.size(), 0);
    for (int t = 0; t < across * up; ++t) {
      if (heat[static_cast<std::size_t>(t)] < least_heat) continue;
      for (int y = std::max(0, t / across - 1); y <= std::min(up - 1, t / across + 1); ++y) {
        for (int x = std::max(0, t % across - 1); x <= std::min(across - 1, t % across + 1); ++x) {
          hot[static_cast<std::size_t>(y * across + x)] = 1;
        }
      }
    }
    return hot;
  }

  enum class Extent { part, whole };

  // Makes the factor follow the tangent everywhere, or where that has changed and matters: the tree above such places
  // is factorised anew, the rest keeps what it held. A factor serves as a preconditioner only.
  int follow_tangent(const Sheet& sheet, const Forces& forces, Tangent tangent, Extent extent) {
    const auto slots = static_cast<std::size_t>(sheet.slots());
    matrix.fixed = sheet.fixed;
    matrix.coupling.resize(slots, {0, 0, 0});
    matrix.diagonal.resize(sheet.x.size());
    std::vector<Block> now(slots);
    stale.assign(dissection.nodes.size(), extent == Extent::whole || !factorised ? 1 : 0);
#pragma omp parallel for schedule(static) num_threads(settings.threads)
    for (int slot = 0; slot < sheet.slots(); ++slot) {
      const auto k = static_cast<std::size_t>(slot);
      if (sheet.stiffness[k] <= 0) continue;
      const Block b = tangent_block(sheet, forces, slot, tangent);
      now[k] = {-b[0], -b[1], -b[2]};
    }
    const std::vector<std::uint8_t> hot = hot_tiles();
    for (int slot = 0; extent == Extent::part && slot < sheet.slots(); ++slot) {
      const auto k = static_cast<std::size_t>(slot);
      const double most = farthest(now[k], matrix.coupling[k]);
      if (most <= slight_change * sheet.stiffness[k]) continue;
      const int i = sheet.first(slot), columns = sheet.lattice.columns;
      const bool here = hot[static_cast<std::size_t>(i / columns / tile * tiles_across() + i % columns / tile)] != 0;
      if (here || most > gross_change * sheet.stiffness[k]) stale[static_cast<std::size_t>(node_of_slot[k])] = 1;
    }
    factor.factor().close(stale);
#pragma omp parallel for schedule(static) num_threads(settings.threads)
    for (std::size_t k = 0; k < slots; ++k) {
      if (sheet.stiffness[k] > 0 && stale[static_cast<std::size_t>(node_of_slot[k])]) matrix.coupling[k] = now[k];
    }
#pragma omp parallel for schedule(static) num_threads(settings.threads)
    for (std::size_t at = 0; at < dissection.order.size(); ++at) {
      if (!stale[static_cast<std::size_t>(dissection.node_of[at])]) continue;
      const int particle = dissection.order[at];
      matrix.diagonal[static_cast<std::size_t>(particle)] = diagonal_of(sheet, matrix, particle);
    }
    return factor.factorise(matrix, stale);
  }

  void factorise(const Sheet& sheet, const Forces& forces, Extent extent) {
    // A tangent that has lost its stiffness somewhere (pivots would be raised over and over, and grow without bound)
    // gives way to the stable one: its steps still go down in energy, to the equilibrium beyond.
    if (const int negative = follow_tangent(sheet, forces, Tangent::exact, extent); negative > 0) {
      done.negative_pivots += negative;
      follow_tangent(sheet, forces, Tangent::stable, Extent::whole);
    }
    ++done.factorisations;
    worth = factor.factor().operations(stale) / operations_a_solve;
    factorised = true;
    hold(sheet);
    changes.clear();
    changed.clear();
    extra_solves = 0;
    std::fill(heat.begin(), heat.end(), 0.0);
    if (extent == Extent::whole) load_moved = false;
  }

  void hold(const Sheet& sheet) {
    held.assign(static_cast<std::size_t>(sheet.slots()), 0);
    watched.clear();
    for (int slot = 0; slot < sheet.slots(); ++slot) {
      const auto k = static_cast<std::size_t>(slot);
      if (sheet.stiffness[k] <= 0) continue;
      held[k] = matrix.coupling[k] == Block{0, 0, 0} ? 0 : 1;
      if (!sheet.joined[k]) watched.push_back(slot);
    }
  }

  void change(const Sheet& sheet, const ConvergedState::Change& c) {
    held[static_cast<std::size_t>(c.slot)] = c.active ? 1 : 0;
    Block b = holds(c.slot);
    const double made =
        factor.change(c.coefficient, sheet.first(c.slot), sheet.second(c.slot), {c.nx, c.ny}, sheet.fixed);
    b[0] += made * c.nx * c.nx, b[1] += made * c.nx * c.ny, b[2] += made * c.ny * c.ny;
    changed[c.slot] = b;
    changes.push_back(c);
    ++done.changes;
  }

  // What the factor holds of a slot: its share of the diagonal.
  Block holds(int slot) const {
    const auto found = changed.find(slot);
    if (found != changed.end()) return found->second;
    const Block& b = matrix.coupling[static_cast<std::size_t>(slot)];
    return {-b[0], -b[1], -b[2]};
  }

  // Makes the factor hold `target` there: a change along each of the two axes of the difference.
  void bring(const Sheet& sheet, int slot, const Block& target, bool on) {
    const Block now = holds(slot);
    const Block d{target[0] - now[0], target[1] - now[1], target[2] - now[2]};
    const double middle = 0.5 * (d[0] + d[2]), half = 0.5 * (d[0] - d[2]), size = std::sqrt(half * half + d[1] * d[1]);
    double x = 1, y = 0;
    if (size > 0) {
      x = std::sqrt(std::max(0.0, 0.5 * (1 + half / size)));
      y = std::copysign(std::sqrt(std::max(0.0, 0.5 * (1 - half / size))), d[1]);
    }
    const double small = least_change * sheet.stiffness[static_cast<std::size_t>(slot)];
    if (std::fabs(middle + size) > small) change(sheet, {middle + size, slot, x, y, on});  // the stiffer first
    if (std::fabs(middle - size) > small) change(sheet, {middle - size, slot, -y, x, on});
  }

  // Brings the factor up to date with springs that broke and contacts that opened or closed. A patch leaves a contact
  // that bears next to nothing open by next to nothing: it counts as closed if the last step pressed it together or the
  // factor holds it, for else the next step would press it together again, and a patch part it again, and so on.
  void follow(const Sheet& sheet, const Forces& forces) {
    for (const int slot : watched) {
      const auto k = static_cast<std::size_t>(slot);
      const auto i = static_cast<std::size_t>(sheet.first(slot)), j = static_cast<std::size_t>(sheet.second(slot));
      const double stiffness = sheet.stiffness[k], gap = forces.length[k] - (sheet.radius[i] + sheet.radius[j]);
      const bool grazes =
          (held[k] || std::binary_search(pressed.begin(), pressed.end(), slot)) && stiffness * gap < forces.unbalanced;
      const bool closed = active(sheet, forces, slot) || grazes;
      if (closed == (held[k] != 0)) continue;
      const double nx = (sheet.x[j] - sheet.x[i]) / forces.length[k], ny = (sheet.y[j] - sheet.y[i]) / forces.length[k];
      const double along = closed ? stiffness : 0.0;
      bring(sheet, slot, {along * nx * nx, along * nx * ny, along * ny * ny}, closed);
    }
  }

  // The same for springs in the boxes that turned since the factor was made, the farthest of them: few beside a new
  // crack do, and as long as the factor holds them as they lay, steps go astray there.
  void turn(const Sheet& sheet, const Forces& forces, std::span<const LatticeBox> boxes) {
    std::vector<std::pair<double, int>> turned;
    for (const LatticeBox& box : boxes) {
      for (int r = box.r0; r < box.r1; ++r) {
        for (int c = box.c0; c < box.c1; ++c) {
          for (int d = 0; d < 3; ++d) {
            const int slot = d * sheet.particles() + r * sheet.lattice.columns + c;
            if (!active(sheet, forces, slot)) continue;
            const double far = farthest(tangent_block(sheet, forces, slot, Tangent::stable), holds(slot));
            if (far > turned_change * sheet.stiffness[static_cast<std::size_t>(slot)]) turned.emplace_back(-far, slot);
          }
        }
      }
    }
    std::sort(turned.begin(), turned.end());
    turned.erase(std::unique(turned.begin(), turned.end()), turned.end());
    if (turned.size() > most_turned) turned.resize(most_turned);
    for (const auto& [far, slot] : turned)
      bring(sheet, slot, tangent_block(sheet, forces, slot, Tangent::stable), true);
  }

  static double farthest(const Block& a, const Block& b) {
    return std::max({std::fabs(a[0] - b[0]), std::fabs(a[1] - b[1]), std::fabs(a[2] - b[2])});
  }

  // The larger component of the unbalanced force on a particle, along free directions.
  static double open(const Sheet& sheet, const Forces& forces, std::size_t i) {
    const double fx = (sheet.fixed[i] & 1) ? 0.0 : std::fabs(forces.x[i]);
    const double fy = (sheet.fixed[i] & 2) ? 0.0 : std::fabs(forces.y[i]);
    return std::max(fx, fy);
  }

  enum class Cover { all, worst };

  // Boxes around what is unbalanced above a share of the largest and of the tolerance.
  std::vector<LatticeBox> boxes_around(const Sheet& sheet, const Forces& forces, Cover cover) const {
    const int rows = sheet.lattice.rows;
    const auto columns = static_cast<std::size_t>(sheet.lattice.columns);
    const double share = cover == Cover::all ? peak_share : worst_share;
    const double counts = std::max(0.8 * settings.tolerance * forces.largest, share * forces.unbalanced);
    struct Hot {
      int column, row;
      double size;
    };
    std::vector<Hot> hot;
    for (int r = 0; r < rows && hot.size() < most_hot; ++r) {
      if (forces.rows[static_cast<std::size_t>(r)].unbalanced <= counts) continue;
      for (int c = 0; c < sheet.lattice.columns; ++c) {
        const double value = open(sheet, forces, static_cast<std::size_t>(r) * columns + static_cast<std::size_t>(c));
        if (value > counts) hot.push_back({c, r, value});
      }
    }
    if (hot.size() >= most_hot) return {};
    std::vector<LatticeBox> boxes;
    while (!hot.empty() && boxes.size() < (cover == Cover::all ? most_patches : most_worst)) {
      const Hot worst =
          *std::max_element(hot.begin(), hot.end(), [](const Hot& a, const Hot& b) { return a.size < b.size; });
      boxes.push_back(Patches::around(sheet.lattice, worst.column, worst.row));
      std::erase_if(hot, [&](const Hot& h) { return Patches::covers(sheet.lattice, boxes.back(), h.column, h.row); });
    }
    if (cover == Cover::all && !hot.empty()) boxes.clear();
    return boxes;
  }

  // The two particles of a slot.
  static LatticeBox around(const Sheet& sheet, int slot) {
    const int columns = sheet.lattice.columns, i = sheet.first(slot), j = sheet.second(slot);
    const auto [c0, c1] = std::minmax({i % columns, j % columns});
    const auto [r0, r1] = std::minmax({i / columns, j / columns});
    return {c0, c1 + 1, r0, r1 + 1};
  }

  // Unbalanced forces along free directions, in elimination order; what is far below `small` is left for later steps,
  // so that loads stay few.
  void load(const Sheet& sheet, const Forces& forces, double small) {
    const int n = sheet.particles();
#pragma omp parallel for schedule(static) num_threads(settings.threads)
    for (int at = 0; at < n; ++at) {
      const auto p = static_cast<std::size_t>(at);
      const auto i = static_cast<std::size_t>(dissection.order[p]);
      const double fx = (sheet.fixed[i] & 1) ? 0.0 : forces.x[i], fy = (sheet.fixed[i] & 2) ? 0.0 : forces.y[i];
      const bool counts = std::max(std::fabs(fx), std::fabs(fy)) > small;
      u[2 * p] = counts ? fx : 0.0;
      u[2 * p + 1] = counts ? fy : 0.0;
    }
  }

  double work_of(const Sheet& sheet, const Forces& forces) const {  // F . u along free directions
    double total = 0;
    for (std::size_t at = 0; at < dissection.order.size(); ++at) {
      const auto i = static_cast<std::size_t>(dissection.order[at]);
      if (!(sheet.fixed[i] & 1)) total += forces.x[i] * u[2 * at];
      if (!(sheet.fixed[i] & 2)) total += forces.y[i] * u[2 * at + 1];
    }
    return total;
  }

  void move(Sheet& sheet, double share) const {
    const int n = sheet.particles();
#pragma omp parallel for schedule(static) num_threads(settings.threads)
    for (int at = 0; at < n; ++at) {
      const auto p = static_cast<std::size_t>(at);
      const auto i = static_cast<std::size_t>(dissection.order[p]);
      sheet.x[i] += share * u[2 * p];
      sheet.y[i] += share * u[2 * p + 1];
    }
  }

  // How many times u may be gone without a particle exceeding longest_step.
  double limit(const Sheet& sheet) const {
    const double most = largest(u);
    return most > 0 ? longest_step * sheet.radius0 / most : 1.0;
  }

  double largest(std::span<const double> v) const {
    double most = 0;
    const double* p = v.data();
#pragma omp parallel for simd reduction(max : most) schedule(static) num_threads(settings.threads)
    for (std::size_t i = 0; i < v.size(); ++i) most = std::fabs(p[i]) > most ? std::fabs(p[i]) : most;
    return most;
  }

  // Conjugate gradients on the true tangent: u = K^-1 u to `share` of the first residual. Returns solves made.
  int newton_direction(const Sheet& sheet, const Forces& forces, double share, int most) {
    const auto n = u.size() / 2;
    operator_of_state.update(sheet, forces);
    auto& [r, p, z, vx, vy, wx, wy] = directions;
    r = u;
    for (auto* v : {&p, &z}) v->resize(2 * n);
    for (auto* v : {&vx, &vy, &wx, &wy}) v->resize(n);
    std::fill(p.begin(), p.end(), 0.0);
    std::fill(u.begin(), u.end(), 0.0);
    const double start = largest(r);
    int solves = 0;
    double rz = 0;
    while (solves < most) {
      z = r;
      factor.solve(z);
      ++solves;
      const double next = dot(r.data(), z.data(), r.size());
      const double beta = solves == 1 ? 0.0 : next / rz;
      rz = next;
#pragma omp parallel for schedule(static) num_threads(settings.threads)
      for (std::size_t at = 0; at < n; ++at) {
        p[2 * at] = z[2 * at] + beta * p[2 * at];
        p[2 * at + 1] = z[2 * at + 1] + beta * p[2 * at + 1];
        const auto i = static_cast<std::size_t>(dissection.order[at]);
        vx[i] = p[2 * at], vy[i] = p[2 * at + 1];
      }
      operator_of_state.apply(vx, vy, wx, wy);
      std::vector<double>& q = z;  // K p
#pragma omp parallel for schedule(static) num_threads(settings.threads)
      for (std::size_t at = 0; at < n; ++at) {
        const auto i = static_cast<std::size_t>(dissection.order[at]);
        q[2 * at] = wx[i], q[2 * at + 1] = wy[i];
      }
      const double curvature = dot(p.data(), q.data(), p.size());
      if (curvature <= 1e-6 * rz) {  // a direction without stiffness: keep what is known, or step along it
        if (solves == 1) u = p;
        break;
      }
      const double alpha = rz / curvature;
#pragma omp parallel for simd schedule(static) num_threads(settings.threads)
      for (std::size_t k = 0; k < p.size(); ++k) {
        u[k] += alpha * p[k];
        r[k] -= alpha * q[k];
      }
      if (largest(r) <= share * start) break;
    }
    done.solves += solves;
    return solves;
  }

  // The case ends rather than go on with what is no number: nothing after it could be trusted.
  void require_finite() const {
    double nothing = 0;  // zero, or no number
    const double* p = u.data();
#pragma omp parallel for simd reduction(+ : nothing) schedule(static) num_threads(settings.threads)
    for (std::size_t i = 0; i < u.size(); ++i) nothing += 0 * p[i];
    if (nothing != 0)
      throw CaseError("the sheet lost its stiffness and no equilibrium was found; smaller load steps may help");
  }

  // Moves along u; shortens the step while the energy would rise along it, lengthens it while it goes on falling as
  // steeply (a fragment that nothing holds, or that buckles: its way to equilibrium is long beside the held step).
  void search(Sheet& sheet, Forces& forces) {
    const double before = forces.unbalanced;
    const double most = limit(sheet);
    double share = std::min(1.0, most);
    move(sheet, share);
    double at = share;
    compute_forces(sheet, forces, settings.threads);
    if (forces.unbalanced < 0.9 * before) return;
    // Rare: find where the forces along u vanish, from the start's slope (recomputed) on.
    move(sheet, -share);
    compute_forces(sheet, forces, settings.threads);
    const double slope = work_of(sheet, forces);
    at = 0;
    for (int attempt = 0; attempt < 12; ++attempt) {
      move(sheet, share - at);
      at = share;
      compute_forces(sheet, forces, settings.threads);
      const double now = work_of(sheet, forces);
      if (forces.unbalanced < 0.9 * before) return;
      ++done.searches;
      if (now > 0.7 * slope) {
        if (share >= most) return;
        share = std::min(2 * share, most);
      } else if (now >= -0.5 * std::fabs(slope)) {
        return;
      } else {
        share = std::clamp(share * slope / (slope - now), 0.1 * share, 0.7 * share);
      }
    }
  }

  void load(const Sheet& sheet, const Forces& forces) {
    load(sheet, forces, std::max(0.05 * settings.tolerance * forces.largest, slight_load * forces.unbalanced));
  }

  int global_step(Sheet& sheet, Forces& forces) {
    load(sheet, forces);
    factor.solve(u);
    ++done.solves;
    require_finite();
    search(sheet, forces);
    return 1;
  }

  int newton_step(Sheet& sheet, Forces& forces, double share) {
    load(sheet, forces);
    const int solves = newton_direction(sheet, forces, share, 20);
    require_finite();
    search(sheet, forces);
    return solves;
  }

  Relaxation relax(Sheet& sheet, Forces& forces, std::span<const int> near) {
    ++done.relaxations;
    if (near.empty()) compute_forces(sheet, forces, settings.threads);
    for (const int slot : near) update_forces(sheet, forces, around(sheet, slot));
    // Kept in order of slots, as after a restart: changes are made in that order.
    for (const int slot : near) watched.insert(std::lower_bound(watched.begin(), watched.end(), slot), slot);
    Relaxation result;
    pressed.clear();
    int slow = 0, patched = 0, settling = first_settling;
    std::vector<LatticeBox> boxes;  // of the patches since the last step
    double left = 0;                // share of the unbalanced force that the last global step left
    bool fresh = false;
    // The load moved, and every direction turned a little: the breaks that follow are worth a new factor.
    if (!factorised || (!near.empty() && load_moved)) factorise(sheet, forces, Extent::whole), fresh = true;
    if (near.empty()) load_moved = true;
    const auto balanced = [&] { return forces.unbalanced <= settings.tolerance * forces.largest; };
    while (!balanced() && result.iterations < settings.most_solves) {
      const double before = forces.unbalanced;
      // Patches come after global steps: what they push over their rim is for the next global step.
      if (!settings.refactor_always && result.iterations > patched) {
        patched = result.iterations;
        boxes = boxes_around(sheet, forces, left > much ? Cover::worst : Cover::all);
        patches.relax(sheet, forces, boxes, 0.1 * settings.tolerance * forces.largest);
        done.patches += static_cast<std::int64_t>(boxes.size());
        if (!boxes.empty()) continue;
      }
      if (!settings.refactor_always && result.iterations >= settling) {
        settling = result.iterations + next_settling;
        for (const LatticeBox& box : boxes_around(sheet, forces, Cover::worst)) {
          Patches::settle(sheet, forces, box, 0.1 * settings.tolerance * forces.largest);
          ++done.settled;
        }
        continue;
      }
      if (settings.refactor_always || factor.changes() > most_changes || extra_solves > std::max(least_worth, worth)) {
        factorise(sheet, forces, settings.refactor_always ? Extent::whole : Extent::part);
        fresh = true;
      } else {
        follow(sheet, forces);
        if (left > turned_share) turn(sheet, forces, boxes);
        // Around a crushed place: what little each removal leaves adds up to nothing that could be solved with.
        if (factor.weakened() > most_weakened) factorise(sheet, forces, Extent::part), fresh = true;
      }
      const int solves = slow >= 2 ? newton_step(sheet, forces, std::clamp(0.9 * left * left, finest, roughest))
                                   : global_step(sheet, forces);
      left = forces.unbalanced / before;
      pressed.clear();
      std::copy_if(watched.begin(), watched.end(), std::back_inserter(pressed),
                   [&](int slot) { return active(sheet, forces, slot); });
      warm(sheet, forces, before);
      result.iterations += solves;
      if (left > 0.3) ++slow;
      if (!fresh) extra_solves += solves;
      // A relaxation that goes on and on needs a factor of its own.
      if (result.iterations % 40 < solves && result.iterations >= 40) extra_solves = 2 * most_changes;
    }
    if (!fresh) extra_solves = std::max(0.0, extra_solves - std::min(usual_solves, result.iterations));
    result.reached = balanced();
    result.unbalanced = forces.largest > 0 ? forces.unbalanced / forces.largest : 0;
    return result;
  }
};

ConvergedSolver::ConvergedSolver(const Sheet& sheet, ConvergedSettings settings)
    : impl_(std::make_unique<Impl>(sheet, settings)) {}
ConvergedSolver::~ConvergedSolver() = default;
Relaxation ConvergedSolver::relax(Sheet& sheet, Forces& forces, std::span<const int> near) {
  return impl_->relax(sheet, forces, near);
}
SolverWork ConvergedSolver::work() const { return impl_->done; }
void ConvergedSolver::set_threads(int threads) {
  Impl& i = *impl_;
  if (i.settings.threads == threads) return;
  i.settings.threads = threads;
  i.factor.set_threads(threads);
  i.patches.set_threads(threads);
  i.operator_of_state.set_threads(threads);
}
ConvergedState ConvergedSolver::state() const {
  const Impl& i = *impl_;
  return {i.matrix.coupling, i.changes, i.heat, i.extra_solves, i.worth, i.load_moved};
}

void ConvergedSolver::restore(const Sheet& sheet, const ConvergedState& state) {
  Impl& i = *impl_;
  if (state.coupling.empty()) return;
  i.matrix.fixed = sheet.fixed;
  i.matrix.coupling = state.coupling;
  i.matrix.diagonal.resize(sheet.x.size());
  for (int p = 0; p < sheet.particles(); ++p) {
    i.matrix.diagonal[static_cast<std::size_t>(p)] = diagonal_of(sheet, i.matrix, p);
  }
  i.done.negative_pivots += i.factor.factorise(i.matrix);
  ++i.done.factorisations;
  i.factorised = true;
  i.changes.clear();
  i.changed.clear();
  i.hold(sheet);
  for (const auto& change : state.changes) i.change(sheet, change);
  i.heat = state.heat;
  i.extra_solves = state.extra_solves;
  i.worth = state.worth;
  i.load_moved = state.load_moved;
}

}  // namespace dem::sheet
