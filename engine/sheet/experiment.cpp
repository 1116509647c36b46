#include "engine/sheet/experiment.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace dem::sheet {
namespace {

constexpr int most_halvings = 8;  // of a part of a load step

}  // namespace

Experiment::Experiment(Sheet& sheet, Solver& solver, Loading loading, int threads)
    : sheet_(&sheet),
      solver_(&solver),
      loading_(std::move(loading)),
      threads_(threads),
      start_x_(sheet.x),
      start_y_(sheet.y) {
  compute_forces(*sheet_, forces_, threads_);
}

void Experiment::relaxed(const Relaxation& r) {
  auto& e = state_.equilibrium;
  ++e.relaxations;
  if (!(r.unbalanced <= e.worst)) e.worst = r.unbalanced;  // what is not a number stays
  if (!r.reached) ++e.missed;
}

// Takes the load from one share of the step to another. Shares compose to the step's strain exactly.
Experiment::Part Experiment::apply(double from, double to) {
  Sheet& s = *sheet_;
  const auto n = static_cast<std::size_t>(s.particles());
  const std::vector<double> fx = forces_.x, fy = forces_.y, x = s.x, y = s.y, radius = s.radius;
  const std::vector<double> tension = loading_.kind == LoadingKind::growth ? forces_.tension : std::vector<double>();
  const double elastic = elastic_energy(s, forces_);
  const auto grown = [&](double rate) { return (1 + rate * to) / (1 + rate * from); };
  if (loading_.kind == LoadingKind::growth) {
    for (std::size_t i = 0; i < n; ++i) s.radius[i] *= grown(loading_.grows[i]);
  } else {
    const double shorter = grown(-loading_.step);
    const double sx = loading_.kind == LoadingKind::extension     ? grown(loading_.step)
                      : loading_.kind == LoadingKind::compression ? shorter
                                                                  : 1 / shorter;
    const double sy = loading_.kind == LoadingKind::pure_shear ? shorter : 1.0;
    const double cx = 0.5, cy = 0.5 * (start_y_.front() + start_y_.back());
    for (std::size_t i = 0; i < n; ++i) {
      s.x[i] = cx + (s.x[i] - cx) * sx;
      s.y[i] = cy + (s.y[i] - cy) * sy;
    }
  }
  Part part;
  part.relaxation = solver_->relax(s, forces_, {});
  const auto add = [&](double& work, double before, double after, double way) {
    work -= 0.5 * (before + after) * way;
    part.error += 0.5 * std::fabs((after - before) * way);
  };
  for (std::size_t i = 0; i < n; ++i) {
    if (s.fixed[i] & 1) add(part.boundary, fx[i], forces_.x[i], s.x[i] - x[i]);
    if (s.fixed[i] & 2) add(part.boundary, fy[i], forces_.y[i], s.y[i] - y[i]);
  }
  if (loading_.kind == LoadingKind::growth) {
    for (int slot = 0; slot < s.slots(); ++slot) {
      const auto k = static_cast<std::size_t>(slot);
      if (s.stiffness[k] <= 0) continue;
      const auto i = static_cast<std::size_t>(s.first(slot)), j = static_cast<std::size_t>(s.second(slot));
      const double dr = (s.radius[i] - radius[i]) + (s.radius[j] - radius[j]);
      if (dr != 0) add(part.growth, tension[k], forces_.tension[k], dr);
    }
  }
  part.lost = part.boundary + part.growth - (elastic_energy(s, forces_) - elastic);
  return part;
}

void Experiment::load_part() {
  Sheet& s = *sheet_;
  const bool halves = loading_.work_tolerance > 0 && !state_.breaks.empty();
  if (state_.left == 0) {
    ++state_.step;
    state_.size = std::int64_t{1} << most_halvings;
    state_.whole = state_.left = state_.size * (state_.breaks.empty() ? 1 : std::max(1, loading_.substeps));
  }
  const auto share = [&](std::int64_t left) {
    return static_cast<double>(state_.whole - left) / static_cast<double>(state_.whole);
  };
  const std::vector<double> x = s.x, y = s.y, radius = s.radius;
  Part part = apply(share(state_.left), share(state_.left - state_.size));
  const double work = std::fabs(state_.boundary_work + state_.growth_work + part.boundary + part.growth);
  const double allowed = loading_.work_tolerance * work;
  while (halves && state_.size > 1 && (std::fabs(part.lost) > allowed || !part.relaxation.reached)) {
    state_.size /= 2;
    s.x = x, s.y = y, s.radius = radius;
    compute_forces(s, forces_, pace_.threads(threads_));
    part = apply(share(state_.left), share(state_.left - state_.size));
  }
  relaxed(part.relaxation);
  state_.boundary_work += part.boundary;
  state_.growth_work += part.growth;
  if (halves && part.relaxation.reached && part.lost > std::max(allowed, part.error)) {
    ++state_.jumps;
    state_.jumped += part.lost;
  }
  state_.left -= state_.size;
  const bool easy = std::fabs(part.lost) < 0.1 * allowed || state_.size == 1;  // after a jump as before it
  const auto next = 2 * state_.size;
  if (easy && next <= (std::int64_t{1} << most_halvings) && state_.left % next == 0) state_.size = next;
  if (state_.left == 0) loaded();
}

