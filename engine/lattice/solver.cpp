#include "engine/lattice/solver.h"

#include <fmt/format.h>
#include <omp.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "engine/core/cell_grid.h"
#include "engine/core/errors.h"
#include "engine/core/threads.h"
#include "engine/lattice/grid.h"

namespace dem::lattice {
namespace {

using Elements = std::vector<std::int32_t>;

constexpr int stretch = 50;  // steps on one number of threads

const Kernel& kernel_of(InstructionSet set) {
  if (!processor_has(set)) throw InputError(fmt::format("this processor does not have {}", name_of(set)));
  switch (set) {
    case InstructionSet::avx512:
      return kernel_avx512();
    case InstructionSet::avx2:
      return kernel_avx2();
    case InstructionSet::sse2:
      break;
  }
  return kernel_sse2();
}

// One plane and the elements bound to it.
struct Plane {
  Elements elements;
  double outward = 1;                // of the block, along the axis
  double position = 0;               // of the plane, m
  double plate = 0, plate_step = 0;  // displacement of a plate or held layer, and of its last step
  double pending = 0;                // motion whose work waits for the force after it
  double force = 0;                  // on the block along +axis, N, at the last measurement
  double work = 0;                   // J
  double plate_kinetic = 0, plate_half = 0, plate_viscous = 0;  // in the units of Row::sample and Row::viscous
};

Wide wide(double x) { return {{x, x, x, x, x, x, x, x}}; }

Constants constants_of(const Setup& s, const Grid& grid) {
  constexpr double never = std::numeric_limits<double>::infinity();
  Constants c{};
  c.pitch = grid.pitch;
  c.force_pitch = grid.force_pitch;
  const double kn = s.micro.kn, ks = s.micro.ks, d = s.micro.diameter;
  c.kn = wide(kn);
  c.ks = wide(ks);
  c.ks2 = wide(ks * ks);
  c.half_ks = wide(0.5 * ks);
  c.xb = wide(s.unbreakable ? never : s.micro.xb);
  c.fs0 = wide(s.unbreakable ? never : s.micro.fs0);
  c.mu = wide(s.micro.mu);
  c.d = wide(d);
  c.d2 = wide(d * d);
  for (int kind = 0; kind < 2; ++kind) {
    for (int k = 0; k < directions; ++k) {
      const auto v = bond_vector(kind, k);
      for (int i = 0; i < 3; ++i) c.bond[kind][k][i] = wide(d * v[static_cast<std::size_t>(i)]);
    }
  }
  const double a = s.viscosity * s.time_step / (2 * s.micro.mass);
  c.keep = wide((1 - a) / (1 + a));
  c.push = wide(s.time_step * s.time_step / (s.micro.mass * (1 + a)));
  c.axis = s.axis;
  return c;
}

// OpenMP may lend fewer threads than asked for; the rows are shared among those that come.
int threads_lent(int wanted) {
  int lent = 1;
#pragma omp parallel num_threads(wanted)
  {
#pragma omp single
    lent = omp_get_num_threads();
  }
  return lent;
}

const Setup& checked(const Setup& s) {
  const double limit = stable_time_step(s.micro);
  if (!(s.time_step > 0 && s.time_step <= limit)) {
    throw InputError(
        fmt::format("the time step is {:.4g} s", s.time_step),
        fmt::format("it must be positive and at most {:.4g} s, the stable limit for these stiffnesses and this mass",
                    limit));
  }
  if (!(s.viscosity >= 0))
    throw InputError(fmt::format("the viscosity is {} N s/m", s.viscosity), "it must not be negative");
  if (s.threads < 1) throw InputError(fmt::format("the number of threads is {}", s.threads), "it must be 1 or more");
  return s;
}

}  // namespace

struct Solver::Impl {
  Block block;
  Setup setup;
  const Kernel& kernel;
  Grid grid;
  Constants constants;
  std::array<Plane, 2> planes;                   // low, high
  std::array<std::array<Elements, 2>, 3> faces;  // by axis and side
  std::vector<std::vector<Event>> event_store;   // by thread
  std::vector<Events> events;
  std::vector<Crack> cracks;
  Pace pace;
  std::int64_t step = 0;
  std::int64_t opening = 0, sliding = 0;
  double heat_normal = 0, heat_shear = 0;

