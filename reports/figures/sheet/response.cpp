// Response to the load: stress, breaks, energy, fields of stress, both solvers beside each other.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <functional>
#include <optional>
#include <set>

#include "engine/analysis/peaks.h"
#include "reports/figures/energy_colours.h"
#include "reports/figures/sheet/parts.h"
#include "reports/figures/table.h"
#include "reports/text.h"

namespace reports::sheet {
namespace {

// A load step gives two points: loaded, then after its breaks.
render::Series sawtooth(const dem::Table& h, const std::string& loaded, const std::string& after, double factor) {
  const auto strain = h.real("strain"), top = h.real(loaded), bottom = h.real(after);
  render::Series s;
  s.x.push_back(0), s.y.push_back(0);
  for (std::size_t i = 0; i < strain.size(); ++i) {
    s.x.insert(s.x.end(), {100 * strain[i], 100 * strain[i]});
    s.y.insert(s.y.end(), {factor * top[i], factor * bottom[i]});
  }
  return s;
}

std::string strain_title(const dem::Record& r) {
  return r.text("test") == "growth" ? "Growth of radii (%)" : "Strain (%)";
}

constexpr double room = 1.05;  // beyond the end of a run: what falls there does not lie on the frame

/// Ends of the axes that all runs of a study share, so that they can be compared.
struct Reach {
  double strain = 0;         ///< %
  double low = 0, high = 0;  ///< stress, 10⁻³ k
  double breaks = 0;
};
Reach reach_of(const StudyResult& study) {
  Reach all;
  for (const dem::Record* r : records_of(study)) {
    const dem::Table& h = r->table("history");
    for (const double strain : h.real("strain")) all.strain = std::max(all.strain, room * 100 * strain);
    for (const double n : h.real("breaks")) all.breaks = std::max(all.breaks, room * n);
    for (const char* column : {"stress_xx", "stress_yy", "loaded_stress_xx", "loaded_stress_yy"}) {
      for (const double stress : h.real(column)) {
        all.low = std::min(all.low, 1e3 * room * stress);
        all.high = std::max(all.high, 1e3 * room * stress);
      }
    }
  }
  return all;
}

render::Chart stress_chart(const dem::Record& r, const Reach& reach) {
  const dem::Table& h = r.table("history");
  render::Chart chart;
  chart.x.title = strain_title(r);
  chart.left.title = "Wall stress (10⁻³ k)";
  render::Series xx = sawtooth(h, "loaded_stress_xx", "stress_xx", 1e3),
                 yy = sawtooth(h, "loaded_stress_yy", "stress_yy", 1e3);
  xx.label = "σ_{xx}", yy.label = "σ_{yy}";
  xx.colour = render::palette(5), yy.colour = render::palette(4);
  yy.line = render::Line::dash;
  chart.series = {xx, yy};
  chart.x.low = 0, chart.x.high = reach.strain;
  if (reach.high > reach.low) chart.left.low = reach.low, chart.left.high = reach.high;
  chart.legend = render::Chart::Legend::bottom_left;
  return chart;
}

render::Chart breaks_chart(const dem::Record& r, const Reach& reach) {
  render::Chart chart;
  chart.x.title = strain_title(r);
  chart.left.title = "Broken springs";
  chart.x.low = 0, chart.x.high = reach.strain;
  chart.left.low = 0;
  if (reach.breaks > 0) chart.left.high = reach.breaks;
  render::Series breaks = curve(r.table("history"), {"strain", "breaks", 100, 1});
  breaks.x.insert(breaks.x.begin(), 0), breaks.y.insert(breaks.y.begin(), 0);
  breaks.colour = render::palette(0);
  chart.series = {breaks};
  chart.legend = render::Chart::Legend::none;
  return chart;
}

render::Colour between(const render::Colour& a, const render::Colour& b, double t) {
  return {a.red + t * (b.red - a.red), a.green + t * (b.green - a.green), a.blue + t * (b.blue - a.blue)};
}
// Blue for compression, red for tension, pale in the middle.
render::Colour diverging(double t) {
  const render::Colour blue{0.13, 0.40, 0.67}, pale{0.97, 0.97, 0.95}, red{0.70, 0.09, 0.17};
  return t < 0 ? between(pale, blue, std::min(1.0, -t)) : between(pale, red, std::min(1.0, t));
}
render::Colour rising(double t) {
  const render::Colour low{1.0, 0.97, 0.85}, middle{0.90, 0.50, 0.15}, high{0.25, 0.02, 0.10};
  t = std::clamp(t, 0.0, 1.0);
  return t < 0.5 ? between(low, middle, 2 * t) : between(middle, high, 2 * t - 1);
}

// How much matrix pictures of a layer show beside it: as high as leaves them as wide as the page.
constexpr double beside_layer = 0.04;

/// The values of the particles that are shown.
std::vector<double> values_shown(const dem::Record& r, const std::string& table, const std::string& column) {
  const auto value = r.table(table).real(column);
  const auto place = r.table("particles").real("position");
  const auto [bottom, top] = heights_shown(r, beside_layer);
  std::vector<double> shown;
  for (std::size_t i = 0; i < value.size(); ++i) {
    if (place[2 * i + 1] >= bottom && place[2 * i + 1] <= top) shown.push_back(value[i]);
  }
  return shown;
}

// The size below which a share of the values lies: single springs at crack tips would take the whole scale.
double size_at(std::span<const double> values, double share) {
  std::vector<double> size;
  for (const double v : values) {
    if (std::isfinite(v)) size.push_back(std::fabs(v));
  }
  if (size.empty()) return 0;
  const auto at = size.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(size.size() - 1));
  std::nth_element(size.begin(), at, size.end());
  return *at;
}

/// A field of stress, the same ends of its colours for all its pictures.
struct Field {
  std::string column, words;
  bool has_sign = false;  ///< tension positive; else it is never negative
  double low = 0, high = 0;
};

Field field_of(const dem::Record& r, const std::vector<std::string>& tables, Field field) {
  double least = 1e300;
  for (const std::string& table : tables) {
    const auto value = values_shown(r, table, field.column);
    field.high = std::max(field.high, size_at(value, 0.99));
    least = std::min(least, size_at(value, 0.01));
  }
  field.high = std::max(field.high, 1e-12);
  // Where all of the sheet is stressed much alike, colours begin at the least of it.
  field.low = field.has_sign ? -field.high : least > 0.3 * field.high && least < field.high ? least : 0.0;
  return field;
}

render::Colour colour_of(const Field& field, double share) {
  return field.has_sign ? diverging(2 * share - 1) : rising(share);
}

Panel field_panel(const dem::Record& r, const std::string& table, double strain, const Field& field,
                  const std::string& label, int per_row) {
  const Layout l = layout_of(r);
  const auto place = r.table("particles").real("position");
  const dem::Table& t = r.table(table);
  const auto value = t.real(field.column), move = t.real("displacement");
  render::Spheres spheres;
  spheres.cut_edges = false;
  const auto [bottom, top] = heights_shown(r, beside_layer);
  for (std::size_t i = 0; i < value.size(); ++i) {
    if (place[2 * i + 1] < bottom || place[2 * i + 1] > top) continue;
    spheres.centre.push_back({place[2 * i] + move[2 * i], place[2 * i + 1] + move[2 * i + 1], 0});
    spheres.radius.push_back(1.16 * l.radius);  // wide enough to leave no gap between three
    spheres.colour.push_back(colour_of(field, (value[i] - field.low) / (field.high - field.low)));
  }
  Picture p;
  p.scene.spheres = {spheres};
  p.scene.cuts.push_back({{0, 0, 0}, {0, 0, 1}});  // discs in flat colours: a value, not a shape
  p.scene.camera.direction = {0, 0, -1};
  p.scene.camera.up = {0, 1, 0};
  const bool strip = layered(r);
  p.scene.width = strip ? 1400 : 900;
  p.scene.height = strip ? static_cast<int>(std::lround(1400 * (top - bottom + 0.02))) : 900;
  p.scene.axes = true;
  p.scale_bar = false;
  p.label = "at " + at_strain(r, strain);  // of what, its caption says
  p.scene.bar = render::ColourBar{
      .title = field.words + " (10⁻³ k)", .low = 1e3 * field.low, .high = 1e3 * field.high, .colours = {}};
  for (int k = 0; k < 64; ++k) p.scene.bar->colours.push_back(colour_of(field, (k + 0.5) / 64));
  const auto seen = values_shown(r, table, field.column);
  const auto range = std::ranges::minmax_element(seen);
  return {.id = field.column + fmt::format("_{}", table.substr(table.size() - 4)),
          .caption = fmt::format("{}{}{}{}; the colours span all but the most extreme 1 % of the values shown.",
                                 field.words, strip ? " in the layer and beside it" : "",
                                 label.empty() ? "" : ", " + label, field.has_sign ? ", tension positive" : ""),
          .alt = fmt::format("Values go from {} to {} in units of k.", number(*range.min, 2), number(*range.max, 2)),
          .content = p,
          .per_row = per_row,
          .whole_width = strip};
}

// Whether springs break later and tension falls more in one step the narrower their strengths are distributed; why it cannot
// be told is added to the finding.
std::optional<Agreement> abruptness_agrees(const StudyResult& study, std::string& finding) {
  std::vector<const dem::Record*> along;
  for (const dem::Record* r : records_of(study)) {
    if (r->text("test") == "pure_shear" && r->text("solver") == "converged" && r->has(quantity::onset_strain))
      along.push_back(r);
  }
  std::ranges::sort(along, {}, [](const dem::Record* r) { return r->number("spread"); });
  if (along.size() < 2 || along.front()->number("spread") == along.back()->number("spread")) return std::nullopt;
  const auto falls = [&](const dem::Quantity& of) {
    return std::ranges::is_sorted(along, std::greater{},
                                  [&](const dem::Record* r) { return over_seeds(study, *r, shown(of)).value; });
  };
  const bool early = falls(quantity::onset_strain), gradual = falls(quantity::largest_drop_share);
  if (early != gradual) {
    finding +=
        early ? " The narrower the distribution, the later the first break, but the falls in one load step do not "
                "follow it."
              : " The narrower the distribution, the larger the fall in one load step, but the first breaks do not "
                "follow it.";
  }
  return early && gradual ? Agreement::agrees : early || gradual ? Agreement::undecided : Agreement::disagrees;
}

// How far the differential stress has fallen by the end of a run that passed its peak, and whether that ended it.
std::string fall_said(const dem::Record& r, const StudyResult& study) {
  const dem::Table& h = r.table("history");
  const double left = std::fabs(h.real("stress_xx").back() - h.real("stress_yy").back());
  const double peak = r.value(quantity::peak_differential_stress), share = left / peak;
  std::string said =
      fmt::format("The differential stress of the walls peaks at {} and has fallen to {} of its peak by the end",
                  at_strain(r, r.value(quantity::strain_at_peak)), percent(share, 1));
  const double least = study.scenario->real("loading.stop_share"), steps = study.scenario->real("loading.steps"),
               made = r.value(quantity::load_steps);
  if (share < least && made < steps)
    said += fmt::format(": the specimen counts as failed below {}, and the run ended after {} of {} load steps",
                        percent(least, 0), count(made), count(steps));
  return said;
}

}  // namespace

