// What a run of the sheet leaves behind: tables, results, checks.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "engine/sheet/fractures.h"
#include "engine/sheet/model.h"
#include "engine/sheet/quantities.h"

namespace dem::sheet {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

Table particle_table(const Specimen& specimen) {
  const Sheet& s = specimen.sheet;
  Table t;
  t.name = "particles";
  t.attributes = {{"columns", std::to_string(s.lattice.columns)},
                  {"rows", std::to_string(s.lattice.rows)},
                  {"radius", fmt::format("{}", s.radius0)},
                  {"fixed", "1 held along x, 2 held along y, 3 both"}};
  std::vector<double> position;
  for (std::size_t i = 0; i < s.x.size(); ++i) position.insert(position.end(), {s.x[i], s.y[i]});
  t.add("position", "1", std::move(position), 2);
  t.add("grain", "", s.grain);
  t.add("fixed", "", std::vector<std::int32_t>(s.fixed.begin(), s.fixed.end()));
  return t;
}

// The elastic constant of a grain is that of any spring inside it.
std::vector<double> grain_stiffness(const Specimen& specimen) {
  std::vector<double> k(specimen.grains.size(), nan);
  const Sheet& s = specimen.sheet;
  for (int slot = 0; slot < s.slots(); ++slot) {
    const auto at = static_cast<std::size_t>(slot);
    if (s.stiffness[at] <= 0 || s.between[at] || along_wall(s, slot)) continue;
    k[static_cast<std::size_t>(s.grain[static_cast<std::size_t>(s.first(slot))])] = s.stiffness[at];
  }
  return k;
}

void add_grains(Record& record, const Specimen& specimen) {
  Table grains;
  grains.name = "grains";
  std::vector<std::int32_t> ids;
  std::vector<double> growth, strength;
  for (std::size_t f = 0; f < specimen.map.flynns.size(); ++f) {
    ids.push_back(specimen.map.flynns[f].id);
    growth.push_back(specimen.grains[f].growth - 1);
    strength.push_back(specimen.grains[f].strength);
  }
  grains.add("flynn", "", ids);
  grains.add("stiffness", "1", grain_stiffness(specimen));
  grains.add("strength_factor", "1", std::move(strength));
  grains.add("growth", "1", std::move(growth));
  Table outlines;
  outlines.name = "outlines";
  std::vector<std::int32_t> of;
  std::vector<double> points;
  const double scale = 1 / (specimen.map.high[0] - specimen.map.low[0]);
  const std::vector<std::vector<Point>> cells = sheet::outlines(specimen.map);
  for (std::size_t f = 0; f < cells.size(); ++f) {
    for (const Point& p : cells[f]) {
      of.push_back(static_cast<std::int32_t>(f));
      points.insert(points.end(), {scale * (p[0] - specimen.map.low[0]), scale * (p[1] - specimen.map.low[1])});
    }
  }
  outlines.add("grain", "", std::move(of));
  outlines.add("position", "1", std::move(points), 2);
  record.tables.push_back(std::move(grains));
  record.tables.push_back(std::move(outlines));
}

Table crack_table(const Specimen& specimen, const Experiment& experiment, double step) {
  Table t;
  t.name = "cracks";
  t.attributes = {{"mode", "0 tension"}, {"place", "0 intra grain, 1 inter grain"}};
  const auto& breaks = experiment.state().breaks;
  std::vector<std::int32_t> steps, mode(breaks.size(), 0), place;
  std::vector<double> strain, position, ratio, margin;
  for (const Break& b : breaks) {
    steps.push_back(b.step);
    strain.push_back(b.step * step);
    place.push_back(specimen.sheet.between[static_cast<std::size_t>(b.slot)]);
    position.insert(position.end(), {b.x, b.y});
    ratio.push_back(b.ratio);
    margin.push_back(b.margin);
  }
  std::vector<double> angle;
  for (const Break& b : breaks) angle.push_back(b.angle);
  t.add("step", "", std::move(steps));
  t.add("strain", "1", std::move(strain));
  t.add("mode", "", std::move(mode));
  t.add("place", "", std::move(place));
  t.add("position", "1", std::move(position), 2);
  t.add("angle", "rad", std::move(angle));
  t.add("trend", "rad", trends(breaks, 2 * specimen.sheet.radius0));
  t.add("ratio", "1", std::move(ratio));
  t.add("margin", "1", std::move(margin));
  return t;
}

Crossing crossing_at(const Settings& settings, const Specimen& specimen, const std::vector<Break>& breaks, int step) {
  std::vector<Break> so_far;
  for (const Break& b : breaks) {
    if (b.step <= step) so_far.push_back(b);
  }
  const double height = specimen.map.high[1] - specimen.map.low[1];
  return crossing(so_far, 2 * specimen.sheet.radius0, settings.layer_low * height, settings.layer_high * height);
}

Table history_table(const Settings& settings, const Specimen& specimen, const Experiment& experiment) {
  Table t;
  t.name = "history";
  const auto& samples = experiment.state().samples;
  const auto column = [&](const char* name, auto member, const char* unit = "1") {
    std::vector<double> values;
    for (const Sample& s : samples) values.push_back(static_cast<double>(s.*member));
    t.add(name, unit, std::move(values));
  };
  column("strain", &Sample::strain);
  column("stress_xx", &Sample::stress_xx);
  column("stress_yy", &Sample::stress_yy);
  column("loaded_stress_xx", &Sample::peak_xx);
  column("loaded_stress_yy", &Sample::peak_yy);
  column("breaks", &Sample::breaks);
  column("elastic", &Sample::elastic);
  column("released", &Sample::released);
  column("jumped", &Sample::jumped);
  column("boundary_work", &Sample::boundary_work);
  column("growth_work", &Sample::growth_work);
  if (settings.source != "layers") return t;
  std::vector<double> count, spacing;
  const double thickness = (settings.layer_high - settings.layer_low) * (specimen.map.high[1] - specimen.map.low[1]);
  for (const Sample& s : samples) {
    const Crossing c = crossing_at(settings, specimen, experiment.state().breaks, s.step);
    count.push_back(static_cast<double>(c.places.size()));
    spacing.push_back(c.mean_spacing / thickness);
  }
  t.add("crossing_fractures", "1", std::move(count));
  t.add("spacing_over_thickness", "1", std::move(spacing));
  return t;
}

// Share of trends within 30 degrees of `along` (an angle for each crack); by chance it would be a third.
double share_along(const std::vector<double>& trend, const std::vector<double>& along) {
  int near = 0, all = 0;
  for (std::size_t b = 0; b < trend.size(); ++b) {
    if (!std::isfinite(trend[b]) || !std::isfinite(along[b])) continue;
    ++all;
    near += std::fabs(std::cos(trend[b] - along[b])) > std::sqrt(3.0) / 2 ? 1 : 0;
  }
  return all > 0 ? static_cast<double>(near) / all : nan;
}

// Direction from the centre of the nearest growing grain to each crack.
std::vector<double> radial(const Specimen& specimen, const std::vector<Break>& breaks) {
  std::vector<Point> sum(specimen.grains.size(), Point{0, 0});
  std::vector<int> count(specimen.grains.size(), 0);
  for (std::size_t i = 0; i < specimen.cover.flynn.size(); ++i) {
    const auto f = static_cast<std::size_t>(specimen.cover.flynn[i]);
    sum[f][0] += specimen.sheet.x[i], sum[f][1] += specimen.sheet.y[i], ++count[f];
  }
  std::vector<double> result(breaks.size(), nan);
  for (std::size_t b = 0; b < breaks.size(); ++b) {
    double nearest = 1e9;
    for (std::size_t f = 0; f < sum.size(); ++f) {
      if (specimen.grains[f].growth <= 1 || count[f] == 0) continue;
      const double dx = breaks[b].x - sum[f][0] / count[f], dy = breaks[b].y - sum[f][1] / count[f];
      const double distance = std::hypot(dx, dy);
      if (distance < nearest) nearest = distance, result[b] = std::atan2(dy, dx);
    }
  }
  return result;
}

void add_peak(Record& record, const Experiment& experiment) {
  double peak = 0, strain = 0, before = 0, breaks_before = 0;
  for (const Sample& s : experiment.state().samples) {
    const double now = std::fabs(s.peak_xx - s.peak_yy);
    if (now > peak) peak = now, strain = s.strain, before = breaks_before;
    breaks_before = s.breaks;
  }
  record.put(quantity::peak_differential_stress, peak);
  record.put(quantity::strain_at_peak, strain);
  record.put(quantity::breaks_before_peak, before);
}

// How abruptly the sheet fails: what one load step takes of all broken springs, and of the largest tension on the
// walls.
void add_abruptness(Record& record, const Experiment& experiment) {
  double peak = 0, strain = 0, lost = 0;
  int before = 0, most = 0;
  for (const Sample& s : experiment.state().samples) {
    const double loaded = std::max(s.peak_xx, s.peak_yy);
    if (loaded > peak) peak = loaded, strain = s.strain;
    lost = std::max(lost, loaded - (s.peak_xx > s.peak_yy ? s.stress_xx : s.stress_yy));
    most = std::max(most, s.breaks - before);
    before = s.breaks;
  }
  record.put(quantity::most_breaks_in_a_step, most);
  if (before > 0) record.put(quantity::worst_step_share, static_cast<double>(most) / before);
  if (peak <= 0) return;
  record.put(quantity::peak_tension, peak);
  record.put(quantity::strain_at_peak_tension, strain);
  record.put(quantity::largest_drop_share, lost / peak);
}

void add_checks(Record& record, const Settings& settings, const Experiment& experiment) {
  const auto& e = experiment.state().equilibrium;
  if (settings.solver == "converged") {
    record.checks.push_back(
        {"equilibrium", e.worst, settings.converged.tolerance, e.worst <= settings.converged.tolerance && e.missed == 0,
         "Largest unbalanced force over the largest spring force, after any load step or break; every search for "
         "equilibrium finished. Limit: the solver’s own criterion (solver.tolerance)."});
    const double residual = experiment.energy_residual();
    record.checks.push_back({"energy_residual", residual, 1e-4, residual <= 1e-4,
                             "Work that is neither elastic energy nor released by breaking or jumps, over the work. "
                             "Limit: small beside every term of the ledger."});
  } else {
    record.checks.push_back({"stopping_rule", static_cast<double>(e.missed), 0, e.missed == 0,
                             "Relaxations in which the sweep did not come to its stop. Limit: none."});
  }
}

}  // namespace