  Impl(const Block& b, const Setup& s)
      : block(b),
        setup(s),
        kernel(kernel_of(s.set ? *s.set : widest_set())),
        grid(b, kernel.lanes, threads_lent(s.threads), s.gravity != 0 || s.pressure != 0),
        constants(constants_of(s, grid)) {
    for (int axis = 0; axis < 3; ++axis) {
      for (int side = 0; side < 2; ++side) faces[at(axis)][at(side)] = block.face(axis, side == 1);
    }
    for (int side = 0; side < 2; ++side) {
      Plane& plane = planes[at(side)];
      plane.elements = faces[at(s.axis)][at(side)];
      plane.outward = side == 1 ? 1 : -1;
      const bool held = s.planes != PlaneKind::elastic;
      grid.bind_plane(plane.elements, held ? 0.0 : s.plane_stiffness * s.micro.kn, held);
    }
    if (s.gravity != 0) {
      for (std::size_t e = 0; e < grid.row_of.size(); ++e) grid.add_push(e, 2, -(s.micro.mass * s.gravity));
    }
    if (s.pressure != 0) press_sides();
    for (const Share& share : grid.shares) {
      std::size_t most = 0;
      for (int g = share.first; g < share.last; ++g) most += static_cast<std::size_t>(grid.length[at(g)]) * directions;
      event_store.emplace_back(most);
      events.push_back({event_store.back().data(), 0, 0});
    }
  }

  static std::size_t at(std::int64_t i) { return static_cast<std::size_t>(i); }

  // The pressure on a side goes to the outermost element of every row (y), or to the outermost row of every layer (x), in equal
  // parts: the sides zigzag, and these are what a jacket would touch.
  void press_sides() {
    const auto box = block.extent();
    for (int axis = 0; axis < 3; ++axis) {
      if (axis == setup.axis) continue;
      std::map<std::pair<std::int32_t, std::int32_t>, std::array<std::int32_t, 2>> ends;  // of each line along the axis
      for (const Site& site : block.site) {
        const std::int32_t along = axis == 0 ? site.row : axis == 1 ? site.column : site.layer;
        auto& [low, high] = ends.try_emplace(line_of(site, axis), std::array{along, along}).first->second;
        low = std::min(low, along);
        high = std::max(high, along);
      }
      for (const int side : {0, 1}) {
        std::vector<std::size_t> outer;
        for (std::size_t e = 0; e < block.site.size(); ++e) {
          const Site& site = block.site[e];
          const std::int32_t along = axis == 0 ? site.row : axis == 1 ? site.column : site.layer;
          if (along == ends.at(line_of(site, axis))[at(side)]) outer.push_back(e);
        }
        const double area = box[at((axis + 1) % 3)] * box[at((axis + 2) % 3)];
        const double each = (side == 0 ? 1 : -1) * setup.pressure * area / static_cast<double>(outer.size());
        for (const std::size_t e : outer) {
          grid.add_push(e, axis, each);
          pushes.push_back({e, axis, each});
        }
      }
    }
  }
  // Sites with the same line have their ends along the axis in common: a row for y, a layer for x, the whole block for z.
  static std::pair<std::int32_t, std::int32_t> line_of(const Site& site, int axis) {
    return axis == 1 ? std::pair{site.layer, site.row} : axis == 0 ? std::pair{site.layer, 0} : std::pair{0, 0};
  }
  struct Push {
    std::size_t element;
    int axis;
    double newton;
  };
  std::vector<Push> pushes;  // of the pressure

  // With the load along z, the end layers belong to the first and the last thread, which can serve the planes at once.
  bool planes_are_local() const {
    if (grid.shares.size() == 1) return true;
    if (setup.axis != 2) return false;
    const int per = grid.rows_per_layer, last_layer = static_cast<int>(grid.rows.size()) - per;
    return grid.shares.front().last >= per && grid.shares.back().first <= last_layer;
  }

  double face_mean(int axis, int side, int component) const {
    const Elements& face = faces[at(axis)][at(side)];
    double sum = 0;
    for (const std::int32_t e : face) sum += grid.motion(at(e), component);
    return sum / static_cast<double>(face.size());
  }
  double face_strain(int axis) const {
    return (face_mean(axis, 1, axis) - face_mean(axis, 0, axis)) / block.extent()[at(axis)];
  }

  double bond_force_sum(const Plane& plane) const {
    double sum = 0;
    for (const std::int32_t e : plane.elements) {
      sum += grid.rows[at(grid.row_of[at(e)])].plane_force[grid.column_of[at(e)]];
    }
    return sum;
  }

