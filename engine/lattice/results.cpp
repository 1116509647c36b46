// What a finished case leaves behind: tables, results, checks.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "engine/lattice/model.h"
#include "engine/lattice/quantities.h"

namespace dem::lattice {
namespace {

std::size_t at(std::int64_t i) { return static_cast<std::size_t>(i); }

// Stress and strain of samples as the scenario defines them, positive in the sense of the test.
struct StressStrain {
  double area, sense;
  Gauge gauge;
  StressStrain(const Settings& s, const Block& b)
      : area(section_area(b, s.setup.axis, s.section)), sense(s.test == "tension" ? 1 : -1), gauge(s.gauge) {}
  double stress(const Sample& s) const { return sense * 0.5 * (s.force[0] + s.force[1]) / area; }
  double strain(const Sample& s) const { return sense * (gauge == Gauge::planes ? s.between_planes : s.strain); }
};

template <class Get>
std::vector<double> column(const std::vector<Sample>& history, Get get) {
  std::vector<double> values;
  values.reserve(history.size());
  for (const Sample& s : history) values.push_back(get(s));
  return values;
}

Table history_table(const std::vector<Sample>& h, const StressStrain& m) {
  Table t{"history",
          {{"stress", "positive in the sense of the test"}, {"lateral", "strains across the two other axes"}},
          {}};
  t.add("time", "s", column(h, [](const Sample& s) { return s.time; }));
  t.add("axial_strain", "1", column(h, [&](const Sample& s) { return m.strain(s); }));
  t.add("lateral_strain_1", "1", column(h, [](const Sample& s) { return s.lateral[0]; }));
  t.add("lateral_strain_2", "1", column(h, [](const Sample& s) { return s.lateral[1]; }));
  t.add("axial_stress", "Pa", column(h, [&](const Sample& s) { return m.stress(s); }));
  t.add("stress_low_plane", "Pa", column(h, [&](const Sample& s) { return m.sense * s.force[0] / m.area; }));
  t.add("stress_high_plane", "Pa", column(h, [&](const Sample& s) { return m.sense * s.force[1] / m.area; }));
  t.add("work", "J", column(h, [](const Sample& s) { return s.work; }));
  t.add("elastic_normal", "J", column(h, [](const Sample& s) { return s.elastic_normal; }));
  t.add("elastic_shear", "J", column(h, [](const Sample& s) { return s.elastic_shear; }));
  t.add("elastic_planes", "J", column(h, [](const Sample& s) { return s.elastic_planes; }));
  t.add("kinetic", "J", column(h, [](const Sample& s) { return s.kinetic; }));
  if (std::any_of(h.begin(), h.end(), [](const Sample& s) { return s.gravity != 0; })) {
    t.add("gravity", "J", column(h, [](const Sample& s) { return s.gravity; }));
  }
  t.add("viscous_heat", "J", column(h, [](const Sample& s) { return s.viscous; }));
  t.add("breaking_heat_normal", "J", column(h, [](const Sample& s) { return s.breaking_normal; }));
  t.add("breaking_heat_shear", "J", column(h, [](const Sample& s) { return s.breaking_shear; }));
  t.add("frictional_heat", "J", column(h, [](const Sample& s) { return s.frictional; }));
  t.add("residual", "J", column(h, [](const Sample& s) { return s.imbalance(); }));
  t.add("opening", "1", column(h, [](const Sample& s) { return static_cast<double>(s.opening); }));
  t.add("sliding", "1", column(h, [](const Sample& s) { return static_cast<double>(s.sliding); }));
  return t;
}

Table crack_table(const std::vector<Crack>& cracks, const Block& block, double time_step) {
  Table t{"cracks", {{"mode", "0 opening, 1 sliding"}}, {}};
  std::vector<double> time, position, normal, heat_normal, heat_shear;
  std::vector<std::int32_t> mode, element, direction;
  for (const Crack& c : cracks) {
    const auto bond = bond_vector(block.site[at(c.element)].layer & 1, c.direction);
    time.push_back(static_cast<double>(c.step) * time_step);
    mode.push_back(c.mode);
    element.push_back(c.element);
    direction.push_back(c.direction);
    for (std::size_t i = 0; i < 3; ++i) {
      position.push_back(block.position[at(c.element)][i] + 0.5 * block.diameter * bond[i]);
      normal.push_back(bond[i]);
    }
    heat_normal.push_back(c.heat_normal);
    heat_shear.push_back(c.heat_shear);
  }
  t.add("time", "s", std::move(time));
  t.add("mode", "", std::move(mode));
  t.add("element", "", std::move(element));
  t.add("direction", "", std::move(direction));
  t.add("position", "m", std::move(position), 3);
  t.add("normal", "1", std::move(normal), 3);
  t.add("heat_normal", "J", std::move(heat_normal));
  t.add("heat_shear", "J", std::move(heat_shear));
  return t;
}

Table displacement_table(const Solver& solver) {
  Table t{"snapshots/0000", {{"moment", "end"}}, {}};
  std::vector<double> u;
  for (const auto& v : solver.displacement()) u.insert(u.end(), v.begin(), v.end());
  t.add("displacement", "m", std::move(u), 3);
  return t;
}

// First and last step of the opening that parts the block: of the runs of opening bonds without a pause of 300 steps,
// in which a wave crosses the block, the one with most bonds.
std::pair<std::int64_t, std::int64_t> main_burst(const std::vector<Crack>& cracks) {
  constexpr std::int64_t pause = 300;
  std::pair<std::int64_t, std::int64_t> best{-1, -1}, now{-1, -1};
  std::size_t most = 0, bonds = 0;
  for (const Crack& c : cracks) {
    if (c.mode != 0) continue;
    if (now.first < 0 || c.step > now.second + pause) {
      now.first = c.step;
      bonds = 0;
    }
    now.second = c.step;
    if (++bonds > most) {
      most = bonds;
      best = now;
    }
  }
  return best;
}

const Sample& sample_from(const std::vector<Sample>& h, std::int64_t step) {
  const auto found = std::find_if(h.begin(), h.end(), [&](const Sample& x) { return x.step >= step; });
  return found == h.end() ? h.back() : *found;
}

// Largest stress of a test that ended in failure. Loaded along its rows a block may never fail: then a note.
void put_strength(Record& r, const StrengthTest& test, const StressStrain& m, double of_rock, const Quantity& strength,
                  const Quantity& error) {
  if (test.failed()) {
    r.put(strength, 1e-6 * m.stress(test.peak()));
    r.put(error, 100 * (m.stress(test.peak()) / of_rock - 1));
    return;
  }
  const Sample& end = test.history().back();
  r.notes.push_back(fmt::format(
      "No strength was found up to a strain of {:.3g} % ({} time steps), where {} ended the test: {}, and the largest "
      "stress was {:.4g} MPa.",
      100 * std::abs(m.strain(end)), test.solver().step(), test.given_up(),
      test.solver().cracks().empty() ? "no bond broke" : fmt::format("{} bonds broke", test.solver().cracks().size()),
      1e-6 * m.stress(test.peak())));
}

// What did not happen has no number.
void put_finite(Record& r, const Quantity& quantity, double value) {
  if (std::isfinite(value)) r.put(quantity, value);
}

void tension_results(Record& r, const Settings& s, const StrengthTest& test, const StressStrain& m) {
  const auto& h = test.history();
  const double dt = s.setup.time_step;
  put_strength(r, test, m, s.rock.tensile_strength, quantity::tensile_strength, quantity::tensile_strength_error);
  if (test.failed()) r.put(quantity::peak_strain, m.strain(test.peak()));
  const auto [first, last] = main_burst(test.solver().cracks());
  const bool parts = first >= 0;
  if (parts) {
    r.put(quantity::failure_time, static_cast<double>(first) * dt);
    r.put(quantity::crack_duration, static_cast<double>(last - first) * dt);
  }
  const double width = s.shape.ny * s.micro.diameter;  // the paper's 1.2 cm for 12 elements
  if (last > first) r.put(quantity::crack_speed, width / (static_cast<double>(last - first) * dt));
  double kinetic = 0, share = 0;
  for (const Sample& x : h) {
    if (x.kinetic <= kinetic || x.step < first) continue;
    kinetic = x.kinetic;
    share = x.kinetic / x.work;
  }
  if (parts) r.put(quantity::kinetic_share, share);
  double before_parting = 0;
  for (const Sample& x : h) {
    if (x.step <= last) before_parting = x.frictional / x.work;
  }
  if (parts) r.put(quantity::frictional_share_at_parting, before_parting);
  r.put(quantity::frictional_share, h.back().frictional / h.back().work);
  if (parts && test.friction_from() >= 0) {
    r.put(quantity::friction_after_last_opening, static_cast<double>(test.friction_from() - last) * dt);
  }
  put_finite(r, quantity::viscous_share_of_heat, h.back().viscous / h.back().heat());
  if (parts)
    put_finite(r, quantity::viscous_share_after_parting, (1 - sample_from(h, last + 1).viscous / h.back().viscous));
}

// The loading step before the peak in which most bonds opened: A1 of the paper's Fig. 5.
struct Opening {
  std::size_t before = 0;  // sample
  std::int64_t bonds = 0;  // that opened; 0: none did
};
Opening largest_opening(const std::vector<Sample>& h, std::int64_t peak_step) {
  constexpr std::int64_t window = 300;  // steps: opening runs through the block like the crack in tension
  Opening found;
  std::int64_t most = 0;
  std::size_t end = 0;
  for (std::size_t i = 0; i < h.size() && h[i].step < peak_step; ++i) {
    while (end + 1 < h.size() && h[end + 1].step <= h[i].step + window && h[end + 1].step < peak_step) ++end;
    const std::int64_t opened = h[end].opening - h[i].opening;
    if (opened > most) {
      most = opened;
      found.before = i;
    }
  }
  found.bonds = most;
  return found;
}

void compression_results(Record& r, const Settings& s, const StrengthTest& test, const StressStrain& m) {
  const auto& h = test.history();
  const double dt = s.setup.time_step;
  const double root = std::sqrt(1 + s.rock.internal_friction * s.rock.internal_friction) + s.rock.internal_friction;
  put_strength(r, test, m, s.rock.compressive_strength + root * root * s.setup.pressure, quantity::compressive_strength,
               quantity::compressive_strength_error);
  if (test.failed()) r.put(quantity::peak_strain, m.strain(test.peak()));
  const auto before_first = [&](auto Sample::*count) {
    const double none = std::numeric_limits<double>::quiet_NaN();
    double stress = none;
    for (const Sample& x : h) {
      if (x.*count > 0) return 1e-6 * stress;
      stress = m.stress(x);
    }
    return none;
  };
  put_finite(r, quantity::first_opening, before_first(&Sample::opening));
  put_finite(r, quantity::first_sliding, before_first(&Sample::sliding));
  if (const Opening a1 = largest_opening(h, test.peak().step); a1.bonds > 0) {
    r.put(quantity::a1_stress, 1e-6 * m.stress(h[a1.before]));
    r.put(quantity::a1_strain, m.strain(h[a1.before]));
    r.put(quantity::a1_time, h[a1.before].time);
  }

  // C1 to C2: the bonds that slide at the failure, from the peak on.
  std::int64_t first = -1, last = -1;
  std::vector<std::int64_t> slides;
  for (const Crack& c : test.solver().cracks()) {
    if (c.mode == 1 && c.step >= test.peak().step) slides.push_back(c.step);
  }
  if (!slides.empty()) {
    first = slides.front();
    last = slides[slides.size() * 99 / 100];  // all but the last hundredth: single bonds break long after
  }
  const Sample &c1 = sample_from(h, first - 1), &c2 = sample_from(h, last + 1);
  const bool slid = first >= 0;
  if (slid) {
    r.put(quantity::sliding_start, static_cast<double>(first) * dt);
    r.put(quantity::sliding_duration, static_cast<double>(last - first) * dt);
    r.put(quantity::normal_share_of_sliding_heat,
          (c2.breaking_normal - c1.breaking_normal) /
              std::max(1e-300, c2.breaking_normal + c2.breaking_shear - c1.breaking_normal - c1.breaking_shear));
    r.put(quantity::frictional_share_after_sliding, (1 - c2.frictional / std::max(1e-300, h.back().frictional)));
  }
  double kinetic = 0, elastic_least = test.peak().elastic();
  for (const Sample& x : h) {
    if (x.step < test.peak().step) continue;
    kinetic = std::max(kinetic, x.kinetic);
    elastic_least = std::min(elastic_least, x.elastic());
  }
  if (!test.failed()) return;
  r.put(quantity::kinetic_share, kinetic / test.peak().elastic());
  r.put(quantity::elastic_left_share, elastic_least / test.peak().elastic());
  if (slid)
    put_finite(r, quantity::viscous_share_of_heat, (h.back().viscous - c1.viscous) / (h.back().heat() - c1.heat()));
}

void add_size(Record& r, const Block& block) {
  r.put(quantity::particles, static_cast<double>(block.site.size()));
  r.put(quantity::contacts, static_cast<double>(block.bonds.size()));
}

}  // namespace

void add_block(Record& r, const Block& block) {
  Table particles{"particles", {}, {}};
  std::vector<double> position;
  for (const auto& p : block.position) position.insert(position.end(), p.begin(), p.end());
  particles.add("position", "m", std::move(position), 3);
  particles.add("radius", "m", std::vector<double>(block.site.size(), 0.5 * block.diameter));
  r.tables.push_back(std::move(particles));
  Table contacts{"contacts", {{"direction", "0 along y, 1-2 to the next row, 3-5 to the layer above"}}, {}};
  std::vector<std::int32_t> pair, direction;
  for (const Block::Bond& b : block.bonds) {
    pair.insert(pair.end(), {b.a, b.b});
    direction.push_back(b.direction);
  }
  contacts.add("pair", "", std::move(pair), 2);
  contacts.add("direction", "", std::move(direction));
  r.tables.push_back(std::move(contacts));
}

void add_strength(Record& r, const Settings& s, const Block& block, const StrengthTest& test) {
  const StressStrain m(s, block);
  if (s.test == "tension") {
    tension_results(r, s, test, m);
  } else {
    compression_results(r, s, test, m);
  }
  const Sample& end = test.history().back();
  r.put(quantity::cracks_opening, static_cast<double>(end.opening));
  r.put(quantity::cracks_sliding, static_cast<double>(end.sliding));
  r.put(quantity::energy_residual, test.largest_residual());
  add_size(r, block);
  r.put(quantity::steps, static_cast<double>(test.solver().step()));
  constexpr double limit = 1e-3;
  r.checks.push_back({"energy_residual", test.largest_residual(), limit, test.largest_residual() <= limit,
                      "Work of the planes less elastic and kinetic energy and all heat, over the work, taken as at "
                      "least a thousandth of its largest value so far; the largest of all samples. Limit: a "
                      "thousandth, far below every published share of energy."});
  constexpr double usual_bias = 0.03;
  const double bias = test.rate_bias();
  if (test.failed() && bias > usual_bias && bias <= s.rate_bias) {
    r.notes.push_back(fmt::format(
        "Loaded fast: the strength may be {:.0f} % above that of slow loading (measure.rate_bias lets {:g} % pass).",
        100 * bias, 100 * s.rate_bias));
  }
  if (!test.solver().cracks().empty()) {
    r.checks.push_back({"quasi_static", bias, s.rate_bias, bias <= s.rate_bias,
                        "Share by which the rate of loading raises the strength, estimated from the kinetic over the "
                        "elastic energy before the first bond breaks and from the strain of a loading step over that "
                        "of the peak. Limit: what the scenario allows (key measure.rate_bias)."});
  }
  const auto unseen = static_cast<double>(test.solver().unseen_contacts());
  r.checks.push_back({"contacts_outside_lattice", unseen, 0, unseen == 0,
                      "Pairs of elements that are no neighbours in the lattice and came into contact. Limit: not one, "
                      "as the law knows neighbours only."});
  add_block(r, block);
  r.tables.push_back(crack_table(test.solver().cracks(), block, s.setup.time_step));
  r.tables.push_back(history_table(test.history(), m));
  r.tables.push_back(displacement_table(test.solver()));
}

void add_elastic(Record& r, const Settings& s, const Block& block, const std::vector<ElasticPoint>& points) {
  const double from_centres = cross_section(block, s.setup.axis) / section_area(block, s.setup.axis, s.section);
  Table t{"elastic", {{"axial_strain", "positive in compression"}}, {}};
  std::vector<double> strain, between, modulus, nu, nu1, nu2;
  double e_error = 0, nu_error = 0;
  for (const ElasticPoint& p : points) {
    const double gauge = s.gauge == Gauge::planes ? p.strain / p.between_planes : 1;
    strain.push_back(-p.strain / gauge);
    between.push_back(-p.between_planes);
    modulus.push_back(p.young_modulus * from_centres * gauge);
    nu1.push_back(p.poisson[0] * gauge);
    nu2.push_back(p.poisson[1] * gauge);
    nu.push_back(0.5 * (nu1.back() + nu2.back()));
    e_error += std::abs(modulus.back() / s.rock.young_modulus - 1) / static_cast<double>(points.size());
    nu_error += std::abs(nu.back() / s.rock.poisson_ratio - 1) / static_cast<double>(points.size());
  }
  if (!points.empty()) {
    r.put(quantity::young_modulus, 1e-9 * modulus.front());
    r.put(quantity::poisson_ratio, nu.front());
    r.put(quantity::young_modulus_error, 100 * e_error);
    if (s.rock.poisson_ratio > 0) r.put(quantity::poisson_ratio_error, 100 * nu_error);
    r.put(quantity::young_modulus_at_largest_strain, 1e-9 * modulus.back());
    r.put(quantity::poisson_ratio_at_largest_strain, nu.back());
  }
  if (s.method == ElasticMethod::rest) {
    const double restless = points.empty() ? 0 : points.back().restless;
    r.checks.push_back(
        {"at_rest", restless, 0, restless == 0,
         "Searches for rest that were given up before the kinetic energy had fallen to its limit. Limit: not one."});
  } else {
    const auto missing = static_cast<double>(s.strains.size() - points.size());
    r.checks.push_back(
        {"strains_reached", missing, 0, missing == 0,
         "Strains of elastic.strains that the test did not reach within loading.most_steps. Limit: not one."});
  }
  add_size(r, block);
  t.add("axial_strain", "1", std::move(strain));
  t.add("strain_between_planes", "1", std::move(between));
  t.add("young_modulus", "Pa", std::move(modulus));
  t.add("poisson_ratio", "1", std::move(nu));
  t.add("poisson_ratio_1", "1", std::move(nu1));
  t.add("poisson_ratio_2", "1", std::move(nu2));
  r.tables.push_back(std::move(t));
  add_block(r, block);
}

}  // namespace dem::lattice