FigureContent stress_strain(const StudyResult& study) {
  FigureContent content;
  const dem::Record* main = main_record(study);
  if (!main) return content;
  content.expected = true;
  content.statement = main->text("test") == "pure_shear"
                          ? "The wider the distribution of strengths, the earlier the first spring breaks, and "
                            "the smaller the largest fall of the wall tension in one load step."
                          : "";
  const Reach reach = reach_of(study);
  std::vector<std::string> first, worst, falls, unbroken, rising, lasting, failed;
  const bool growth = main->text("test") == "growth";
  std::size_t seeds = 1;
  TextTable table{{"Run", growth ? "Growth at the first break (%)" : "Strain at the first break (%)",
                   "Most breaks in a step (%\u00a0of\u00a0all)",
                   "Largest fall in a step (%\u00a0of\u00a0the\u00a0largest\u00a0tension)"},
                  {}};
  for (const dem::Record* r : records_of(study)) {
    const std::string label = label_of(*r, study);
    content.panels.push_back(
        {.id = r->case_id,
         .caption = fmt::format("{}: stress on the walls (tension positive), before and after the breaks of each step.",
                                label == "this run" ? "Response" : "Response, " + label),
         .alt = fmt::format("Largest differential stress {} at {} %.",
                            number(r->value(quantity::peak_differential_stress), 3),
                            number(100 * r->value(quantity::strain_at_peak), 3)),
         .content = stress_chart(*r, reach),
         .per_row = 2});
    content.panels.push_back(
        {.id = r->case_id + "_breaks",
         .caption = label == "this run" ? "Cumulative broken springs." : "Cumulative broken springs, " + label + ".",
         .alt = fmt::format("{} springs have broken at the end.",
                            count(r->value(quantity::cracks_intra_tension) + r->value(quantity::cracks_inter_tension))),
         .content = breaks_chart(*r, reach),
         .per_row = 2});
    const std::string where = label == "this run" ? "" : " (" + label + ")";
    if (analysis::passed_peak(*r)) {
      failed.push_back(fall_said(*r, study) + where);
    } else {
      const double at = r->value(quantity::strain_at_peak), end = r->value(quantity::final_strain);
      if (at < end * (1 - 1e-9)) {
        lasting.push_back(at_strain(*r, at) + where);
      } else {
        rising.push_back(label);
      }
    }
    if (!r->has(quantity::onset_strain)) {
      unbroken.push_back(label);
      continue;
    }
    first.push_back(fmt::format("{} %{}", number(100 * r->value(quantity::onset_strain), 3), where));
    worst.push_back(percent(r->value_or_nan(quantity::worst_step_share), 0) + where);
    const double fall = r->value_or_nan(quantity::largest_drop_share);
    if (fall > 0) falls.push_back(percent(fall, 0) + where);
    const auto cell = [&](const dem::Quantity& of) {
      return estimate_text(over_seeds(study, *r, [&](const dem::Record& one) { return 100 * one.value_or_nan(of); }), 3,
                           true);
    };
    const std::size_t its = seeds_of(study, *r).size();
    seeds = std::max(seeds, its);
    table.rows.push_back(
        {capital(its > 1 ? (kind_of(*r, study).empty() ? "" : kind_of(*r, study) + ", ") + fmt::format("{} seeds", its)
                         : label),
         cell(quantity::onset_strain), cell(quantity::worst_step_share),
         fall > 0 ? cell(quantity::largest_drop_share) : "–"});
  }
  // More than two runs, and means over seeds, are easier compared in a table than in a sentence.
  constexpr std::size_t few = 2;
  bool in_table = false;
  if (table.rows.size() > few || seeds > 1) {
    content.panels.push_back(
        {.id = "runs",
         .caption = std::string("First breaks, and the worst of any load step; the largest fall is one of the wall "
                                "tension.") +
                    (seeds > 2   ? " Means over seeds; 95 % confidence intervals in brackets."
                     : seeds > 1 ? " Means over seeds."
                                 : ""),
         .alt = "",
         .content = table,
         .per_row = 1});
    first.clear(), falls.clear();
    in_table = true;
  }
  std::vector<std::string> said;
  if (in_table) said.emplace_back("The table gives the first break and the worst load step of each run.");
  if (!first.empty()) {
    said.push_back(fmt::format("The first spring breaks at a {} of {}.", growth ? "growth" : "strain", listed(first)));
    said.push_back(listed(worst) + " of all breaks fall in one load step.");
  }
  if (!falls.empty())
    said.push_back("The largest fall of the wall tension in one load step is " + listed(falls) +
                   " of its largest value.");
  if (growth) {
    const dem::Table& h = main->table("history");
    said.push_back("At the end the mean wall stress is " +
                   number(1e3 * 0.5 * (h.real("stress_xx").back() + h.real("stress_yy").back()), 3) + " × 10⁻³ k.");
  } else if (!rising.empty()) {
    said.push_back(
        rising.front() == "this run" ? "The differential stress of the walls passes no peak by the end of the run."
        : rising.size() == records_of(study).size()
            ? std::string("In no run does the differential stress of the walls pass a peak.")
            : "The differential stress of the walls passes no peak by the end of the run: " + listed(rising) + ".");
  }
  for (const std::string& one : failed) said.push_back(one + ".");
  if (!lasting.empty())
    said.push_back("The differential stress of the walls is largest at " + listed(lasting) +
                   ", and has not fallen by a quarter by the end.");
  if (!unbroken.empty())
    said.push_back("No spring broke" + (unbroken.front() == "this run" ? "" : ": " + listed(unbroken)) + ".");
  content.finding = joined(said, " ");
  content.agreement = abruptness_agrees(study, content.finding);
  return content;
}