Table snapshot_table(const std::string& name, const Specimen& specimen, const Experiment& experiment) {
  const Sheet& s = experiment.sheet();
  const Stress stress = particle_stress(s, experiment.forces());
  Table t;
  t.name = name;
  std::vector<double> displacement, mean, differential;
  for (std::size_t i = 0; i < s.x.size(); ++i) {
    displacement.insert(displacement.end(), {s.x[i] - specimen.sheet.x[i], s.y[i] - specimen.sheet.y[i]});
    mean.push_back(0.5 * (stress.xx[i] + stress.yy[i]));
    differential.push_back(std::hypot(stress.xx[i] - stress.yy[i], 2 * stress.xy[i]));
  }
  t.add("displacement", "1", std::move(displacement), 2);
  t.add("mean_stress", "1", std::move(mean));
  t.add("differential_stress", "1", std::move(differential));
  return t;
}

namespace {

// Largest distance between the distribution function of some values and another.
template <class Function>
double departure(std::vector<double> values, Function of) {
  std::ranges::sort(values);
  const auto n = static_cast<double>(values.size());
  double most = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double there = of(values[i]), below = static_cast<double>(i) / n, above = static_cast<double>(i + 1) / n;
    most = std::max({most, std::abs(there - below), std::abs(there - above)});
  }
  return most;
}