void Experiment::loaded() {
  state_.energy_loaded = elastic_energy(*sheet_, forces_);
  const WallStress wall = wall_stress(*sheet_, forces_);
  state_.peak_xx = wall.xx;
  state_.peak_yy = wall.yy;
  state_.peak_stress = std::max(state_.peak_stress, std::fabs(wall.xx - wall.yy));
  state_.breaking = true;
}

bool Experiment::failed() const {
  if (loading_.stop_share <= 0) return false;
  const WallStress wall = wall_stress(*sheet_, forces_);
  return std::fabs(wall.xx - wall.yy) < loading_.stop_share * state_.peak_stress;
}

bool Experiment::break_one() {
  Sheet& s = *sheet_;
  if (static_cast<int>(state_.breaks.size()) >= loading_.most_breaks || failed()) return false;
  const Critical critical = most_critical(s, forces_, pace_.threads(threads_));
  if (critical.slot < 0 || critical.ratio < 1) return false;
  const auto i = static_cast<std::size_t>(s.first(critical.slot)),
             j = static_cast<std::size_t>(s.second(critical.slot));
  Break b;
  b.slot = critical.slot;
  b.step = state_.step;
  b.x = 0.5 * (start_x_[i] + start_x_[j]);
  b.y = 0.5 * (start_y_[i] + start_y_[j]);
  const double across = std::atan2(s.y[j] - s.y[i], s.x[j] - s.x[i]) + 0.5 * std::numbers::pi;
  b.angle = across - std::numbers::pi * std::floor(across / std::numbers::pi);
  b.ratio = critical.ratio;
  b.margin = (critical.ratio - critical.next) / critical.ratio;
  s.joined[static_cast<std::size_t>(critical.slot)] = 0;
  state_.breaks.push_back(b);
  const int broken[1] = {critical.slot};
  relaxed(solver_->relax(s, forces_, broken));
  return true;
}

void Experiment::close_step() {
  state_.breaking = false;
  const double elastic = elastic_energy(*sheet_, forces_);
  state_.released += state_.energy_loaded - elastic;
  const WallStress wall = wall_stress(*sheet_, forces_);
  Sample sample;
  sample.step = state_.step;
  sample.strain = strain();
  sample.stress_xx = wall.xx;
  sample.stress_yy = wall.yy;
  sample.peak_xx = state_.peak_xx;
  sample.peak_yy = state_.peak_yy;
  sample.elastic = elastic;
  sample.released = state_.released;
  sample.jumped = state_.jumped;
  sample.boundary_work = state_.boundary_work;
  sample.growth_work = state_.growth_work;
  sample.breaks = static_cast<int>(state_.breaks.size());
  sample.iterations = static_cast<int>(solver_->work().solves);
  state_.samples.push_back(sample);
  state_.finished = state_.step >= loading_.steps || failed() || sample.breaks >= loading_.most_breaks;
}

bool Experiment::advance() {
  if (state_.finished) return false;
  solver_->set_threads(pace_.begin(threads_));
  const SolverWork before = solver_->work();
  if (!state_.breaking) {
    load_part();
  } else if (!break_one()) {
    close_step();
  }
  const SolverWork after = solver_->work();
  pace_.done(static_cast<double>(after.solves - before.solves));
  return !state_.finished;
}

void Experiment::run(const std::function<bool(const Experiment&)>& between) {
  while (advance()) {
    if (between && !between(*this)) return;
  }
}

double Experiment::energy_residual() const {
  if (state_.samples.empty()) return 0;
  const Sample& last = state_.samples.back();
  const double work = last.boundary_work + last.growth_work;
  return work == 0 ? 0 : std::fabs(work - last.elastic - last.released - last.jumped) / std::fabs(work);
}

ExperimentState Experiment::snapshot() const {
  ExperimentState copy = state_;
  copy.x = sheet_->x;
  copy.y = sheet_->y;
  copy.radius = sheet_->radius;
  copy.joined = sheet_->joined;
  return copy;
}

void Experiment::restore(const ExperimentState& state) {
  state_ = state;
  sheet_->x = state.x;
  sheet_->y = state.y;
  sheet_->radius = state.radius;
  sheet_->joined = state.joined;
  compute_forces(*sheet_, forces_, threads_);
}

}  // namespace dem::sheet