FigureContent energy(const StudyResult& study) {
  FigureContent content;
  std::vector<std::string> said;
  double last_strain = 0, most = 0;  // ends of the axes that all panels share
  bool jumps = false, historical = false;
  for (const dem::Record* r : records_of(study)) {
    const dem::Table& h = r->table("history");
    jumps = jumps || std::ranges::any_of(h.real("jumped"), [](double e) { return e != 0; });
    historical = historical || r->text("solver") == "historical";
    const auto strain = h.real("strain"), boundary = h.real("boundary_work"), growth = h.real("growth_work");
    for (std::size_t i = 0; i < strain.size(); ++i) {
      last_strain = std::max(last_strain, room * 100 * strain[i]);
      most = std::max(most, 1e6 * (boundary[i] + growth[i]));
    }
  }
  const std::string by = jumps ? "breaking and jumps" : "breaking";
  for (const dem::Record* r : records_of(study)) {
    const dem::Table& h = r->table("history");
    const auto strain = h.real("strain"), elastic = h.real("elastic"), released = h.real("released"),
               jumped = h.real("jumped");
    const auto boundary = h.real("boundary_work"), growth = h.real("growth_work");
    render::Chart chart;
    const auto band = [](const char* words, const render::Colour& colour) {
      return render::Band{
          .label = words, .x = {0}, .low = {0}, .high = {0}, .colour = colour, .opacity = 1, .outlined = true};
    };
    render::Band stored = band("elastic", colours_of(Energy::elastic).area),
                 lost = band("released", colours_of(Energy::breaking).area);
    render::Series work;
    work.label = "work done";
    work.colour = colours_of(Energy::work).line;
    work.x = work.y = {0};
    for (std::size_t i = 0; i < strain.size(); ++i) {
      const double x = 100 * strain[i], e = 1e6 * elastic[i];
      stored.x.push_back(x), stored.low.push_back(0), stored.high.push_back(e);
      lost.x.push_back(x), lost.low.push_back(e), lost.high.push_back(e + 1e6 * (released[i] + jumped[i]));
      work.x.push_back(x), work.y.push_back(1e6 * (boundary[i] + growth[i]));
    }
    chart.bands = {stored, lost};
    chart.series = {work};
    chart.x.title = r->text("test") == "growth" ? "Growth of radii (%)" : "Strain (%)";
    chart.left.title = "Energy (10⁻⁶ k box²)";
    chart.left.low = 0;
    chart.legend = render::Chart::Legend::top_left;
    chart.x.low = 0;
    chart.x.high = last_strain;
    chart.left.high = 1.06 * most;
    const double residual = r->value(quantity::energy_residual);
    constexpr double seen = 5e-3;  // of the work, in a chart
    const std::string label = label_of(*r, study);
    content.panels.push_back(
        {.id = r->case_id,
         .caption = fmt::format("Energy{}; “released” is the energy that {} released{}.",
                                label == "this run" ? "" : ", " + label, by,
                                residual > seen ? ", the white below the work that of neither" : ""),
         .alt = fmt::format("Work, elastic energy and released energy agree to {} of the work.", number(residual, 2)),
         .content = chart,
         .per_row = 2});
    said.push_back(number(residual, 2) + (label == "this run" ? "" : " (" + label + ")"));
  }
  if (!said.empty())
    content.finding = listed(said) + " of the work is neither stored in springs nor released by " + by + ".";
  if (historical)
    content.finding += " The historical solver stops before equilibrium: the energy of its run is not checked.";
  return content;
}