  // After all rows with elements of this plane have moved from time n to n+1: forces at n, motion of plane and plate.
  void serve_plane(Plane& plane, double drift, bool measure, bool sample) {
    const auto n = static_cast<double>(plane.elements.size());
    double carried = 0;
    if (measure || setup.planes == PlaneKind::plate) carried = bond_force_sum(plane);
    if (setup.planes == PlaneKind::plate) {
      plane.force = n * plane_spring() * (plane.position - plane.plate);
    } else if (measure) {
      plane.force = setup.planes == PlaneKind::elastic ? carried : -carried;
    }
    if (measure) {
      plane.work += 0.5 * plane.force * plane.pending;  // second half of the last motion
      plane.pending = drift;
      plane.work += 0.5 * plane.force * drift;  // first half of this one
    }
    plane.position += drift;
    double moved = drift;
    if (setup.planes == PlaneKind::plate) {
      const double before = plane.plate_step;
      moved = constants.keep.lane[0] * before + constants.push.lane[0] / n * (carried + plane.force);
      plane.plate_viscous += n * (before + moved) * (before + moved);
      if (sample) {
        plane.plate_kinetic = n * before * moved;
        plane.plate_half = n * (before + moved) * before;
      }
    }
    if (setup.planes == PlaneKind::elastic) {
      if (drift != 0) place_plane(plane);
    } else if (moved != 0 || plane.plate_step != 0) {
      plane.plate += moved;
      plane.plate_step = moved;
      place_plane(plane);
    }
  }

  void place_plane(const Plane& plane) {
    for (const std::int32_t element : plane.elements) {
      const std::size_t e = at(element);
      if (setup.planes == PlaneKind::elastic) {
        const Row& row = grid.rows[at(grid.row_of[e])];
        row.plane_position[grid.column_of[e]] = plane.position;
      } else {
        grid.motion(e, setup.axis) = plane.plate;
        grid.motion(e, 3 + setup.axis) = plane.plate_step;
      }
    }
  }

  struct Job {
    int first, last;  // steps
    double drift[2];
    bool sample, stop_on_break;
    std::atomic<bool> broke[4] = {};  // by step modulo 4: a thread may be one step ahead of another
  };

  // The shares of rows of one thread out of so many; its last share lies before that of the next thread.
  void work(int thread, int threads, Job& job, Barrier& barrier) {
    const int all = static_cast<int>(grid.shares.size());
    const int begin = all * thread / threads, end = all * (thread + 1) / threads;
    const bool local = planes_are_local();
    const bool first = thread == 0, last = thread + 1 == threads;
    for (int s = job.first; s < job.last; ++s) {
      for (int k = begin; k < end; ++k) {
        const Share share = grid.shares[at(k)];
        events[at(k)].step = step + s;
        for (int g = share.first; g < share.last; ++g) {
          if (g == share.lead) g = share.early;
          if (g < share.last && grid.length[at(g)] > 0)
            kernel.forces(constants, grid.rows[at(g)], job.sample, events[at(k)]);
        }
      }
      if (first) job.broke[(s + 2) & 3].store(false, std::memory_order_relaxed);
      barrier.wait();
      for (int k = begin; k < end; ++k) {
        const Share share = grid.shares[at(k)];
        for (int g = share.first; g < share.last; ++g) {
          if (grid.length[at(g)] == 0) continue;
          if (g >= share.lead && g < share.early) kernel.forces(constants, grid.rows[at(g)], job.sample, events[at(k)]);
          kernel.advance(constants, grid.rows[at(g)], job.sample);
        }
        if (events[at(k)].count > 0 && events[at(k)].items[events[at(k)].count - 1].step == step + s)
          job.broke[s & 3].store(true, std::memory_order_relaxed);
      }
      if (!local) barrier.wait();
      const bool measure = s < 2;
      for (std::size_t side = 0; side < 2; ++side) {
        if (local ? (side == 0 ? first : last) : first)
          serve_plane(planes[side], s == 0 ? job.drift[side] : 0.0, measure, job.sample);
      }
      barrier.wait();
      if (job.stop_on_break && job.broke[s & 3].load(std::memory_order_relaxed)) {
        if (first) job.last = s + 1;  // who is here reads it no more
        return;
      }
    }
  }

