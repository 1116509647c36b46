#include "engine/texture/loading/loading.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace dem::texture {
namespace {

constexpr double least_peak = 1e5;       // Pa: a test cannot end on the noise before it has begun
constexpr std::int64_t frame_rows = 12;  // samples between kept frames

constexpr std::int64_t isotropic_chunk = 200, settling_steps = 1500;

}  // namespace

LoadingTest::LoadingTest(const Specimen& specimen, const Settings& settings, int threads)
    : settings_(settings),
      gauge_(specimen.packing.position, settings.packing.vessel.height,
             settings.gauge * settings.packing.vessel.height),
      start_(specimen.packing.position),
      assembly_(assembly_input(specimen, settings), threads),
      area_(std::numbers::pi / 4 * settings.packing.vessel.diameter * settings.packing.vessel.diameter),
      height_(settings.packing.vessel.height) {
  if (settings.confining_pressure > 0) {
    const auto ramp = static_cast<std::int64_t>(settings.confining_pressure / settings.confining_step) + 1;
    isotropic_steps_ = ramp + settling_steps;
    assembly_.confine(settings.confining_pressure, ramp);
  } else {
    begin();
  }
}

void LoadingTest::begin() {
  const double speed = 0.5 * settings_.rate * height_ / assembly_.time_step();
  const double sense =
      settings_.test == TestKind::compression ? 1 : -1;  // both ends move, towards each other in compression
  assembly_.drive(sense * speed, -sense * speed, static_cast<std::int64_t>(settings_.ramp_strain / settings_.rate));
}

double LoadingTest::fraction() const {
  if (ended_) return 1;
  if (history_.empty()) return 0;
  const double follow = settings_.follow > 0 ? 2 : 1;
  // Typical strains at the end of such tests; only the estimate of time left hangs on them.
  const double typical = settings_.test == TestKind::compression ? 4.5e-3 : 2.5e-4;
  return std::min(0.95, history_.back().platen_strain / (follow * typical));
}

bool LoadingTest::advance() {
  if (ended_) return false;
  const bool compression = settings_.test == TestKind::compression;
  if (isotropic_steps_ > 0) {
    const std::int64_t chunk = std::min(isotropic_steps_, isotropic_chunk);
    const Sample sample = assembly_.advance(chunk);
    if (!std::isfinite(sample.ledger.kinetic)) {
      throw CaseError("the motion blew up under the confining pressure; a smaller solver.time_step_factor may help");
    }
    isotropic_steps_ -= chunk;
    if (isotropic_steps_ == 0) {
      area_ = std::numbers::pi * sample.jacket_radius * sample.jacket_radius;
      height_ = sample.place[1] - sample.place[0];
      for (std::size_t i = 0; i < start_.size(); ++i) {
        for (std::size_t axis = 0; axis < 3; ++axis) start_[i][axis] = assembly_.poses()[i].v[axis];
      }
      gauge_.restart(start_);
      begin();
    }
    return true;
  }
  const double sense = compression ? -1 : 1;
  const auto steps = std::max<std::int64_t>(1, std::llround(settings_.sample_strain / settings_.rate));
  const Sample sample = assembly_.advance(history_.empty() ? 1 : steps);
  const StrainGauge::Strains strains = gauge_.read(assembly_.poses());

  HistoryRow row;
  row.step = sample.step;
  row.time = sample.time;
  row.platen_strain = sense * ((sample.place[1] - sample.place[0]) / height_ - 1);
  row.axial_strain = sense * strains.axial;
  row.lateral_strain = compression ? -strains.lateral : strains.lateral;
  const double lower = -sense * sample.force[0],
               upper = sense * sample.force[1];  // both positive in the sense of the test
  row.axial_stress = 0.5 * (lower + upper) / area_;
  row.stress_imbalance = (upper - lower) / area_;
  row.confining_pressure = sample.confining_pressure;
  const std::vector<Crack>& cracks = assembly_.cracks();
  for (; counted_ < static_cast<std::int64_t>(cracks.size()); ++counted_) {
    const Crack& c = cracks[static_cast<std::size_t>(counted_)];
    crack_counts_[static_cast<std::size_t>(2 * c.boundary + c.shear)] += 1;
  }
  row.cracks = crack_counts_;
  row.ledger = sample.ledger;
  if (!std::isfinite(row.axial_stress) || !std::isfinite(row.ledger.kinetic)) {
    throw CaseError(
        fmt::format("the motion blew up at step {:.0f}; a smaller solver.time_step_factor may help", row.step));
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

  const std::optional<std::size_t> end_row = end();
  const auto peak = std::ranges::max_element(history_, {}, &HistoryRow::axial_stress);
  ended_ = end_row && row.platen_strain >= settings_.follow * peak->platen_strain;
  return !ended_;
}

std::optional<std::size_t> LoadingTest::end() const {
  std::size_t peak = 0;
  for (std::size_t i = 0; i < history_.size(); ++i) {
    const HistoryRow& row = history_[i];
    if (row.axial_stress > history_[peak].axial_stress) peak = i;
    const HistoryRow& highest = history_[peak];
    if (highest.axial_stress <= least_peak) continue;
    const bool fell = row.axial_stress < settings_.stop * highest.axial_stress;
    const bool far = settings_.test == TestKind::compression &&
                     row.platen_strain > settings_.strain_limit * highest.platen_strain && row.platen_strain > 1e-3;
    if (fell || far) return i;
  }
  return {};
}

}  // namespace dem::texture