FigureContent stress_fields(const StudyResult& study) {
  FigureContent content;
  content.finding =
      "The stress of a particle is the sum over its springs of force times length, over the area of its lattice cell. "
      "Mean stress is half the sum of the two principal stresses in the plane, differential stress their difference: "
      "of particles here, of the walls in the curves and tables. Particles at the walls, which have only part of their "
      "springs, show too low a stress.";
  const dem::Record* r = main_record(study);
  if (!r) return content;
  const auto snapshots = snapshots_of(*r);
  if (snapshots.empty()) return content;
  // Beside each other as many as fill a row at the height that pictures have; strips of a layer lie below each other.
  std::vector<std::size_t> shown{0};
  if (snapshots.size() > 2 && !layered(*r)) shown.push_back(snapshots.size() / 2);
  if (snapshots.size() > 1) shown.push_back(snapshots.size() - 1);
  const int per_row = layered(*r) ? 1 : shown.size() == 3 ? 3 : 2;
  const std::string label = label_of(*r, study);
  std::vector<std::string> tables;
  for (const std::size_t k : shown) tables.push_back(snapshots[k].first);
  for (const Field& wanted : {Field{.column = "mean_stress", .words = "Mean stress", .has_sign = true},
                              Field{.column = "differential_stress", .words = "Differential stress"}}) {
    const Field field = field_of(*r, tables, wanted);
    for (const std::size_t k : shown)
      content.panels.push_back(
          field_panel(*r, snapshots[k].first, snapshots[k].second, field, label == "this run" ? "" : label, per_row));
  }
  return content;
}

