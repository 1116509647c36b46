#include "engine/texture/results.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "engine/texture/genesis/axes.h"
#include "engine/texture/genesis/packing.h"
#include "engine/texture/loading/outcome.h"
#include "engine/texture/quantities.h"

namespace dem::texture {
namespace {

constexpr double residual_limit = 1e-2;   // of max(W, 1e-2 W_peak)
constexpr double imbalance_limit = 0.01;  // difference of the two ends over the peak stress, root mean square
constexpr double servo_limit = 0.01;
constexpr double mega = 1e-6, giga = 1e-9;

std::string words(std::string text) {
  std::replace(text.begin(), text.end(), ' ', '_');
  return text;
}

std::vector<double> flat(const std::vector<Vec3>& points) {
  std::vector<double> out;
  for (const Vec3& p : points) out.insert(out.end(), p.begin(), p.end());
  return out;
}

Table particle_table(const Specimen& specimen, const Settings& settings) {
  std::string minerals;
  for (const Mineral& m : settings.minerals) minerals += (minerals.empty() ? "" : ",") + m.name;
  Table t{"particles",
          {{"minerals", minerals},
           {"diameter", fmt::format("{}", body_of(settings).size[0])},
           {"height", fmt::format("{}", body_of(settings).size[2])},
           {"aspect_ratio", fmt::format("{}", settings.shape.aspect_ratio)},
           {"growth_round", "0 masked by the ellipsoid of its grain, n claimed in round n of growth"}},
          {}};
  t.add("position", "m", flat(specimen.packing.position), 3);
  t.add("radius", "m", specimen.packing.radius);
  t.add("grain", "", specimen.grains.grain);
  t.add("mineral", "", specimen.grains.mineral);
  t.add("growth_round", "", specimen.grains.growth_round);
  return t;
}

/// Unit vector along the long axes of the ellipsoids.
Vec3 long_axis(const GrainShape& shape) {
  return {std::cos(shape.dip) * std::cos(shape.dip_direction), std::cos(shape.dip) * std::sin(shape.dip_direction),
          std::sin(shape.dip)};
}

Table grain_table(const Specimen& specimen, const Settings& settings) {
  const std::size_t n = specimen.seeds.position.size();
  std::vector<std::int32_t> count(n, 0);
  for (const std::int32_t g : specimen.grains.grain) ++count[static_cast<std::size_t>(g)];
  const double lambda = std::cbrt(settings.shape.aspect_ratio);
  std::vector<double> axis, semi_long, semi_short, own_axis, own_long, own_short;
  for (const OwnAxes& own : own_axes(specimen.packing, specimen.grains, n)) {
    own_axis.insert(own_axis.end(), own.axis.begin(), own.axis.end());
    own_long.push_back(own.semi_long);
    own_short.push_back(0.5 * (own.semi_middle + own.semi_short));
  }
  for (std::size_t g = 0; g < n; ++g) {
    for (const double v : long_axis(settings.shape)) axis.push_back(v);
    semi_long.push_back(lambda * lambda * specimen.seeds.radius[g]);
    semi_short.push_back(specimen.seeds.radius[g] / lambda);
  }
  Table t{"grains", {}, {}};
  t.add("centre", "m", flat(specimen.seeds.position), 3);
  t.add("radius", "m", specimen.seeds.radius);
  t.add("mineral", "", specimen.seeds.mineral);
  t.add("axis", "1", std::move(axis), 3);
  t.add("particles", "", std::move(count));
  t.add("semi_long", "m", std::move(semi_long));
  t.add("semi_short", "m", std::move(semi_short));
  t.add("own_axis", "1", std::move(own_axis), 3);  // of the grown grain, from its second moments
  t.add("own_long", "m", std::move(own_long));
  t.add("own_short", "m", std::move(own_short));
  return t;
}

Table contact_table(const Specimen& specimen) {
  std::vector<std::int32_t> pair, kind, place;
  for (const BondSpec& b : specimen.bonds) {
    pair.push_back(b.first);
    pair.push_back(b.second);
    kind.push_back(b.boundary);
    place.push_back(specimen.grains.grain[static_cast<std::size_t>(b.first)] !=
                    specimen.grains.grain[static_cast<std::size_t>(b.second)]);
  }
  Table t{"contacts", {{"kind", "0 flat joint, 1 parallel bond"}, {"place", "0 inside a grain, 1 between grains"}}, {}};
  t.add("pair", "", std::move(pair), 2);
  t.add("kind", "", std::move(kind));
  t.add("place", "", std::move(place));
  return t;
}

// Axial strain at a step, from the history around it.
double strain_at(const std::vector<HistoryRow>& h, double step) {
  const auto after =
      std::lower_bound(h.begin(), h.end(), step, [](const HistoryRow& r, double s) { return r.step < s; });
  if (after == h.begin()) return h.front().axial_strain;
  if (after == h.end()) return h.back().axial_strain;
  const auto before = after - 1;
  const double f = (step - before->step) / (after->step - before->step);
  return before->axial_strain + f * (after->axial_strain - before->axial_strain);
}

// Cracks up to the end of the test; those of a test that was followed further are in its history.
Table crack_table(const Specimen& specimen, const Loading& loading, double last_step) {
  std::vector<double> time, strain, position, normal, area, released, force;
  std::vector<std::int32_t> mode, place, mineral_a, mineral_b, contact;
  for (const Crack& c : loading.assembly().cracks()) {
    if (c.step > last_step) break;
    const BondSpec& bond = specimen.bonds[static_cast<std::size_t>(c.contact)];
    const auto mineral = [&](std::int32_t p) { return specimen.grains.mineral[static_cast<std::size_t>(p)]; };
    time.push_back(c.step * loading.assembly().time_step());
    strain.push_back(strain_at(loading.history(), c.step));
    mode.push_back(c.shear);
    place.push_back(c.boundary);
    position.insert(position.end(), c.position.begin(), c.position.end());
    normal.insert(normal.end(), c.normal.begin(), c.normal.end());
    area.push_back(c.area);
    released.push_back(c.released);
    force.insert(force.end(), c.force.begin(), c.force.end());
    mineral_a.push_back(std::min(mineral(bond.first), mineral(bond.second)));
    mineral_b.push_back(std::max(mineral(bond.first), mineral(bond.second)));
    contact.push_back(c.contact);
  }
  Table t{"cracks", {{"mode", "0 tension, 1 shear"}, {"place", "0 inside a grain, 1 between grains"}}, {}};
  t.add("time", "s", std::move(time));
  t.add("strain", "1", std::move(strain));
  t.add("mode", "", std::move(mode));
  t.add("place", "", std::move(place));
  t.add("position", "m", std::move(position), 3);
  t.add("normal", "1", std::move(normal), 3);
  t.add("area", "m^2", std::move(area));
  t.add("mineral_a", "", std::move(mineral_a));
  t.add("mineral_b", "", std::move(mineral_b));
  t.add("contact", "", std::move(contact));
  t.add("released", "J", std::move(released));  // records made before have neither this nor
  t.add("force", "N", std::move(force), 3);     // what the bond did on its second particle, let go
  return t;
}

Table history_table(const Test& test, const std::vector<HistoryRow>& h) {
  Table t{"history", {}, {}};
  const auto column = [&](const char* name, const char* unit, auto get) {
    std::vector<double> values;
    for (std::size_t i = 0; i < h.size(); ++i) values.push_back(get(i));
    t.add(name, unit, std::move(values));
  };
  column("time", "s", [&](std::size_t i) { return h[i].time; });
  column("step", "1", [&](std::size_t i) { return h[i].step; });
  column("platen_strain", "1", [&](std::size_t i) { return h[i].platen_strain; });
  column("axial_strain", "1", [&](std::size_t i) { return h[i].axial_strain; });
  column("lateral_strain", "1", [&](std::size_t i) { return h[i].lateral_strain; });
  if (test.stretched) column("volumetric_strain", "1", [&](std::size_t i) { return h[i].volumetric_strain(); });
  column("axial_stress", "Pa", [&](std::size_t i) { return h[i].axial_stress; });
  column("stress_imbalance", "Pa", [&](std::size_t i) { return h[i].stress_imbalance; });
  column("confining_pressure", "Pa", [&](std::size_t i) { return h[i].confining_pressure; });
  if (test.loops.first > 0) column("phase", "1", [&](std::size_t i) { return h[i].phase; });
  if (test.mouth > 0 || test.motion == Axis::x) column("opening", "m", [&](std::size_t i) { return h[i].opening; });
  if (test.stretched) column("axial_stiffness", "Pa", [&](std::size_t i) { return axial_stiffness(h, i); });
  const char* classes[] = {"cracks_intra_tension", "cracks_intra_shear", "cracks_inter_tension", "cracks_inter_shear"};
  for (std::size_t k = 0; k < 4; ++k) column(classes[k], "1", [&](std::size_t i) { return h[i].cracks[k]; });
  column("work", "J", [&](std::size_t i) { return h[i].ledger.work; });
  column("elastic", "J", [&](std::size_t i) { return h[i].ledger.elastic; });
  column("kinetic", "J", [&](std::size_t i) { return h[i].ledger.kinetic; });
  column("damping", "J", [&](std::size_t i) { return h[i].ledger.damping; });
  column("friction", "J", [&](std::size_t i) { return h[i].ledger.friction; });
  column("bond_tension", "J", [&](std::size_t i) { return h[i].ledger.bond_tension; });
  column("bond_shear", "J", [&](std::size_t i) { return h[i].ledger.bond_shear; });
  column("residual", "J", [&](std::size_t i) { return h[i].ledger.residual(); });
  return t;
}

// Named moments, each with the nearest kept frame.
void add_snapshots(Record& record, const Loading& loading, const Characteristics& c, std::size_t end) {
  const std::vector<HistoryRow>& h = loading.history();
  std::vector<std::pair<std::string, std::size_t>> moments;
  const auto stress_row = [&](double stress) {
    std::size_t i = 0;
    while (i < c.peak && h[i].axial_stress < stress) ++i;
    return i;
  };
  if (c.damage) {
    const double damage = h[*c.damage].axial_stress, peak = h[c.peak].axial_stress;
    if (c.initiation_stiffness) {
      moments.emplace_back("crack_initiation", *c.initiation_stiffness);
      moments.emplace_back("stable_growth", stress_row(0.5 * (h[*c.initiation_stiffness].axial_stress + damage)));
    }
    moments.emplace_back("damage", *c.damage);
    moments.emplace_back("unstable_growth", stress_row(0.5 * (damage + peak)));
  }
  moments.emplace_back("peak", c.peak);
  for (std::size_t i = c.peak; i <= end; ++i) {
    if (h[i].axial_stress <= 0.9 * h[c.peak].axial_stress) {
      moments.emplace_back("post_peak", i);
      break;
    }
  }
  moments.emplace_back("end", end);
  for (std::size_t k = 0; k < moments.size(); ++k) {
    const auto& [name, row] = moments[k];
    const Frame* nearest = &loading.frames().front();
    for (const Frame& frame : loading.frames()) {
      if (std::abs(static_cast<double>(frame.row) - static_cast<double>(row)) <
          std::abs(static_cast<double>(nearest->row) - static_cast<double>(row))) {
        nearest = &frame;
      }
    }
    const HistoryRow& at = h[row];
    Table t{fmt::format("snapshots/{:04d}", k),
            {{"moment", name},
             {"strain", fmt::format("{:.6g}", at.axial_strain)},
             {"stress", fmt::format("{:.6g}", at.axial_stress)},
             {"cracks", fmt::format("{:.0f}", at.all_cracks())},
             {"displacement_at_strain", fmt::format("{:.6g}", h[static_cast<std::size_t>(nearest->row)].axial_strain)}},
            {}};
    t.add("displacement", "m", std::vector<double>(nearest->displacement.begin(), nearest->displacement.end()), 3);
    record.tables.push_back(std::move(t));
  }
}

void add_specimen_results(Record& record, const Specimen& specimen, const Settings& settings) {
  using namespace quantity;
  std::map<std::pair<std::int32_t, std::int32_t>, double> inter, intra;
  double boundaries = 0;
  for (const BondSpec& b : specimen.bonds) {
    const auto i = static_cast<std::size_t>(b.first), j = static_cast<std::size_t>(b.second);
    const auto pair = std::minmax(specimen.grains.mineral[i], specimen.grains.mineral[j]);
    const bool between_grains = specimen.grains.grain[i] != specimen.grains.grain[j];
    boundaries += between_grains;
    (between_grains ? inter : intra)[{pair.first, pair.second}] += 1;
  }
  const auto contacts = static_cast<double>(specimen.bonds.size());
  if (!settings.one_mineral) record.put(inter_grain_share, boundaries / contacts);
  if (!settings.one_mineral) {
    record.put(realised_ar, realised_aspect_ratio(specimen.packing, specimen.grains, specimen.seeds.radius.size(),
                                                  long_axis(settings.shape)));
  }
  record.put(quantity::coordination, specimen.packing.coordination);
  record.put(quantity::porosity, specimen.packing.porosity);
  std::vector<double> volume(settings.minerals.size(), 0);
  double all = 0;
  for (std::size_t i = 0; i < specimen.packing.radius.size(); ++i) {
    const double v = std::pow(specimen.packing.radius[i], 3);
    volume[static_cast<std::size_t>(specimen.grains.mineral[i])] += v;
    all += v;
  }
  const auto name = [&](std::int32_t m) { return words(settings.minerals[static_cast<std::size_t>(m)].name); };
  for (std::size_t m = 0; m < volume.size(); ++m)
    record.put(mineral_share, name(static_cast<std::int32_t>(m)), volume[m] / all);
  for (const auto& [pair, count] : intra) record.put(contact_share, "intra_" + name(pair.first), count / contacts);
  for (const auto& [pair, count] : inter) {
    record.put(contact_share, "inter_" + name(pair.first) + "_" + name(pair.second), count / contacts);
  }
}

// Coarser specimens are refused (keys.cpp); these are coarse enough to say so.
void add_fineness(Record& record, const Specimen& specimen, const Settings& settings) {
  constexpr double enough_across = 10, enough_in_grain = 10;
  const double particle = settings.packing.radius_min * (1 + settings.packing.radius_ratio);
  const double across = body_of(settings).smallest() / particle;
  if (across < enough_across) {
    record.notes.push_back(
        fmt::format("Only {:.1f} particles lie across the specimen; at least {:.0f} are needed for an interior free of "
                    "end and surface effects.",
                    across, enough_across));
  }
  const double in_grain =
      static_cast<double>(specimen.packing.radius.size()) / static_cast<double>(specimen.seeds.radius.size());
  if (!settings.one_mineral && in_grain < enough_in_grain) {
    record.notes.push_back(
        fmt::format("Grains average {:.1f} particles; at least {:.0f} are needed to resolve their shape.", in_grain,
                    enough_in_grain));
  }
}

// What is read off the curve up to its largest stress.
void add_characteristics(Record& record, const Test& test, const std::vector<HistoryRow>& h, const Characteristics& c) {
  if (!test.stretched) return;
  if (c.young_modulus) {
    record.put(quantity::young_modulus, *c.young_modulus * giga);
  } else if (c.gauge_share < 0.5 || c.gauge_share > 2) {
    record.notes.push_back(fmt::format(
        "There is no Young’s modulus: while the stress rose from 10 to 30 % of its peak, the strain of the gauge was "
        "{:.2g} of that of the ends. The test is over before the ends have reached its middle; load it more slowly.",
        c.gauge_share));
  }
  if (c.poisson_ratio) record.put(quantity::poisson_ratio, *c.poisson_ratio);
  if (c.initiation_stiffness) {
    record.put(quantity::initiation_by_stiffness, h[*c.initiation_stiffness].axial_stress * mega);
    record.put(quantity::initiation_strain, h[*c.initiation_stiffness].axial_strain);
  }
  if (c.stress_at_strain) record.put(quantity::stress_at_strain, *c.stress_at_strain * mega);
  if (c.initiation_cracks) {
    record.put(quantity::initiation_by_cracks, h[*c.initiation_cracks].axial_stress * mega);
  }
  if (c.initiation_volume) record.put(quantity::initiation_by_volume, h[*c.initiation_volume].axial_stress * mega);
  if (c.damage) {
    record.put(quantity::crack_damage, h[*c.damage].axial_stress * mega);
    record.put(quantity::crack_damage_strain, h[*c.damage].axial_strain);
  }
}

// The largest stress of a test that has ended by its rules; of one that was given up, what is known instead.
void add_strength(Record& record, const Test& test, const Loading& loading, const Characteristics& c) {
  const std::vector<HistoryRow>& h = loading.history();
  const std::string_view limit = limit_reached(h, test.ending);
  if (loading.end()) {
    if (!test.strength.id.empty()) record.put(test.strength, h[c.peak].axial_stress * mega);
    if (test.stretched) record.put(quantity::peak_strain, h[c.peak].axial_strain);
    if (test.ending.follow > 0 && test.crack_stages && limit.empty()) {
      // Mean over the last twentieth of the strain.
      double sum = 0, count = 0;
      for (const HistoryRow& r : h) {
        if (r.platen_strain < 0.95 * h.back().platen_strain) continue;
        sum += r.axial_stress;
        count += 1;
      }
      record.put(quantity::residual_over_peak, sum / count / h[c.peak].axial_stress);
    } else if (!limit.empty() && (test.ending.follow > 0 || test.ending.follow_strain > 0)) {
      record.notes.push_back(
          fmt::format("After its peak the test was followed to a strain of {:.3g} % and not to {}: {}.{} was reached.",
                      100 * h.back().platen_strain,
                      test.ending.follow > 0 ? fmt::format("{:g} times that of the peak", test.ending.follow)
                                             : fmt::format("{:.3g} %", 100 * test.ending.follow_strain),
                      test.name, limit));
    }
    return;
  }
  record.notes.push_back(
      fmt::format("No strength was found up to a strain of {:.3g} % ({:.0f} steps), where {}.{} ended the test: the "
                  "largest stress was {:.3g} MPa at {:.3g} %, {}.",
                  100 * h.back().platen_strain, h.back().step - h.front().step, test.name, limit,
                  h[c.peak].axial_stress * mega, 100 * h[c.peak].platen_strain,
                  h[c.peak].axial_stress > least_peak ? "and what followed is no failure"
                                                      : "too small to tell a failure (0.1 MPa)"));
}

// Loading must be slow beside the waves that carry a change through the specimen.
void add_rate_check(Record& record, const Specimen& specimen, const Settings& settings, const Characteristics& c) {
  double mass = 0;
  for (std::size_t i = 0; i < specimen.packing.radius.size(); ++i) {
    const auto mineral = static_cast<std::size_t>(specimen.grains.mineral[i]);
    mass += settings.minerals[mineral].density * 4 / 3 * std::numbers::pi * std::pow(specimen.packing.radius[i], 3);
  }
  const double length = body_of(settings).size[settings.test.motion == Axis::x ? 0 : 2];
  const double share = kinetic_share(c, length, mass);
  const double bias = rate_bias(share, settings.test.rate_sensitivity, settings.test.stretched);
  constexpr double usual = 0.03;
  if (bias > usual && bias <= settings.rate_bias) {
    record.notes.push_back(fmt::format(
        "Loaded fast: strengths are some {:.0f} % above those of slow loading (measure.rate_bias lets {:g} % pass).",
        100 * bias, 100 * settings.rate_bias));
  }
  record.checks.push_back(
      {"quasi_static", bias, settings.rate_bias, bias <= settings.rate_bias,
       "Share by which the rate of loading moves the strength, and Young’s modulus where one is read, estimated "
       "from the kinetic energy that the motion of what loads the specimen gives it, over the "
       "elastic energy between 10 and 50 % of the peak. Limit: the key measure.rate_bias, 0.03 "
       "unless the scenario sets it."});
}

void add_specimen_tables(Record& record, const Specimen& specimen, const Settings& settings) {
  record.tables.push_back(particle_table(specimen, settings));
  record.tables.push_back(grain_table(specimen, settings));
  record.tables.push_back(contact_table(specimen));
}

}  // namespace

void add_specimen(Record& record, const Specimen& specimen, const Settings& settings) {
  add_fineness(record, specimen, settings);
  add_specimen_results(record, specimen, settings);
  const auto& rounds = specimen.grains.growth_round;
  const auto n = static_cast<double>(rounds.size());
  record.put(quantity::gap_share,
             static_cast<double>(std::ranges::count_if(rounds, [](std::int32_t r) { return r > 0; })) / n);
  record.put(quantity::growth_rounds, rounds.empty() ? 0.0 : static_cast<double>(std::ranges::max(rounds)));
  record.put(quantity::floaters_removed, specimen.packing.floaters_removed);
  record.put(quantity::particles, n);
  record.put(quantity::contacts, static_cast<double>(specimen.bonds.size()));
  record.put(quantity::grains, static_cast<double>(specimen.seeds.radius.size()));
  constexpr double limit = 5e-3;
  const double wanted = settings.packing.pressure;
  const double departure = std::abs(specimen.packing.pressure / wanted - 1);
  record.checks.push_back({"packing_pressure", departure, limit, departure <= limit,
                           "Departure of the wall pressure of the packing at rest from the material pressure, over "
                           "that pressure. Limit: below the 2 % by which another seed moves the modulus."});
  add_specimen_tables(record, specimen, settings);
}

void add_test(Record& record, const Specimen& specimen, const Settings& settings, const Loading& loading) {
  const Test& test = settings.test;
  const std::vector<HistoryRow>& h = loading.history();
  const double confining = test.confining_pressure;
  const Characteristics c = characterise(h, settings.stiffness_departure, test.crack_stages, confining);
  const std::size_t end = loading.end().value_or(h.size() - 1);
  // Below the noise there is nothing to divide by, and nothing to read off.
  const bool loaded = loading.end() || h[c.peak].axial_stress > least_peak;
  if (loaded) add_characteristics(record, test, h, c);
  add_strength(record, test, loading, c);
  if (test.read_off) test.read_off(test, {specimen, settings, loading, c, end}, record);
  add_fineness(record, specimen, settings);
  add_specimen_results(record, specimen, settings);
  for (std::size_t k = 0; k < 4; ++k) record.put(quantity::cracks[k], h[end].cracks[k]);
  for (std::size_t k = 0; k < 4; ++k) record.put(quantity::cracks_at_peak[k], h[c.peak].cracks[k]);

  // A specimen that never bore a load has no work to divide by either: then that of the noise.
  const double least_work =
      loaded ? 0 : 0.5 * least_peak * least_peak / settings.minerals.front().modulus * body_of(settings).volume();
  double peak_work = 0, residual = 0, squares = 0, largest = 0;
  for (const HistoryRow& r : h) {
    peak_work = std::max(peak_work, r.ledger.work);
    const double scale = std::max({r.ledger.work, 1e-2 * peak_work, least_work});
    if (scale > 0) residual = std::max(residual, std::abs(r.ledger.residual()) / scale);
  }
  // The root mean square measures how fast the specimen is loaded: it falls with the rate. The largest value does not: it
  // is the wave of the one crack whose moment was sampled, 1 to 2 % of the peak stress also in very slow loading.
  for (std::size_t i = 0; i <= c.peak; ++i) {
    const double share = h[i].stress_imbalance / h[c.peak].axial_stress;
    squares += share * share;
    largest = std::max(largest, std::abs(share));
  }
  const double imbalance = std::sqrt(squares / static_cast<double>(c.peak + 1));
  double servo = 0;
  for (std::size_t i = 0; i <= end && confining > 0; ++i) {
    servo = std::max(servo, std::abs(h[i].confining_pressure / confining - 1));
  }
  if (confining > 0) record.put(quantity::servo_error, servo);
  record.put(quantity::energy_residual, residual);
  if (loaded) {
    record.put(quantity::stress_imbalance, imbalance);
    record.put(quantity::largest_stress_imbalance, largest);
  }
  record.put(quantity::steps, h.back().step + 1);
  record.put(quantity::particles, static_cast<double>(specimen.packing.radius.size()));
  record.put(quantity::contacts, static_cast<double>(specimen.bonds.size()));
  record.put(quantity::grains, static_cast<double>(specimen.seeds.radius.size()));
  record.put(quantity::fresh_contacts, static_cast<double>(loading.assembly().fresh_contacts()));
  record.put(quantity::time_step, loading.assembly().time_step());

  record.checks.push_back(
      {"energy_residual", residual, residual_limit, residual <= residual_limit,
       "Largest residual of the energy account over the work done on the specimen from outside, taken "
       "as at least 1 % of its largest value, over all samples. Limit: ten times what sound "
       "tests reach; a time step that is too long exceeds it."});
  if (loaded) {
    record.checks.push_back(
        {"equilibrium", imbalance, imbalance_limit, imbalance <= imbalance_limit,
         "Root mean square difference of the stresses at the two loaded sides (ends, platens, strips or "
         "halves of the box) up to the peak, over the peak stress. Limit: so low that it does not matter at "
         "which side the strength is read."});
    add_rate_check(record, specimen, settings, c);
  }

  if (confining > 0) {
    record.checks.push_back(
        {"servo", servo, servo_limit, servo <= servo_limit,
         "Largest departure of the confining pressure from its set value, over that value, over all samples to the end "
         "of loading. Limit: a third of the 3 % by which another seed moves the strength."});
  }

  add_specimen_tables(record, specimen, settings);
  record.tables.push_back(crack_table(specimen, loading, h[end].step));
  record.tables.push_back(history_table(test, h));
  add_snapshots(record, loading, c, end);
}

}  // namespace dem::texture