  // In short stretches, between which the number of threads may change: the bits depend on the shares of rows alone.
  int run(int steps, double low, double high, bool sample, bool stop_on_break) {
    if (steps <= 0) return 0;
    const int most = static_cast<int>(grid.shares.size());
    Job job{0, 0, {low, high}, sample, stop_on_break};
    for (bool stopped = false; job.last < steps && !stopped;) {
      job.first = job.last;
      const int until = job.last = most > 1 ? std::min(steps, job.first + stretch) : steps;
      const int threads = pace.begin(most);
      Barrier barrier(threads);
      if (threads == 1) {
        work(0, 1, job, barrier);
      } else {
#pragma omp parallel num_threads(threads)
        {
#pragma omp single
          barrier.set_threads(omp_get_num_threads());
          work(omp_get_thread_num(), omp_get_num_threads(), job, barrier);
        }
      }
      stopped = job.last < until;
      pace.done(job.last - job.first);
    }
    step += job.last;
    collect();
    return job.last;
  }

  void collect() {
    std::vector<Event> found;
    for (Events& e : events) {
      found.insert(found.end(), e.items, e.items + e.count);
      e.count = 0;
    }
    if (found.empty()) return;
    std::sort(found.begin(), found.end(), [](const Event& a, const Event& b) {
      return std::tie(a.step, a.row, a.column, a.direction) < std::tie(b.step, b.row, b.column, b.direction);
    });
    if (first_in_row.empty()) {
      first_in_row.assign(grid.rows.size(), 0);
      for (std::size_t e = grid.row_of.size(); e-- > 0;)
        first_in_row[at(grid.row_of[e])] = static_cast<std::int32_t>(e);
    }
    for (const Event& e : found) {
      cracks.push_back({e.step, first_in_row[at(e.row)] + e.column, e.direction, e.mode, e.heat_normal, e.heat_shear});
      count(cracks.back());
    }
  }
  std::vector<std::int32_t> first_in_row;

  void count(const Crack& crack) {
    (crack.mode == 0 ? opening : sliding) += 1;
    heat_normal += crack.heat_normal;
    heat_shear += crack.heat_shear;
  }

  template <class Get>
  double sum_of_elements(Get get) const {
    double sum = 0;
    for (std::size_t e = 0; e < grid.row_of.size(); ++e) sum += get(grid.rows[at(grid.row_of[e])])[grid.column_of[e]];
    return sum;
  }

  Sample sample(double low, double high) {
    Sample s;
    const double dt = setup.time_step, m = setup.micro.mass;
    const double to_heat = setup.viscosity / (4 * dt);
    s.step = step;
    s.time = static_cast<double>(step) * dt;
    s.strain = face_strain(setup.axis);
    s.between_planes = (planes[1].position - planes[0].position) / block.extent()[at(setup.axis)];
    s.lateral = {face_strain(setup.axis == 0 ? 1 : 0), face_strain(setup.axis == 2 ? 1 : 2)};
    s.viscous = to_heat * (sum_of_elements([](const Row& r) { return r.viscous; }) + planes[0].plate_viscous +
                           planes[1].plate_viscous);
    for (const Plane& p : planes) s.elastic_planes += plane_energy(p);
    if (setup.gravity != 0) {
      double height = 0;
      for (std::size_t e = 0; e < grid.row_of.size(); ++e) height += grid.motion(e, 2);
      s.gravity = m * setup.gravity * height;
    }
    for (const Push& push : pushes) s.work += push.newton * grid.motion(push.element, push.axis);
    run(1, low, high, true, false);
    const int p = grid.pitch;
    s.elastic_normal = sum_of_elements([](const Row& r) { return r.sample; });
    s.elastic_shear = sum_of_elements([p](const Row& r) { return r.sample + p; });
    s.kinetic = 0.5 * m / (dt * dt) *
                (sum_of_elements([p](const Row& r) { return r.sample + 2 * p; }) + planes[0].plate_kinetic +
                 planes[1].plate_kinetic);
    // The work of the viscous force in the half step that ends here.
    s.viscous += to_heat * (sum_of_elements([p](const Row& r) { return r.sample + 3 * p; }) + planes[0].plate_half +
                            planes[1].plate_half);
    s.frictional = sum_of_elements([](const Row& r) { return r.friction; });
    s.breaking_normal = heat_normal;
    s.breaking_shear = heat_shear;
    s.opening = opening;
    s.sliding = sliding;
    const std::array<double, 2> drift{low, high};
    for (std::size_t side = 0; side < 2; ++side) {
      s.force[side] = planes[side].outward * planes[side].force;
      s.work += planes[side].work - 0.5 * planes[side].force * drift[side];  // without the motion that begins now
    }
    return s;
  }