// What the model description says of the disorder and the walls.
void add_distributions(Record& record, const Specimen& specimen) {
  const Sheet& s = specimen.sheet;
  std::vector<double> thresholds, constants;
  for (int slot = 0; slot < s.slots(); ++slot) {
    const auto at = static_cast<std::size_t>(slot);
    if (s.stiffness[at] <= 0 || s.between[at] || !std::isfinite(s.threshold[at])) continue;
    thresholds.push_back(
        s.threshold[at] /
        specimen.grains[static_cast<std::size_t>(s.grain[static_cast<std::size_t>(s.first(slot))])].strength);
  }
  if (!thresholds.empty()) {
    const auto [low, high] = std::ranges::minmax(thresholds);
    if (high > low * (1 + 1e-12))
      record.put(quantity::threshold_departure,
                 departure(std::move(thresholds), [=](double x) { return (x - low) / (high - low); }));
  }
  const std::vector<double> of_grain = grain_stiffness(specimen);
  for (std::size_t g = 0; g < of_grain.size(); ++g) {
    if (std::isfinite(of_grain[g])) constants.push_back(of_grain[g] / specimen.grains[g].stiffness);
  }
  constexpr std::size_t few = 8;
  if (constants.size() >= few) {
    const auto n = static_cast<double>(constants.size());
    double mean = 0, square = 0;
    for (const double k : constants) mean += k / n;
    for (const double k : constants) square += (k - mean) * (k - mean) / (n - 1);
    if (square > 1e-20 * mean * mean) {
      const double deviation = std::sqrt(square);
      record.put(quantity::stiffness_departure, std::sqrt(n) * departure(std::move(constants), [=](double x) {
                                                  return 0.5 *
                                                         std::erfc((mean - x) / (deviation * std::numbers::sqrt2));
                                                }));
    }
  }
  int held = 0;
  for (int i = 0; i < s.particles(); ++i) {
    const int row = i / s.lattice.columns, column = i % s.lattice.columns;
    const bool side = column == 0 || column == s.lattice.columns - 1, end = row == 0 || row == s.lattice.rows - 1;
    const bool along_x = (s.fixed[static_cast<std::size_t>(i)] & 1) != 0,
               along_y = (s.fixed[static_cast<std::size_t>(i)] & 2) != 0;
    held += (end && !side && along_x) + (side && !end && along_y);
  }
  record.put(quantity::held_along_walls, held);
}

