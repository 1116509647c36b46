#include "engine/lattice/loading.h"

#include <algorithm>
#include <cmath>

#include "engine/core/errors.h"

namespace dem::lattice {
namespace {

constexpr std::int64_t regular_rows = 4000;  // of history kept between events
constexpr std::int64_t dense_rows = 30000;   // beyond, every tenth step is kept

// Motion of the planes along +axis that loads in the sense of the test.
struct Drift {
  double low, high;
};
Drift drift_of(const Loading& l) {
  const double out = l.kind == TestKind::tension ? l.motion : -l.motion;
  return {l.both ? -out : 0.0, out};
}

int other_axis(int axis, int which) { return which == 0 ? (axis == 0 ? 1 : 0) : (axis == 2 ? 1 : 2); }

ElasticPoint point_of(const Sample& s, double area) {
  ElasticPoint p;
  p.strain = s.strain;
  p.between_planes = s.between_planes;
  p.young_modulus = 0.5 * (s.force[0] + s.force[1]) / area / s.strain;
  for (std::size_t i = 0; i < 2; ++i) p.poisson[i] = -s.lateral[i] / s.strain;
  return p;
}

}  // namespace

double cross_section(const Block& block, int axis) {
  const auto box = block.extent();
  return box[static_cast<std::size_t>(other_axis(axis, 0))] * box[static_cast<std::size_t>(other_axis(axis, 1))];
}

StrengthTest::StrengthTest(const Block& block, const Setup& setup, const Loading& loading)
    : setup_(setup),
      loading_(loading),
      solver_(block, setup),
      area_(cross_section(block, setup.axis)),
      length_(block.extent()[static_cast<std::size_t>(setup.axis)]) {}

double StrengthTest::stress(const Sample& s) const {
  const double tension = 0.5 * (s.force[0] + s.force[1]) / area_;
  return loading_.kind == TestKind::tension ? tension : -tension;
}

// 1: every time step; 0: only loading steps.
int StrengthTest::stride() const {
  const auto& cracks = solver_.cracks();
  const std::int64_t now = solver_.step();
  const auto since = [&](std::int64_t steps) {
    std::int64_t n = 0;
    for (auto c = cracks.rbegin(); c != cracks.rend() && c->step >= now - steps && n < loading_.burst; ++c) ++n;
    return n;
  };
  const bool lately_failed = failed() && now - failed_at_ < 2000;
  if (since(100) >= loading_.burst || lately_failed) return dense_ < dense_rows ? 1 : 10;
  return since(400) > 0 ? 10 : 0;
}

void StrengthTest::take(const Sample& s, bool keep) {
  const double now = stress(s);
  work_ = std::max(work_, s.work);
  elastic_peak_ = std::max(elastic_peak_, s.elastic());
  if (s.work > 0) residual_ = std::max(residual_, std::abs(s.imbalance()) / std::max(s.work, 1e-3 * work_));
  if (friction_from_ < 0 && s.frictional > 1e-6 * s.work && s.frictional > 0) friction_from_ = s.step;
  if (s.opening + s.sliding == 0) {
    kinetic_before_ += s.kinetic;
    elastic_before_ += s.elastic();
  }
  if (now > peak_stress_) {
    peak_stress_ = now;
    peak_ = s;
  }
  const double fallen = loading_.kind == TestKind::tension ? 0.1 : 0.5;
  if (!failed() && s.opening + s.sliding > 0 && now < fallen * peak_stress_) failed_at_ = s.step;
  last_stress_ = now;
  if (keep) history_.push_back(s);
}

bool StrengthTest::advance() {
  if (over_) return false;
  const Drift drift = drift_of(loading_);
  const std::int64_t every = std::max<std::int64_t>(1, loading_steps_ / regular_rows);
  take(solver_.sampled_step(drift.low, drift.high), loading_steps_ % every == 0);
  int left = loading_.settle - 1;
  while (left > 0) {
    const int each = stride();
    if (each == 0) {
      left -= solver_.run(left, 0, 0, true);
    } else {
      if (each > 1) left -= solver_.run(std::min(left, each - 1), 0, 0, true);
      if (left > 0) {
        take(solver_.sampled_step(), true);
        ++dense_;
        --left;
      }
    }
  }
  ++loading_steps_;
  if (failed() ? solver_.step() - failed_at_ > loading_.after : !given_up().empty()) over_ = true;
  if (!std::isfinite(last_stress_)) throw CaseError("the motion is not finite any more");
  return !over_;
}

std::string_view StrengthTest::given_up() const {
  if (failed()) return {};
  if (loading_.largest_strain > 0 && std::abs(solver_.strain()) > loading_.largest_strain)
    return "loading.largest_strain";
  return loading_.most_steps > 0 && solver_.step() >= loading_.most_steps ? "loading.most_steps" : "";
}

double StrengthTest::rate_bias() const {
  constexpr double of_speed = 4.5, of_step = 3;
  const double step = (loading_.both ? 2 : 1) * loading_.motion / length_, peak = std::abs(peak_.between_planes);
  const double speed = elastic_before_ > 0 ? std::sqrt(kinetic_before_ / elastic_before_) : 0;
  return std::max(of_speed * speed, peak > 0 ? of_step * step / peak : 0);
}

StrengthTest::State StrengthTest::state() const {
  return {solver_.state(),
          history_,
          peak_,
          {peak_stress_, last_stress_, residual_, work_, elastic_peak_, kinetic_before_, elastic_before_},
          {loading_steps_, dense_, failed_at_, friction_from_, over_ ? 1 : 0}};
}

void StrengthTest::restore(const State& s) {
  solver_.restore(s.solver);
  history_ = s.history;
  peak_ = s.peak;
  peak_stress_ = s.numbers.at(0);
  last_stress_ = s.numbers.at(1);
  residual_ = s.numbers.at(2);
  work_ = s.numbers.at(3);
  elastic_peak_ = s.numbers.at(4);
  kinetic_before_ = s.numbers.at(5);
  elastic_before_ = s.numbers.at(6);
  loading_steps_ = s.counts.at(0);
  dense_ = s.counts.at(1);
  failed_at_ = s.counts.at(2);
  friction_from_ = s.counts.at(3);
  over_ = s.counts.at(4) != 0;
}

std::vector<ElasticPoint> elastic_at_rest(const Block& block, Setup setup, const std::vector<double>& strains,
                                          const Tick& tick) {
  setup.unbreakable = true;
  setup.time_step = 0.5 * stable_time_step(setup.micro);
  setup.viscosity *= 2;
  Solver solver(block, setup);
  const double length = block.extent()[static_cast<std::size_t>(setup.axis)];
  const double area = cross_section(block, setup.axis);
  // Displacements along the way are path dependent through the rotation of the shear springs: no step above 2e-5.
  constexpr double largest_step = 2e-5;
  constexpr int most_tries = 8;  // of one strain of the list
  std::vector<ElasticPoint> points;
  int restless = 0;
  double reached = 0, yield = 1;  // strain of the block per strain between the planes
  for (const double target : strains) {
    const int parts = std::max(1, static_cast<int>(std::ceil((target - reached) / largest_step)));
    for (int part = 1, tries = 0; part <= parts;) {
      const double to = reached + (target - reached) * part / parts;
      const double motion = 0.5 * length * (to + solver.strain()) / yield;
      const double before = solver.strain();
      solver.run(1, motion, -motion);
      Sample s;
      bool rests = false;
      for (int round = 0; round < 200 && !rests; ++round) {
        tick(to / strains.back());
        solver.run(part == parts ? 200 : 100);
        s = solver.sampled_step();
        // At a turning point it is below zero: the mean of two steps, see solver.h.
        rests = std::abs(s.kinetic) < (part == parts ? 1e-18 : 1e-10) * s.elastic();
      }
      if (!rests) ++restless;
      yield *= (before - s.strain) / (to + before);
      // How much of it the springs at the planes take is known after the first motion only.
      if (rests && std::abs(to + s.strain) > 0.01 * to && ++tries < most_tries) continue;
      if (part == parts) {
        points.push_back(point_of(s, area));
        points.back().restless = restless;
      }
      ++part;
    }
    reached = target;
  }
  return points;
}

std::vector<ElasticPoint> elastic_by_steps(const Block& block, Setup setup, const Loading& loading,
                                           const std::vector<double>& strains, const Tick& tick) {
  setup.unbreakable = true;
  Solver solver(block, setup);
  const Drift drift = drift_of(loading);
  const double area = cross_section(block, setup.axis);
  std::vector<ElasticPoint> points;
  while (points.size() < strains.size() && (loading.most_steps == 0 || solver.step() < loading.most_steps)) {
    const Sample s = solver.sampled_step(drift.low, drift.high);
    while (points.size() < strains.size() && std::abs(s.strain) >= strains[points.size()])
      points.push_back(point_of(s, area));
    solver.run(loading.settle - 1);
    tick(std::abs(s.strain) / strains.back());
  }
  return points;
}

}  // namespace dem::lattice