  double plane_spring() const { return setup.plane_stiffness * setup.micro.kn; }

  double plane_energy(const Plane& plane) const {
    const double kn = plane_spring();
    if (setup.planes == PlaneKind::rigid) return 0;
    if (setup.planes == PlaneKind::plate) {
      const double x = plane.position - plane.plate;
      return 0.5 * kn * static_cast<double>(plane.elements.size()) * x * x;
    }
    double sum = 0;
    for (const std::int32_t e : plane.elements) {
      const double x = plane.position - grid.motion(at(e), setup.axis);
      sum += x * x;
    }
    return 0.5 * kn * sum;
  }
};

InstructionSet fastest_set(const Block& block, Setup setup) {
  setup.threads = 1;
  const int steps = std::clamp(static_cast<int>(5e3 / static_cast<double>(block.bonds.size())), 1, 50);
  std::map<InstructionSet, Solver> solvers;  // each made in its first turn, which is never its shortest
  return dem::fastest_set([&](InstructionSet set) {
    setup.set = set;
    const auto [solver, fresh] = solvers.try_emplace(set, block, setup);
    const double nudge = fresh ? 1e-9 * setup.micro.diameter : 0;  // of the planes, so that something moves
    solver->second.run(steps, nudge, -nudge);
  });
}

Solver::Solver(const Block& block, const Setup& setup) { impl_ = std::make_unique<Impl>(block, checked(setup)); }
Solver::~Solver() = default;
Solver::Solver(Solver&&) noexcept = default;

int Solver::run(int steps, double low, double high, bool stop_on_break) {
  return impl_->run(steps, low, high, false, stop_on_break);
}
Sample Solver::sampled_step(double low, double high) { return impl_->sample(low, high); }
const std::vector<Crack>& Solver::cracks() const { return impl_->cracks; }
std::int64_t Solver::step() const { return impl_->step; }
double Solver::strain() const { return impl_->face_strain(impl_->setup.axis); }
std::size_t Solver::bytes() const { return impl_->grid.bytes(); }

std::vector<std::array<double, 3>> Solver::displacement() const {
  const Grid& grid = impl_->grid;
  std::vector<std::array<double, 3>> u(grid.row_of.size());
  for (std::size_t e = 0; e < u.size(); ++e) u[e] = {grid.motion(e, 0), grid.motion(e, 1), grid.motion(e, 2)};
  return u;
}

std::vector<std::int32_t> Solver::bond_state() const {
  std::vector<std::int32_t> state(impl_->block.bonds.size(), 0);
  std::map<std::pair<std::int32_t, std::int32_t>, std::int32_t> mode;
  for (const Crack& c : impl_->cracks) mode[{c.element, c.direction}] = 1 + c.mode;
  for (std::size_t i = 0; i < state.size(); ++i) {
    const auto found = mode.find({impl_->block.bonds[i].a, impl_->block.bonds[i].direction});
    if (found != mode.end()) state[i] = found->second;
  }
  return state;
}

std::vector<std::array<double, 3>> Solver::bond_shear() const {
  std::vector<std::array<double, 3>> shear;
  for (const Block::Bond& b : impl_->block.bonds) {
    const auto e = static_cast<std::size_t>(b.a);
    shear.push_back({impl_->grid.shear(e, b.direction, 0), impl_->grid.shear(e, b.direction, 1),
                     impl_->grid.shear(e, b.direction, 2)});
  }
  return shear;
}

std::array<double, 3> Solver::momentum() const {
  std::array<double, 3> sum{};
  for (int i = 0; i < 3; ++i) {
    for (std::size_t e = 0; e < impl_->grid.row_of.size(); ++e)
      sum[static_cast<std::size_t>(i)] += impl_->grid.motion(e, 3 + i);
    sum[static_cast<std::size_t>(i)] *= impl_->setup.micro.mass / impl_->setup.time_step;
  }
  return sum;
}

std::int64_t Solver::unseen_contacts() const {
  const double d = impl_->setup.micro.diameter;
  std::vector<std::array<double, 3>> x = displacement();
  for (std::size_t e = 0; e < x.size(); ++e) {
    for (std::size_t i = 0; i < 3; ++i) x[e][i] += impl_->block.position[e][i];
  }
  const auto near = [&](std::int32_t a, std::int32_t b) {
    double r2 = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      const double dx = x[static_cast<std::size_t>(a)][i] - x[static_cast<std::size_t>(b)][i];
      r2 += dx * dx;
    }
    return r2 < d * d;
  };
  std::vector<std::pair<std::int32_t, std::int32_t>> bonded;
  for (const Block::Bond& b : impl_->block.bonds) bonded.emplace_back(std::min(b.a, b.b), std::max(b.a, b.b));
  std::sort(bonded.begin(), bonded.end());
  std::int64_t count = 0;
  const CellGrid grid(x.size(), d, [&](std::size_t e) { return x[e]; });
  for (std::size_t e = 0; e < x.size(); ++e) {
    grid.around(x[e], [&, a = static_cast<std::int32_t>(e)](std::int32_t b) {
      if (a < b && near(a, b) && !std::binary_search(bonded.begin(), bonded.end(), std::pair{a, b})) ++count;
    });
  }
  return count;
}