// What the model description says of the lattice and of grain boundaries, measured on the sheet as it was made.
void add_description(Record& record, const Specimen& specimen) {
  const Sheet& s = specimen.sheet;
  const std::vector<double> of_grain = grain_stiffness(specimen);
  std::vector<int> springs(s.x.size(), 0);
  double sum[2] = {0, 0}, count[2] = {0, 0}, worst = 0;
  for (int slot = 0; slot < s.slots(); ++slot) {
    const auto at = static_cast<std::size_t>(slot);
    if (s.stiffness[at] <= 0) continue;
    const auto a = static_cast<std::size_t>(s.first(slot)), b = static_cast<std::size_t>(s.second(slot));
    ++springs[a];
    ++springs[b];
    if (along_wall(s, slot)) continue;
    if (std::isfinite(s.threshold[at])) {
      sum[s.between[at]] += s.threshold[at];
      count[s.between[at]] += 1;
    }
    if (!s.between[at]) continue;
    const double mean =
        0.5 * (of_grain[static_cast<std::size_t>(s.grain[a])] + of_grain[static_cast<std::size_t>(s.grain[b])]);
    if (mean > 0) worst = std::max(worst, std::abs(s.stiffness[at] / mean - 1));
  }
  record.put(quantity::most_springs, *std::ranges::max_element(springs));
  add_distributions(record, specimen);
  if (count[0] > 0 && count[1] > 0) {
    record.put(quantity::boundary_threshold_ratio, sum[1] / count[1] / (sum[0] / count[0]));
    record.put(quantity::boundary_stiffness_error, worst);
  }
}

}  // namespace