FigureContent solvers(const StudyResult& study) {
  FigureContent content;
  const dem::Record *ours = nullptr, *theirs = nullptr;
  for (const dem::Record* r : records_of(study)) {
    if (r->text("solver") == "historical") theirs = r;
  }
  for (const dem::Record* r : records_of(study)) {
    if (theirs && r->text("solver") == "converged" && r->number("spread") == theirs->number("spread")) ours = r;
  }
  if (!ours || !theirs) {
    content.panels.push_back(
        note_panel("", "Both solvers.", "This study has no pair of cases made with both solvers."));
    return content;
  }
  TextTable table{{"Quantity", "converged", "historical"}, {}};
  const auto row = [&](const char* words, const dem::Quantity& of, auto text) {
    table.rows.push_back({words, text(ours->value_or_nan(of)), text(theirs->value_or_nan(of))});
  };
  const auto broken = [](const dem::Record& r) {
    return count(r.value(quantity::cracks_intra_tension) + r.value(quantity::cracks_inter_tension));
  };
  table.rows.push_back({"Broken springs", broken(*ours), broken(*theirs)});
  const std::array<const dem::Record*, 2> both_records{ours, theirs};
  for (const dem::Quantity& one : {quantity::onset_strain, quantity::peak_differential_stress, quantity::strain_at_peak,
                                   quantity::inter_grain_crack_share}) {
    const std::string name = axis_title(one, analysis::name_of(one, both_records));
    row(name.c_str(), one, [&](double v) { return number(one.factor * v, one.digits); });
  }
  for (const dem::Quantity& one : {quantity::unbalanced_force, quantity::energy_residual})
    row(std::string(one.name).c_str(), one, [&](double v) { return number(v, one.digits); });
  // How long the two orders of breaking agree.
  const auto a = ours->table("cracks").real("position"), b = theirs->table("cracks").real("position");
  std::size_t same = 0;
  while (2 * same + 1 < std::min(a.size(), b.size()) && a[2 * same] == b[2 * same] &&
         a[2 * same + 1] == b[2 * same + 1])
    ++same;
  table.rows.push_back(
      {"Breaks in the same order from the start", count(static_cast<double>(same)), count(static_cast<double>(same))});
  std::set<std::pair<double, double>> broken_ours;
  for (std::size_t k = 0; k + 1 < a.size(); k += 2) broken_ours.insert({a[k], a[k + 1]});
  std::size_t shared = 0;
  for (std::size_t k = 0; k + 1 < b.size(); k += 2) shared += broken_ours.count({b[k], b[k + 1]});
  const double both = a.empty() ? 0.0 : 2.0 * static_cast<double>(shared) / static_cast<double>(a.size());
  table.rows.push_back(
      {"Springs broken in both", count(static_cast<double>(shared)), count(static_cast<double>(shared))});
  const double strain = std::min(ours->value(quantity::final_strain), theirs->value(quantity::final_strain));
  for (const dem::Record* r : {ours, theirs}) {
    const auto n = crack_counts(*r, strain);
    content.panels.push_back({.id = r->text("solver"),
                              .caption = fmt::format("Fractures, {}, at {}: {}.", label_of(*r, study),
                                                     at_strain(*r, strain), crack_words(*r, strain)),
                              .alt = fmt::format("Map of {} broken springs.", count(sum_of(n))),
                              .content = fracture_map(*r, strain, render::column_width),
                              .per_row = 2});
  }
  content.panels.push_back({.id = "numbers",
                            .caption = fmt::format("One sheet (spread {:g}), two solvers.", ours->number("spread")),
                            .alt = "",
                            .content = table,
                            .per_row = 1});
  content.finding = fmt::format(
      "The historical sweep stops when no particle moves by more than 1.4 × 10⁻⁷ of the box in a sweep; the converged "
      "solver stops at force equilibrium. Both runs here have spread {:g}. {}; {} of the springs that break with the "
      "converged solver also break with the historical one. The historical run is checked for neither equilibrium nor "
      "energy: {} of its work is unaccounted for.",
      ours->number("spread"),
      same == 0   ? "The order of the breaks differs from the first on"
      : same == 1 ? "The order of the breaks differs from the second on"
                  : fmt::format("The first {} breaks come in the same order in both", count(static_cast<double>(same))),
      percent(both, 0), percent(theirs->value(quantity::energy_residual), 2));
  return content;
}

}  // namespace reports::sheet
