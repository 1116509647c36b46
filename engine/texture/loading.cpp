#include "engine/texture/loading.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace dem::texture {
namespace {

constexpr double least_peak = 1e5;      // Pa: a test cannot end on the noise before it has begun
constexpr std::int64_t frame_rows = 12; // samples between kept frames

double area(const Settings& s) { return std::numbers::pi / 4 * s.packing.vessel.diameter * s.packing.vessel.diameter; }

}  // namespace

LoadingTest::LoadingTest(const Specimen& specimen, const Settings& settings, int threads)
    : settings_(settings),
      gauge_(specimen.packing.position, settings.packing.vessel.height, settings.gauge * settings.packing.vessel.height),
      start_(specimen.packing.position), assembly_(assembly_input(specimen, settings), threads) {
  const double speed = 0.5 * settings.rate * settings.packing.vessel.height / assembly_.time_step();
  const double sense = settings.test == TestKind::compression ? 1 : -1;  // both ends move, towards each other in compression
  assembly_.drive(sense * speed, -sense * speed, static_cast<std::int64_t>(settings.ramp_strain / settings.rate));
}

double LoadingTest::fraction() const {
  if (ended_) return 1;
  if (history_.empty()) return 0;
  // Typical strains at the end of such tests; only the estimate of time left hangs on them.
  const double typical = settings_.test == TestKind::compression ? 4.5e-3 : 2.5e-4;
  return std::min(0.95, history_.back().platen_strain / typical);
}

bool LoadingTest::advance() {
  if (ended_) return false;
  const bool compression = settings_.test == TestKind::compression;
  const double sense = compression ? -1 : 1, height = settings_.packing.vessel.height;
  const auto steps = std::max<std::int64_t>(1, std::llround(settings_.sample_strain / settings_.rate));
  const Sample sample = assembly_.advance(history_.empty() ? 1 : steps);
  const StrainGauge::Strains strains = gauge_.read(assembly_.poses());

  HistoryRow row;
  row.step = sample.step;
  row.time = sample.time;
  row.platen_strain = sense * ((sample.place[1] - sample.place[0]) / height - 1);
  row.axial_strain = sense * strains.axial;
  row.lateral_strain = compression ? -strains.lateral : strains.lateral;
  const double lower = -sense * sample.force[0], upper = sense * sample.force[1];  // both positive in the sense of the test
  row.axial_stress = 0.5 * (lower + upper) / area(settings_);
  row.stress_imbalance = (upper - lower) / area(settings_);
  const std::vector<Crack>& cracks = assembly_.cracks();
  for (; counted_ < static_cast<std::int64_t>(cracks.size()); ++counted_) {
    const Crack& c = cracks[static_cast<std::size_t>(counted_)];
    crack_counts_[static_cast<std::size_t>(2 * c.boundary + c.shear)] += 1;
  }
  row.cracks = crack_counts_;
  row.ledger = sample.ledger;
  if (!std::isfinite(row.axial_stress) || !std::isfinite(row.ledger.kinetic)) {
    throw CaseError(fmt::format("the motion blew up at step {:.0f}; a smaller solver.time_step_factor may help", row.step));
  }
  if (history_.size() % frame_rows == 0) {
    Frame frame;
    frame.row = static_cast<std::int64_t>(history_.size());
    for (std::size_t i = 0; i < start_.size(); ++i) {
      for (std::size_t axis = 0; axis < 3; ++axis) {
        frame.displacement.push_back(static_cast<float>(assembly_.poses()[i].v[axis] - start_[i][axis]));
      }
    }
    frames_.push_back(std::move(frame));
  }
  history_.push_back(row);

  const auto peak = std::max_element(history_.begin(), history_.end(), [](const HistoryRow& a, const HistoryRow& b) {
    return a.axial_stress < b.axial_stress;
  });
  const bool fell = peak->axial_stress > least_peak && row.axial_stress < settings_.stop * peak->axial_stress;
  const bool far = peak->axial_stress > least_peak && row.platen_strain > settings_.strain_limit * peak->platen_strain &&
                   row.platen_strain > 1e-3;
  ended_ = fell || (compression && far);
  return !ended_;
}

}  // namespace dem::texture
