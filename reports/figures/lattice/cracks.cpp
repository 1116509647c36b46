// Where and when bonds break: maps by mode and by time, the two halves in tension, the front against time.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "engine/analysis/breaking.h"
#include "engine/analysis/fits.h"
#include "reports/figures/lattice/parts.h"
#include "reports/figures/table.h"
#include "reports/text.h"

namespace reports::lattice {
namespace {

constexpr render::Colour opening_colour{0.90, 0.62, 0.0};  // apart in grey print: light and dark
constexpr render::Colour sliding_colour{0.0, 0.20, 0.45};
constexpr render::Colour moved_down{0.93, 0.70, 0.40}, moved_up{0.16, 0.38, 0.62};

struct Cracks {
  std::span<const double> time, position, normal;
  std::span<const std::int32_t> mode;
};
Cracks cracks_of(const dem::Record& r) {
  const dem::Table& t = r.table("cracks");
  return {t.real("time"), t.real("position"), t.real("normal"), t.integer("mode")};
}

render::Point box_high(const dem::Record& r) {
  const auto x = r.table("particles").real("position");
  render::Point high{0, 0, 0};
  for (std::size_t i = 0; i < x.size(); ++i) high[i % 3] = std::max(high[i % 3], x[i]);
  return high;
}

render::Scene scene_of(const dem::Record& r, const render::Point& direction) {
  render::Scene scene;
  const double radius = r.table("particles").real("radius")[0];
  const render::Point high = box_high(r);
  scene.outline.shape = render::Outline::Shape::box;
  scene.outline.low = {-radius, -radius, -radius};
  scene.outline.high = {high[0] + radius, high[1] + radius, high[2] + radius};
  scene.camera.direction = direction;
  scene.axes = true;
  scene.width = 620;
  scene.height = 470;
  return scene;
}

template <class Colour, class Keep>
render::Discs discs_of(const dem::Record& r, Keep keep, Colour colour) {
  const Cracks c = cracks_of(r);
  const double radius = r.table("particles").real("radius")[0];
  render::Discs discs;
  for (std::size_t i = 0; i < c.time.size(); ++i) {
    if (!keep(i)) continue;
    discs.centre.push_back({c.position[3 * i], c.position[3 * i + 1], c.position[3 * i + 2]});
    discs.normal.push_back({c.normal[3 * i], c.normal[3 * i + 1], c.normal[3 * i + 2]});
    discs.radius.push_back(0.8 * radius);
    discs.colour.push_back(colour(i));
  }
  return discs;
}

constexpr render::Point oblique{-0.80, 0.50, -0.33}, along_y{0, -1, 0};  // as pictures of parts and events

render::ColourBar time_bar(double from, double to, const std::string& since) {
  render::ColourBar bar{.title = "µs since " + since, .low = 0, .high = 1e6 * (to - from), .colours = {}};
  for (int k = 0; k < 64; ++k) bar.colours.push_back(time_colour((k + 0.5) / 64));
  return bar;
}

Panel by_mode(const dem::Record& r, const std::string& id, double until, const std::string& label) {
  const Cracks c = cracks_of(r);
  std::size_t open = 0, slid = 0;
  for (std::size_t i = 0; i < c.time.size(); ++i) {
    if (c.time[i] > until) continue;
    (c.mode[i] == 0 ? open : slid) += 1;
  }
  Picture p;
  p.scene = scene_of(r, oblique);
  p.scene.discs = {discs_of(
      r, [&](std::size_t i) { return c.time[i] <= until; },
      [&](std::size_t i) { return c.mode[i] == 0 ? opening_colour : sliding_colour; })};
  p.label = label;
  p.legend = {{opening_colour, "opened", count(static_cast<double>(open))},
              {sliding_colour, "slid", count(static_cast<double>(slid))}};
  return {.id = id,
          .caption = "Broken bonds so far, by mode.",
          .alt = fmt::format("{}: {} bonds opened, {} slid.", label, open, slid),
          .content = p,
          .per_row = 3};
}

constexpr double half_step = 5e-9;  // s: of cracks and of marks, whose times are rounded apart

Panel by_time(const dem::Record& r, const std::string& id, double from, double to, const std::string& label,
              const render::Point& direction, const std::string& since, const std::string& broke) {
  const Cracks c = cracks_of(r);
  Picture p;
  p.scene = scene_of(r, direction);
  const auto alike = [&](std::size_t i) { return broke != "opened" || c.mode[i] == 0; };
  const auto seen = [&](std::size_t i) {
    return alike(i) && c.time[i] > from - half_step && c.time[i] < to + half_step;
  };
  p.scene.discs = {
      discs_of(r, seen, [&](std::size_t i) { return time_colour((c.time[i] - from) / std::max(1e-12, to - from)); })};
  p.label = label;
  p.scene.bar = time_bar(from, to, since);
  // Of all that broke alike in the test: what is drawn is the failure alone.
  std::size_t all = 0, drawn = 0;
  for (std::size_t i = 0; i < c.time.size(); ++i) {
    all += alike(i);
    drawn += seen(i);
  }
  const std::string end = since == "D₁" ? "D₂" : "C₂";
  const std::string which =
      drawn == all ? fmt::format("All {} bonds that {}", count(static_cast<double>(all)), broke)
                   : fmt::format("{} of the {} bonds that {}: those from {} to {}", count(static_cast<double>(drawn)),
                                 count(static_cast<double>(all)), broke, since, end);
  return {.id = id,
          .caption = which + (direction == along_y ? ", seen along y." : ", by time since " + since + "."),
          .alt = fmt::format("{} bonds broke in {} µs.", p.scene.discs[0].centre.size(), number(1e6 * (to - from), 3)),
          .content = p,
          .per_row = 3};
}

// To one digit, for words like "about".
double round_figure(double value) {
  const double step = std::pow(10.0, std::floor(std::log10(std::max(value, 1e-300))));
  return step * std::round(value / step);
}

// The block after tension, displacements enlarged so that the parts stand apart.
Panel halves(const dem::Record& r, const std::string& id, const std::string& label) {
  const auto x = r.table("particles").real("position"), radius = r.table("particles").real("radius");
  const auto u = r.table("snapshots/0000").real("displacement");
  double apart = 0;
  for (std::size_t i = 2; i < u.size(); i += 3) apart = std::max(apart, std::abs(u[i]));
  const double enlarged = 1.5 * 2 * radius[0] / std::max(apart, 1e-15);
  render::Spheres spheres;
  for (std::size_t i = 0; i < radius.size(); ++i) {
    spheres.centre.push_back({x[3 * i] + enlarged * u[3 * i], x[3 * i + 1] + enlarged * u[3 * i + 1],
                              x[3 * i + 2] + enlarged * u[3 * i + 2]});
    spheres.radius.push_back(radius[i]);
    const double share = 0.5 + 0.5 * u[3 * i + 2] / std::max(apart, 1e-15);
    spheres.colour.push_back({moved_down.red + share * (moved_up.red - moved_down.red),
                              moved_down.green + share * (moved_up.green - moved_down.green),
                              moved_down.blue + share * (moved_up.blue - moved_down.blue)});
  }
  Picture p;
  p.scene.spheres = {spheres};
  p.scene.camera.direction = {-0.92, 0.30, -0.12};
  p.scene.axes = true;
  p.scene.width = 620;
  p.scene.height = 470;
  p.label = label;
  p.legend = {{moved_down, "moved down"},
              {{0.5 * (moved_down.red + moved_up.red), 0.5 * (moved_down.green + moved_up.green),
                0.5 * (moved_down.blue + moved_up.blue)},
               "hardly moved"},
              {moved_up, "moved up"}};
  return {.id = id,
          .caption = fmt::format("At the end, displacements enlarged about {} times; the scale is of the elements.",
                                 count(round_figure(enlarged))),
          .alt = "The parts of the block have moved " + number(1e6 * apart, 3) +
                 " micrometres apart from their places at most.",
          .content = p,
          .per_row = 3};
}

// How far bonds have opened from the first ones, across the load, against time.
struct Front {
  render::Series points, reach, line;
  double speed = std::nan("");  // m/s, straight line through the reach from 10 to 90 % of the way
};
Front front_of(const dem::Record& r) {
  const Cracks c = cracks_of(r);
  const double d1 = r.value_or_nan(quantity::failure_time), d2 = d1 + r.value_or_nan(quantity::crack_duration);
  std::vector<std::size_t> first;
  Front f;
  double far = 0;
  for (std::size_t i = 0; i < c.time.size(); ++i) {
    if (c.mode[i] != 0 || c.time[i] < d1 - half_step || c.time[i] > d2 + half_step) continue;
    if (c.time[i] < d1 + half_step) first.push_back(i);
    double nearest = 1e9;
    for (const std::size_t k : first) {
      nearest = std::min(
          nearest, std::hypot(c.position[3 * i] - c.position[3 * k], c.position[3 * i + 1] - c.position[3 * k + 1]));
    }
    const double t = 1e6 * (c.time[i] - d1);
    f.points.x.push_back(t);
    f.points.y.push_back(1e3 * nearest);
    far = std::max(far, nearest);
    f.reach.x.push_back(t);
    f.reach.y.push_back(1e3 * far);
  }
  std::vector<double> time, way;  // µs, mm
  for (std::size_t i = 0; i < f.reach.x.size(); ++i) {
    const bool rises = i == 0 || f.reach.y[i] > f.reach.y[i - 1];
    if (!rises || f.reach.y[i] < 100 * far || f.reach.y[i] > 900 * far) continue;
    time.push_back(f.reach.x[i]);
    way.push_back(f.reach.y[i]);
  }
  const auto line = analysis::fit_line(time, way);
  if (!line || line->points < 3) return f;
  f.speed = 1e3 * line->slope.value;
  f.line.x = {time.front(), time.back()};
  f.line.y = {line->at(time.front()), line->at(time.back())};
  return f;
}

std::string none_or(const dem::Quantity& number_of, const dem::Record& r) {
  const double number = r.value(number_of);
  return number == 0 ? "none" : count(number);
}

std::string speed_text(double speed) { return number(speed, 4) + " m/s"; }

}  // namespace

FigureContent crack_maps(const StudyResult& study) {
  FigureContent content;
  content.statement =
      "In tension the block breaks in two by opening, without slipping; in compression bonds open first, and the block "
      "fails in sliding mode.";
  content.rows = {"pieces", "no_sliding_in_tension", "frictional_heat", "opening_before_sliding"};
  std::vector<std::string> said, opened, slid;
  const dem::Record* pressed = main_record(study, "compression");
  if (pressed && !has_failure(*pressed)) {
    said.push_back(no_failure_words(*pressed));
  } else if (pressed) {
    const double c1 = pressed->value_or_nan(quantity::sliding_start),
                 c2 = c1 + pressed->value_or_nan(quantity::sliding_duration);
    const double dropped = analysis::fall_at(*pressed, pressed->value_or_nan(quantity::a1_time)).low_time;
    content.panels.push_back(by_mode(*pressed, "compression_opening", dropped, "Compression, least stress after A₁"));
    content.panels.push_back(by_mode(*pressed, "compression_end", 1e9, "Compression, at the end"));
    content.panels.push_back(
        by_time(*pressed, "compression_time", c1, c2, "Compression, C₁ to C₂", oblique, "C₁", "broke"));
    said.push_back(fmt::format("in compression {} bonds opened and {} slid",
                               count(pressed->value(quantity::cracks_opening)),
                               none_or(quantity::cracks_sliding, *pressed)));
  }
  for (const dem::Record* r : records_of(study, "tension")) {
    if (!has_failure(*r)) {
      said.push_back(no_failure_words(*r));
      continue;
    }
    const std::string planes = planes_of(*r), named = "Tension, " + planes + " planes";
    const double d1 = r->value_or_nan(quantity::failure_time), d2 = d1 + r->value_or_nan(quantity::crack_duration);
    content.panels.push_back(by_time(*r, "tension_time_" + planes, d1, d2, named, oblique, "D₁", "opened"));
    content.panels.push_back(by_time(*r, "tension_side_" + planes, d1, d2, named, along_y, "D₁", "opened"));
    content.panels.push_back(halves(*r, "tension_halves_" + planes, named));
    opened.push_back(count(r->value(quantity::cracks_opening)) + " (" + planes + " planes)");
    slid.push_back(none_or(quantity::cracks_sliding, *r));
  }
  if (!opened.empty()) {
    const bool none = std::ranges::all_of(slid, [](const std::string& number) { return number == "none"; });
    said.push_back("in tension " + listed(opened) + " opened and " + (none ? "none" : listed(slid)) + " slid");
  }
  if (!said.empty()) {
    content.finding = sentence(said);
  }
  return content;
}

namespace {

/// Speeds of waves in the rock (m/s), by its E, nu and density.
struct Waves {
  double longitudinal, shear;
};
Waves waves_of(const dem::Scenario& s) {
  const double nu = s.real("rock.poisson_ratio"), e_by_density = s.real("rock.young_modulus") / s.real("rock.density");
  return {std::sqrt(e_by_density * (1 - nu) / ((1 + nu) * (1 - 2 * nu))), std::sqrt(e_by_density / (2 * (1 + nu)))};
}

/// What leaves the first opening at a speed, until a time (µs) or the farthest one (mm).
render::Series way_of(double speed, double last, double far) {
  return line_of(
      0, std::min(last, 1e3 * far / speed), [&](double t) { return 1e-3 * speed * t; }, 1);
}
render::Series wave_line(double speed, double last, double far, const std::string& label, render::Line line) {
  render::Series series = way_of(speed, last, far);
  series.label = label;
  series.colour = {0.45, 0.45, 0.45};
  series.line = line;
  series.width = 1.4;
  return series;
}

/// How a speed stands to those of waves.
std::string_view beside(const Waves& waves, double speed) {
  return speed <= waves.shear          ? "slower than both"
         : speed <= waves.longitudinal ? "between the two"
                                       : "faster than both";
}
/// What that tells of the front of a crack.
constexpr std::array<std::pair<std::string_view, std::string_view>, 3> told{
    {{"slower than both", ", as a single opening crack is"},
     {"between the two", ": a single opening crack in a continuum stays below shear waves"},
     {"faster than both", ": several cracks that open independently"}}};

/// Speeds of the crack (m/s) with planes that hold the end elements in one way; NaN where there is none.
struct Speeds {
  std::string planes;
  double front, width;  // of its advance, of the width of the block over the time from D1 to D2
};

/// "In the rock shear waves (c_S) run at 3826 m/s and longitudinal ones (c_P) at 6014 m/s; the published 4240 m/s is between
/// the two. With rigid planes the front is slower than both, as a single opening crack is."
std::string waves_words(const Waves& waves, const std::vector<Speeds>& speeds, double published) {
  std::string text = fmt::format(" In the rock shear waves (c_S) run at {} m/s and longitudinal ones (c_P) at {} m/s",
                                 number(waves.shear, 3), number(waves.longitudinal, 3));
  if (std::isfinite(published))
    text += fmt::format("; the published {} is {}", speed_text(published), beside(waves, published));
  text += ".";
  for (const auto& [word, means] : told) {
    std::vector<std::string> front, width;
    for (const Speeds& one : speeds) {
      const bool known = std::isfinite(one.front);
      if (known && beside(waves, one.front) == word) front.push_back(one.planes);
      const bool other = !known || beside(waves, one.front) != beside(waves, one.width);
      if (std::isfinite(one.width) && other && beside(waves, one.width) == word) width.push_back(one.planes);
    }
    if (!front.empty()) text += fmt::format(" With {} planes the front is {}{}.", listed(front), word, means);
    if (!width.empty())
      text += fmt::format(" By the width over the time the speed is {} with {} planes.", word, listed(width));
  }
  return text;
}

}  // namespace

FigureContent crack_front(const StudyResult& study) {
  FigureContent content;
  content.statement =
      "Breaking heat rises for 2.83 × 10⁻⁶ s in a block 1.2 cm wide: the opening crack runs at about 4240 m/s.";
  content.rows = {"crack_duration", "crack_speed"};
  std::vector<std::string> said, fronts, few, widths;
  std::vector<Speeds> speeds;
  const Waves waves = waves_of(*study.scenario);
  for (const dem::Record* r : records_of(study, "tension")) {
    if (!has_failure(*r)) {
      said.push_back(no_failure_words(*r));
      continue;
    }
    Front f = front_of(*r);
    if (f.points.x.empty()) continue;
    const std::string planes = planes_of(*r);
    render::Chart chart;
    chart.x.title = "Time since D₁ (µs)";
    chart.left.title = "Distance from the first opening (mm)";
    chart.left.low = 0;
    f.points = styled(f.points, "bonds that opened", 1, render::Line::none);
    f.points.marker = render::Marker::circle;
    f.reach = styled(f.reach, "farthest so far", 5);
    chart.series = {f.points, f.reach};
    if (!f.line.x.empty()) chart.series.push_back(styled(f.line, speed_text(f.speed), 0, render::Line::dash));
    const double speed = study.published_value("crack_speed");  // m/s
    const double last = std::ranges::max(f.points.x), far = std::ranges::max(f.reach.y);
    if (std::isfinite(speed) && last > 0) {
      render::Series line = way_of(speed, last, far);
      line.label = "published " + speed_text(speed);
      line.colour = published_colour;
      line.line = render::Line::dash;
      chart.series.push_back(line);
    }
    if (last > 0) {
      chart.series.push_back(wave_line(waves.longitudinal, last, far,
                                       fmt::format("c_{{P}}, {} m/s", number(waves.longitudinal, 3)),
                                       render::Line::dot));
      chart.series.push_back(wave_line(waves.shear, last, far, fmt::format("c_{{S}}, {} m/s", number(waves.shear, 3)),
                                       render::Line::dash_dot));
    }
    chart.legend = render::Chart::Legend::below;
    chart.height = 240;
    content.panels.push_back({.id = planes,
                              .caption = fmt::format("{} planes: distance across the load between each opened bond "
                                                     "and the nearest of the first{}.",
                                                     capital(planes),
                                                     f.line.x.empty() ? ""
                                                                      : "; the blue dashed line is fitted to the "
                                                                        "farthest so far from 10 to 90 % of its way") +
                                         " Grey: waves of the rock that leave the first opening at D₁.",
                              .alt = fmt::format("The farthest opening runs at {}.",
                                                 std::isfinite(f.speed) ? speed_text(f.speed) : "no one speed"),
                              .content = chart});
    speeds.push_back({planes, f.speed, r->value_or_nan(quantity::crack_speed)});
    if (std::isfinite(f.speed)) {
      fronts.push_back(speed_text(f.speed) + " (" + planes + " planes)");
    } else {
      few.push_back(planes + " planes");
    }
    widths.push_back(number(r->value_or_nan(quantity::crack_speed), 4) + " m/s (" + planes + " planes)");
  }
  if (!fronts.empty()) said.push_back("between 10 and 90 % of its way the crack front runs at " + listed(fronts));
  if (!few.empty() && !fronts.empty())
    said.push_back("with " + listed(few) + " it advances there in fewer than three steps, too few for a speed");
  else if (!few.empty())
    said.push_back("between 10 and 90 % of its way the crack front advances in fewer than three steps (" + listed(few) +
                   "), too few for a speed");
  if (!widths.empty()) said.push_back("the width of the block over the time from D₁ to D₂ gives " + listed(widths));
  if (said.empty()) return content;
  content.finding = sentence(said);
  if (!speeds.empty()) content.finding += waves_words(waves, speeds, study.published_value("crack_speed"));
  return content;
}

}  // namespace reports::lattice