void Solver::set_motion(const std::vector<std::array<double, 3>>& displacement,
                        const std::vector<std::array<double, 3>>& last) {
  for (std::size_t e = 0; e < displacement.size(); ++e) {
    for (int i = 0; i < 3; ++i) {
      impl_->grid.motion(e, i) = displacement[e][static_cast<std::size_t>(i)];
      impl_->grid.motion(e, 3 + i) = last[e][static_cast<std::size_t>(i)];
    }
  }
}

Solver::State Solver::state() const {
  const Impl& s = *impl_;
  State out;
  out.step = s.step;
  out.cracks = s.cracks;
  for (std::size_t e = 0; e < s.grid.row_of.size(); ++e) {
    for (int i = 0; i < 6; ++i) out.real.push_back(s.grid.motion(e, i));
    const Row& row = s.grid.rows[Impl::at(s.grid.row_of[e])];
    out.real.push_back(row.viscous[s.grid.column_of[e]]);
    out.real.push_back(row.friction[s.grid.column_of[e]]);
  }
  for (const Block::Bond& b : s.block.bonds) {
    const auto e = static_cast<std::size_t>(b.a);
    for (int i = 0; i < 3; ++i) out.real.push_back(s.grid.shear(e, b.direction, i));
    out.code.push_back(s.grid.bond_bits(e, b.direction) == 1 ? 0 : 1);
  }
  for (const Plane& p : s.planes) {
    out.real.insert(out.real.end(), {p.position, p.plate, p.plate_step, p.pending, p.force, p.work, p.plate_viscous});
  }
  return out;
}

void Solver::restore(const State& in) {
  Impl& s = *impl_;
  if (in.real.size() != s.grid.row_of.size() * 8 + s.block.bonds.size() * 3 + 14 ||
      in.code.size() != s.block.bonds.size()) {
    throw InputError("the saved state belongs to another block", "remove it and start the case again");
  }
  s.step = in.step;
  const double* from = in.real.data();
  for (std::size_t e = 0; e < s.grid.row_of.size(); ++e) {
    for (int i = 0; i < 6; ++i) s.grid.motion(e, i) = *from++;
    const Row& row = s.grid.rows[Impl::at(s.grid.row_of[e])];
    row.viscous[s.grid.column_of[e]] = *from++;
    row.friction[s.grid.column_of[e]] = *from++;
  }
  for (std::size_t b = 0; b < s.block.bonds.size(); ++b) {
    const auto e = static_cast<std::size_t>(s.block.bonds[b].a);
    for (int i = 0; i < 3; ++i) s.grid.shear(e, s.block.bonds[b].direction, i) = *from++;
    s.grid.set_bond(e, s.block.bonds[b].direction, in.code[b] == 0);
  }
  for (Plane& p : s.planes) {
    for (double* value : {&p.position, &p.plate, &p.plate_step, &p.pending, &p.force, &p.work, &p.plate_viscous})
      *value = *from++;
    s.place_plane(p);
  }
  s.cracks.clear();
  s.opening = s.sliding = 0;
  s.heat_normal = s.heat_shear = 0;
  for (const Crack& crack : in.cracks) {
    s.cracks.push_back(crack);
    s.count(crack);
  }
}

}  // namespace dem::lattice
