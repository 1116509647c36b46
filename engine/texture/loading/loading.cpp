#include "engine/texture/loading/loading.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace dem::texture {
namespace {

constexpr std::int64_t frame_rows = 12;    // samples between kept frames
constexpr std::int64_t stage_chunk = 200;  // steps between looks at a stage without samples

void check(bool sound, const std::string& where) {
  if (!sound) throw CaseError("the motion blew up " + where + "; a smaller solver.time_step_factor may help");
}

}  // namespace

Loading::Loading(const Specimen& specimen, const Settings& settings, int threads)
    : test_(settings.test),
      gauge_(specimen.packing.position,
             [&, body = body_of(settings)](const Vec3& at) { return test_.in_gauge(body, settings.gauge, at); }),
      mouth_(test_.mouth > 0 ? specimen.packing.position : std::vector<Vec3>(), test_.mouth),
      start_(specimen.packing.position),
      assembly_(assembly_input(specimen, settings), threads),
      section_(test_.section(body_of(settings))) {
  if (test_.before) {
    stage_steps_ = test_.before->begin(test_, assembly_);
  } else {
    begin();
  }
}

// The ends start to move.
void Loading::begin() {
  drive(test_.sense);
  loop_.next = test_.loops.first;
}

void Loading::drive(double sense) {
  const double speed = 0.5 * test_.rate * section_.length / assembly_.time_step();
  assembly_.drive(-sense * speed, sense * speed, static_cast<std::int64_t>(test_.ramp_strain / test_.rate));
}

// The phase of a sample, and whether the ends turn after it.
void Loading::go_round(HistoryRow& row) {
  if (loop_.phase == 2 && row.platen_strain >= loop_.strain) loop_.phase = 0;
  row.phase = loop_.phase;
  if (loop_.phase == 0 && row.platen_strain >= loop_.next && row.axial_stress > least_peak) {
    loop_ = {1, row.platen_strain, row.axial_stress, row.platen_strain + test_.loops.every};
    drive(-test_.sense);
  } else if (loop_.phase == 1 && row.axial_stress <= test_.loops.low * loop_.stress) {
    loop_.phase = 2;
    drive(test_.sense);
  }
}

double Loading::fraction() const {
  if (ended_) return 1;
  if (history_.empty()) return 0;
  const Ending& ending = test_.ending;
  const double strain = history_.back().platen_strain, steps = history_.back().step - history_.front().step;
  // Where the test will end is a guess: a quarter further than here at least, and its limit at most.
  double last = std::max((ending.follow > 0 ? 2 : 1) * test_.typical_strain, 1.25 * strain);
  if (ending.follow > 0 && end()) {
    last = ending.follow * std::ranges::max_element(history_, {}, &HistoryRow::axial_stress)->platen_strain;
  }
  if (ending.follow_strain > 0) last = end() ? ending.follow_strain : std::max(last, ending.follow_strain);
  if (ending.largest_strain > 0) last = std::min(last, ending.largest_strain);
  double done = strain / last;
  if (ending.most_steps > 0) done = std::max(done, steps / static_cast<double>(ending.most_steps));
  return std::clamp(done, 0.0, 0.99);
}

bool Loading::advance() {
  if (ended_) return false;
  if (stage_steps_ > 0) {
    go_through_stage();
    return true;
  }
  const auto steps = std::max<std::int64_t>(1, std::llround(test_.sample_strain / test_.rate));
  HistoryRow row = row_of(assembly_.advance(history_.empty() ? 1 : steps));
  check(std::isfinite(row.axial_stress) && std::isfinite(row.ledger.kinetic), fmt::format("at step {:.0f}", row.step));
  if (history_.size() % frame_rows == 0) frames_.push_back(frame());
  if (test_.loops.first > 0) go_round(row);
  history_.push_back(row);
  ended_ = is_over(history_, test_.ending);
  return !ended_;
}

void Loading::go_through_stage() {
  const std::int64_t chunk = std::min(stage_steps_, stage_chunk);
  const Sample sample = assembly_.advance(chunk);
  check(std::isfinite(sample.ledger.kinetic), fmt::format("under the {}", test_.before->words));
  stage_steps_ -= chunk;
  if (stage_steps_ > 0) return;
  if (test_.before->end) section_ = test_.before->end(sample);
  rise_ = sample.rise;
  for (std::size_t i = 0; i < start_.size(); ++i) {
    for (std::size_t axis = 0; axis < 3; ++axis) start_[i][axis] = assembly_.poses()[i].v[axis];
  }
  gauge_.restart(start_);
  begin();
}

HistoryRow Loading::row_of(const Sample& sample) {
  const double sense = test_.sense;
  const auto [x, y, z] = gauge_.read(assembly_.poses());
  HistoryRow row;
  row.step = sample.step;
  row.time = sample.time;
  row.platen_strain = sense * ((sample.place[1] - sample.place[0]) / section_.length - 1);
  row.axial_strain = test_.gauge == Gauge::along ? sense * z : x;
  row.lateral_strain = test_.gauge == Gauge::along ? sense * (0.5 * (x + y)) : z;
  // Both are positive in the sense of the test.
  const double lower = -sense * sample.force[0], upper = sense * sample.force[1];
  row.axial_stress = 0.5 * (lower + upper) / section_.area;
  row.stress_imbalance = (upper - lower) / section_.area;
  row.confining_pressure = sample.confining_pressure;
  row.opening = test_.motion == Axis::x ? sample.rise - rise_ : mouth_.read(assembly_.poses());
  if (test_.motion == Axis::x) row.confining_pressure = sample.normal_force / section_.area;
  const std::vector<Crack>& cracks = assembly_.cracks();
  for (; counted_ < static_cast<std::int64_t>(cracks.size()); ++counted_) {
    const Crack& c = cracks[static_cast<std::size_t>(counted_)];
    crack_counts_[static_cast<std::size_t>(2 * c.boundary + c.shear)] += 1;
  }
  row.cracks = crack_counts_;
  row.ledger = sample.ledger;
  return row;
}

Frame Loading::frame() const {
  Frame frame;
  frame.row = static_cast<std::int64_t>(history_.size());
  for (std::size_t i = 0; i < start_.size(); ++i) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      frame.displacement.push_back(static_cast<float>(assembly_.poses()[i].v[axis] - start_[i][axis]));
    }
  }
  return frame;
}

}  // namespace dem::texture