void add_results(Record& record, const Settings& settings, const Specimen& specimen, const Experiment& experiment,
                 const SolverWork& work) {
  const auto& breaks = experiment.state().breaks;
  record.tables.push_back(particle_table(specimen));
  add_grains(record, specimen);
  record.tables.push_back(crack_table(specimen, experiment, settings.loading.step));
  record.tables.push_back(history_table(settings, specimen, experiment));
  int between = 0, springs = 0;
  for (const Break& b : breaks) between += specimen.sheet.between[static_cast<std::size_t>(b.slot)];
  for (const double k : specimen.sheet.stiffness) springs += k > 0 ? 1 : 0;
  const auto put = [&](const Quantity& quantity, double value) {
    if (std::isfinite(value)) record.put(quantity, value);
  };
  const auto total = static_cast<double>(breaks.size());
  put(quantity::particles, specimen.sheet.particles());
  put(quantity::contacts, springs);
  put(quantity::grains, static_cast<double>(specimen.map.flynns.size()));
  add_description(record, specimen);
  put(quantity::cracks_intra_tension, total - between);
  put(quantity::cracks_inter_tension, between);
  put(quantity::inter_grain_crack_share, total > 0 ? between / total : nan);
  put(quantity::onset_strain, total > 0 ? breaks.front().step * settings.loading.step : nan);
  add_peak(record, experiment);
  put(quantity::final_strain, experiment.strain());
  add_abruptness(record, experiment);
  const std::vector<double> trend = trends(breaks, 2 * specimen.sheet.radius0);
  if (settings.loading.kind == LoadingKind::growth) {
    put(quantity::radial_share, share_along(trend, radial(specimen, breaks)));
  } else {
    const double along = settings.loading.kind == LoadingKind::compression ? 0.0 : std::acos(-1.0) / 2;
    put(settings.loading.kind == LoadingKind::extension ? quantity::across_extension_share
                                                        : quantity::along_compression_share,
        share_along(trend, std::vector<double>(breaks.size(), along)));
  }
  if (settings.source == "layers") {
    const Crossing c = crossing_at(settings, specimen, breaks, experiment.state().step);
    const double thickness = (settings.layer_high - settings.layer_low) * (specimen.map.high[1] - specimen.map.low[1]);
    put(quantity::crossing_fractures, static_cast<double>(c.places.size()));
    put(quantity::spacing_over_thickness, c.mean_spacing / thickness);
    put(quantity::spacing_scatter, c.scatter);
    put(quantity::spacing_scatter_chance, c.chance);
  }
  put(quantity::energy_residual, experiment.energy_residual());
  put(quantity::unbalanced_force, experiment.state().equilibrium.worst);
  put(quantity::load_steps, experiment.state().step);
  put(quantity::jumps, experiment.state().jumps);
  if (const Sample* last = experiment.state().samples.empty() ? nullptr : &experiment.state().samples.back())
    put(quantity::jumped_share, last->jumped / (last->boundary_work + last->growth_work));
  put(quantity::relaxations, static_cast<double>(work.relaxations));
  put(quantity::relaxations_stopped_short, static_cast<double>(experiment.state().equilibrium.missed));
  put(settings.solver == "converged" ? quantity::solves : quantity::sweeps, static_cast<double>(work.solves));
  if (settings.solver == "converged") {
    put(quantity::factorisations, static_cast<double>(work.factorisations));
    put(quantity::patches, static_cast<double>(work.patches));
    put(quantity::settled, static_cast<double>(work.settled));
  }
  add_checks(record, settings, experiment);
  if (breaks.empty()) {
    record.notes.push_back(fmt::format("No spring broke up to a strain of {:.3g} %, where loading.steps ended the run.",
                                       100 * experiment.strain()));
  }
  for (const std::string& note : specimen.map.notes) record.notes.push_back(note);
  if (specimen.cover.holes > 0 || specimen.cover.overlaps > 0) {
    record.notes.push_back(fmt::format(
        "Of {} particles {} lie in no grain (they take their neighbour's) and {} in more than one (they keep the "
        "first); the outlines cover {:.4f} of the cell.",
        specimen.sheet.particles(), specimen.cover.holes, specimen.cover.overlaps, specimen.cover.area_share));
  }
  if (settings.solver == "historical") {
    record.notes.push_back(fmt::format(
        "Made with the historical sweep, which stops before equilibrium: the largest unbalanced force "
        "reached {:.2g} of the largest spring force, and {:.2g} % of the work is unaccounted for. Neither is "
        "checked.",
        experiment.state().equilibrium.worst, 100 * experiment.energy_residual()));
  }
}

}  // namespace dem::sheet
