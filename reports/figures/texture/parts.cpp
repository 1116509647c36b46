#include "reports/figures/texture/parts.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <numeric>
#include <set>
#include <sstream>

#include "engine/analysis/ending.h"
#include "reports/figures/texture/failed.h"
#include "reports/text.h"

namespace reports::texture {
namespace {

// A tone for each grain: 0.90 to 1.06 of its mineral's colour.
double tone(std::int32_t grain) {
  std::uint32_t bits = static_cast<std::uint32_t>(grain) * 2654435761U;
  bits ^= bits >> 15U;
  return 0.90 + 0.16 * static_cast<double>(bits % 1024U) / 1023.0;
}

render::Colour toned(const render::Colour& colour, double factor) {
  return {std::min(1.0, colour.red * factor), std::min(1.0, colour.green * factor),
          std::min(1.0, colour.blue * factor)};
}

/// The cracks table, read once.
struct Cracks {
  std::span<const double> position, normal, area;
  std::span<const std::int32_t> place, mode;
  std::size_t count = 0;
};

Cracks cracks_of(const dem::Record& record, std::size_t count) {
  const dem::Table& table = record.table("cracks");
  return {table.real("position"), table.real("normal"),  table.real("area"),
          table.integer("place"), table.integer("mode"), std::min(count, table.rows())};
}

std::size_t class_of(const Cracks& cracks, std::size_t i) {
  const auto& classes = crack_classes();
  const auto found = std::ranges::find_if(
      classes, [&](const CrackClass& c) { return c.place == cracks.place[i] && c.mode == cracks.mode[i]; });
  return static_cast<std::size_t>(found - classes.begin());
}

// By place in the scenario's list: light and dark in turn, muted, so that cracks show. The first four are those of the
// paper's granite, whose list is plagioclase, alkali feldspar, quartz, biotite.
constexpr std::array<render::Colour, 6> mineral_palette{{{0.737, 0.604, 0.169},    // dark yellow
                                                         {0.965, 0.914, 0.663},    // light yellow
                                                         {0.737, 0.749, 0.773},    // light grey
                                                         {0.227, 0.255, 0.306},    // dark grey
                                                         {0.349, 0.525, 0.498},    // grey green
                                                         {0.573, 0.290, 0.298}}};  // dull red

render::Colour from_text(const std::string& text) {
  const auto part = [&](std::size_t at) { return std::stoi(text.substr(at, 2), nullptr, 16) / 255.0; };
  return {part(1), part(3), part(5)};
}

// Half a mean particle diameter to either side: the slab that the cut particles stand for.
double section_reach(const dem::Record& record) { return 0.5 * mean_diameter(record); }

bool near_section(const Cracks& cracks, std::size_t i, double distance) {
  return std::abs(cracks.position[3 * i + 1]) <= distance;
}

std::array<std::size_t, 4> numbers_in_section(const dem::Record& record, std::size_t count) {
  const Cracks cracks = cracks_of(record, count);
  const double distance = section_reach(record);
  std::array<std::size_t, 4> numbers{};
  for (std::size_t i = 0; i < cracks.count; ++i) {
    const std::size_t k = class_of(cracks, i);
    if (k < numbers.size() && near_section(cracks, i, distance)) ++numbers[k];
  }
  return numbers;
}

}  // namespace

std::vector<LegendEntry> crack_legend(const std::array<std::size_t, 4>& numbers) {
  std::vector<LegendEntry> legend;
  for (std::size_t k = 0; k < numbers.size(); ++k) {
    const CrackClass& one = crack_classes()[k];
    legend.push_back({one.colour, std::string(one.name), count(static_cast<double>(numbers[k]))});
  }
  return legend;
}

std::array<render::Point, 2> frame_of(const Size& size) {
  const double half = 0.5 * size.diameter;
  return {{{-half, -half, size.z_low}, {half, half, size.z_low + size.height}}};
}

std::string at_case(const SeriesCase& item) {
  return (item.label == words(item.record->text("test")) ? "in " : "at ") + item.label;
}

std::string tension_label(const StudyResult& study, const SeriesCase& item) {
  const std::string test = words(test_tension);
  const bool says_it = item.label == test || swept_axis(study).id == parameter::confining_pressure.id;
  return says_it ? test : test + ", " + item.label;
}

double mean_diameter(const dem::Record& record) {
  const auto radius = record.table("particles").real("radius");
  return radius.empty() ? 0
                        : 2 * std::accumulate(radius.begin(), radius.end(), 0.0) / static_cast<double>(radius.size());
}

const dem::Parameter& swept_axis(const StudyResult& study) {
  static constexpr std::array axes{parameter::aspect_ratio, parameter::dip, parameter::confining_pressure};
  const dem::Parameter* most = axes.data();
  std::size_t values = 0;
  for (const dem::Parameter& axis : axes) {
    std::size_t n = 0;
    for (const auto test : {test_compression, test_tension, test_genesis})
      n = std::max(n, analysis::series_of(study.cases, test, axis).size());
    if (n > values) most = &axis, values = n;
  }
  return *most;
}

std::vector<SeriesCase> swept(const StudyResult& study, std::string_view test) {
  return series_of(study, test, swept_axis(study));
}

std::vector<SeriesCase> swept_by_test(const StudyResult& study, std::string_view test) {
  std::vector<SeriesCase> cases = swept(study, test);
  const bool alone = std::ranges::all_of(study.cases, [&](const CaseResult& one) { return one.test() == test; });
  if (cases.size() == 1 && !alone) cases.front().label = words(test);
  return cases;
}

const dem::Record* first_specimen(const StudyResult& study) {
  const auto cases = swept(study, test_genesis);
  return cases.empty() ? nullptr : cases.front().record;
}

const std::array<CrackClass, 4>& crack_classes() {
  static const std::array<CrackClass, 4> classes{
      {{"inter_tension", "inter-grain tension", 1, 0, {0.741, 0.263, 0.0}, quantity::cracks_inter_tension},
       {"inter_shear", "inter-grain shear", 1, 1, {0.0, 0.0, 0.0}, quantity::cracks_inter_shear},
       {"intra_tension", "intra-grain tension", 0, 0, {0.0, 0.302, 0.612}, quantity::cracks_intra_tension},
       {"intra_shear", "intra-grain shear", 0, 1, {0.247, 0.592, 0.871}, quantity::cracks_intra_shear}}};
  return classes;
}

std::vector<std::string> minerals_of(const dem::Record& record) {
  std::vector<std::string> names;
  std::istringstream list(record.table("particles").attribute("minerals"));
  for (std::string name; std::getline(list, name, ',');) names.push_back(name);
  return names;
}

render::Colour mineral_colour(const StudyResult& study, std::string_view mineral) {
  if (!study.scenario) return mineral_palette.front();
  const dem::Scenario& s = *study.scenario;
  // Results have signs of a name as "_", and names of groups are shown with blanks for them.
  const auto plain = [](std::string text) {
    std::ranges::transform(text, text.begin(),
                           [](unsigned char c) { return std::isalnum(c) != 0 ? std::tolower(c) : ' '; });
    return text;
  };
  for (std::size_t place = 0; place < s.count("mineral"); ++place) {
    if (plain(s.text(fmt::format("mineral[{}].name", place))) != plain(std::string(mineral))) continue;
    const std::string& chosen = s.text(fmt::format("mineral[{}].colour", place));
    return chosen.empty() ? mineral_palette[place % mineral_palette.size()] : from_text(chosen);
  }
  return mineral_palette.front();
}

Size size_of(const dem::Record& record) {
  const dem::Table& particles = record.table("particles");
  const std::string diameter = particles.attribute("diameter");
  const std::string height = particles.attribute("height");
  if (!diameter.empty() && !height.empty()) return {std::stod(diameter), std::stod(height), 0};
  Size size;
  const auto position = particles.real("position");
  const auto radius = particles.real("radius");
  double low = 0;
  double high = 0;
  for (std::size_t i = 0; i < radius.size(); ++i) {
    const double z = position[3 * i + 2];
    low = i == 0 ? z - radius[i] : std::min(low, z - radius[i]);
    high = i == 0 ? z + radius[i] : std::max(high, z + radius[i]);
    size.diameter = std::max(size.diameter, 2 * (std::hypot(position[3 * i], position[3 * i + 1]) + radius[i]));
  }
  size.z_low = low;
  size.height = high - low;
  return size;
}

render::Spheres particles_by_mineral(const StudyResult& study, const dem::Record& record) {
  const dem::Table& particles = record.table("particles");
  const auto position = particles.real("position");
  const auto radius = particles.real("radius");
  const auto mineral = particles.integer("mineral");
  const auto grain = particles.integer("grain");
  std::vector<render::Colour> colours;
  for (const std::string& name : minerals_of(record)) colours.push_back(mineral_colour(study, name));
  render::Spheres spheres;
  for (std::size_t i = 0; i < radius.size(); ++i) {
    spheres.centre.push_back({position[3 * i], position[3 * i + 1], position[3 * i + 2]});
    spheres.radius.push_back(radius[i]);
    const auto index = static_cast<std::size_t>(mineral[i]);
    const render::Colour colour = index < colours.size() ? colours[index] : mineral_palette.front();
    spheres.colour.push_back(toned(colour, tone(grain[i])));
  }
  return spheres;
}

render::Scene specimen_scene(const StudyResult& study, const dem::Record& record, int width) {
  const Size size = size_of(record);
  render::Scene scene;
  scene.axes = true;
  scene.spheres.push_back(particles_by_mineral(study, record));
  scene.camera.frame = frame_of(size);
  scene.width = width;
  scene.height = static_cast<int>(std::lround(width * std::max(0.5, size.height / size.diameter)));
  return scene;
}

render::Scene section_scene(const StudyResult& study, const dem::Record& record, int width) {
  render::Scene scene = specimen_scene(study, record, width);
  scene.cuts.push_back({{0, 0, 0}, {0, 1, 0}});
  return scene;
}

std::vector<render::Discs> crack_discs(const dem::Record& record, std::size_t count, double scale) {
  const Cracks cracks = cracks_of(record, count);
  std::vector<render::Discs> discs(crack_classes().size());
  for (std::size_t i = 0; i < cracks.count; ++i) {
    const std::size_t k = class_of(cracks, i);
    if (k >= discs.size()) continue;
    discs[k].centre.push_back({cracks.position[3 * i], cracks.position[3 * i + 1], cracks.position[3 * i + 2]});
    discs[k].normal.push_back({cracks.normal[3 * i], cracks.normal[3 * i + 1], cracks.normal[3 * i + 2]});
    discs[k].radius.push_back(scale * std::sqrt(cracks.area[i] / std::numbers::pi));
    discs[k].colour.push_back(crack_classes()[k].colour);
  }
  return discs;
}

std::vector<render::Polyline> crack_traces(const dem::Record& record, std::size_t count, double width) {
  const Cracks cracks = cracks_of(record, count);
  const double distance = section_reach(record);
  std::vector<render::Polyline> traces;
  for (std::size_t i = 0; i < cracks.count; ++i) {
    const std::size_t k = class_of(cracks, i);
    if (k >= crack_classes().size() || !near_section(cracks, i, distance)) continue;
    // The line in which the crack's plane crosses y = 0: along n x y.
    double along_x = -cracks.normal[3 * i + 2];
    double along_z = cracks.normal[3 * i];
    const double length = std::hypot(along_x, along_z);
    if (length < 1e-12)
      along_x = 1;
    else
      along_x /= length, along_z /= length;
    const double half = std::sqrt(cracks.area[i] / std::numbers::pi);
    const double x = cracks.position[3 * i];
    const double z = cracks.position[3 * i + 2];
    traces.push_back({{{x - half * along_x, 0, z - half * along_z}, {x + half * along_x, 0, z + half * along_z}},
                      crack_classes()[k].colour,
                      width,
                      render::Line::solid,
                      true});
  }
  return traces;
}

std::array<std::size_t, 4> crack_numbers(const dem::Record& record, std::size_t count) {
  const Cracks cracks = cracks_of(record, count);
  std::array<std::size_t, 4> numbers{};
  for (std::size_t i = 0; i < cracks.count; ++i) {
    const std::size_t k = class_of(cracks, i);
    if (k < numbers.size()) ++numbers[k];
  }
  return numbers;
}

Picture transparent_cracks(const dem::Record& record, std::size_t count, const std::string& label, int width,
                           double scale) {
  const Size size = size_of(record);
  render::Scene scene;
  scene.axes = true;
  scene.discs = crack_discs(record, count, scale);
  scene.outline = outline_of(record);
  scene.camera.frame = frame_of(size);
  scene.width = width;
  scene.height = static_cast<int>(std::lround(width * std::max(0.5, size.height / size.diameter)));
  return {.scene = std::move(scene), .label = label, .legend = crack_legend(crack_numbers(record, count))};
}

double legible_disc_scale(const dem::Record& record) {
  const Cracks cracks = cracks_of(record, all_cracks);
  // A disc of any direction covers half its area; half the picture may be covered.
  const double covered = 0.5 * std::accumulate(cracks.area.begin(), cracks.area.end(), 0.0);
  const Size size = size_of(record);
  if (!(covered > 0)) return 1;
  const double scale = std::sqrt(0.5 * size.diameter * size.height / covered);
  return std::clamp(0.1 * std::round(10 * scale), 0.2, 1.0);
}

Picture section_cracks(const StudyResult& study, const dem::Record& record, std::size_t count, const std::string& label,
                       int width) {
  render::Scene scene = section_scene(study, record, width);
  scene.lines = crack_traces(record, count, 1.2);
  Picture picture{.scene = std::move(scene), .label = label, .legend = crack_legend(numbers_in_section(record, count))};
  for (LegendEntry& mineral : mineral_legend(study, record)) picture.legend.push_back(std::move(mineral));
  return picture;
}

double CrackDensity::largest() const { return value.empty() ? 0 : std::ranges::max(value); }

double end_of_bar(double largest) {
  if (!(largest > 0)) return 0;
  const double power = std::pow(10, std::floor(std::log10(largest)));
  for (const double step : {1.0, 1.5, 2.0, 3.0, 4.0, 6.0})
    if (step * power >= largest) return step * power;
  return 10 * power;
}

CrackDensity crack_density(const dem::Record& record, std::size_t count) {
  const Size size = size_of(record);
  const Cracks cracks = cracks_of(record, count);
  const dem::Table& particles = record.table("particles");
  const auto position = particles.real("position");
  const auto radius = particles.real("radius");
  const auto grains = record.table("grains").real("radius");
  CrackDensity density;
  if (grains.empty() || radius.empty()) return density;
  const double width = std::accumulate(grains.begin(), grains.end(), 0.0) / static_cast<double>(grains.size());
  // The particles fill the same share of the specimen everywhere: as much volume as they stand for, over theirs.
  const double room = 1 / (1 - record.value_or_nan(quantity::porosity));

  constexpr double finest = 56;  // over the diameter
  density.spacing = std::min(size.diameter, 2 * size.height) / finest;
  const int across = static_cast<int>(std::ceil(size.diameter / density.spacing - 1e-9));
  const int up = static_cast<int>(std::ceil(size.height / density.spacing));
  const double reach = 3 * width;
  std::vector<double> area(static_cast<std::size_t>(across * up), 0.0), volume = area;
  const auto place = [&](int i, int k) {
    return render::Point{-0.5 * size.diameter + (i + 0.5) * density.spacing, 0,
                         size.z_low + (k + 0.5) * density.spacing};
  };
  const auto spread = [&](std::vector<double>& sums, double x, double y, double z, double weight) {
    if (std::abs(y) > reach) return;
    const auto low = [&](double v) { return std::max(0, static_cast<int>(std::floor((v - reach) / density.spacing))); };
    const auto high = [&](double v, int end) {
      return std::min(end - 1, static_cast<int>(std::ceil((v + reach) / density.spacing)));
    };
    const double from_left = x + 0.5 * size.diameter, from_below = z - size.z_low;
    for (int k = low(from_below); k <= high(from_below, up); ++k) {
      for (int i = low(from_left); i <= high(from_left, across); ++i) {
        const render::Point p = place(i, k);
        const double square = (p[0] - x) * (p[0] - x) + y * y + (p[2] - z) * (p[2] - z);
        if (square > reach * reach) continue;
        sums[static_cast<std::size_t>(k * across + i)] += weight * std::exp(-0.5 * square / (width * width));
      }
    }
  };
  for (std::size_t i = 0; i < cracks.count; ++i) {
    spread(area, cracks.position[3 * i], cracks.position[3 * i + 1], cracks.position[3 * i + 2], cracks.area[i]);
  }
  for (std::size_t i = 0; i < radius.size(); ++i) {
    const double r = radius[i];
    spread(volume, position[3 * i], position[3 * i + 1], position[3 * i + 2],
           4.0 / 3 * std::numbers::pi * r * r * r * room);
  }
  for (int k = 0; k < up; ++k) {
    for (int i = 0; i < across; ++i) {
      const auto at = static_cast<std::size_t>(k * across + i);
      if (!(volume[at] > 0)) continue;
      density.at.push_back(place(i, k));
      density.value.push_back(1e-3 * area[at] / volume[at]);
    }
  }
  return density;
}

namespace {

// From white over orange to nearly black: lightness falls evenly, so that grey print says the same.
render::Colour density_colour(double share) {
  constexpr std::array<render::Colour, 4> stops{
      {{1.0, 1.0, 0.94}, {0.98, 0.72, 0.35}, {0.78, 0.26, 0.12}, {0.22, 0.02, 0.10}}};
  const double at = std::clamp(share, 0.0, 1.0) * static_cast<double>(stops.size() - 1);
  const auto low = std::min(static_cast<std::size_t>(at), stops.size() - 2);
  const double part = at - static_cast<double>(low);
  const auto mix = [&](double render::Colour::*c) {
    return stops[low].*c + part * (stops[low + 1].*c - stops[low].*c);
  };
  return {mix(&render::Colour::red), mix(&render::Colour::green), mix(&render::Colour::blue)};
}

}  // namespace

Picture density_picture(const dem::Record& record, const CrackDensity& density, double high, const std::string& label,
                        int width) {
  const Size size = size_of(record);
  render::Spheres spheres;
  spheres.cut_edges = false;
  for (std::size_t i = 0; i < density.at.size(); ++i) {
    spheres.centre.push_back(density.at[i]);
    spheres.radius.push_back(0.74 * density.spacing);  // no gap between four
    spheres.colour.push_back(density_colour(high > 0 ? density.value[i] / high : 0));
  }
  render::Scene scene;
  scene.spheres.push_back(std::move(spheres));
  scene.cuts.push_back({{0, 0, 0}, {0, 1, 0}});
  scene.camera.frame = frame_of(size);
  scene.axes = true;
  scene.bar = render::ColourBar{.title = "mm²/mm³", .low = 0, .high = high, .colours = {}};
  for (int k = 0; k < 64; ++k) scene.bar->colours.push_back(density_colour((k + 0.5) / 64));
  scene.width = width;
  scene.height = static_cast<int>(std::lround(width * std::max(0.5, size.height / size.diameter)));
  return {.scene = std::move(scene), .label = label, .legend = {}};
}

std::string crack_words(const std::array<std::size_t, 4>& numbers) {
  std::vector<std::string> parts;
  for (std::size_t k = 0; k < numbers.size(); ++k) {
    parts.push_back(count(static_cast<double>(numbers[k])) + " " + std::string(crack_classes()[k].name));
  }
  return listed(parts);
}

std::vector<LegendEntry> mineral_legend(const StudyResult& study, const dem::Record& record) {
  std::vector<LegendEntry> legend;
  for (const std::string& name : minerals_of(record)) legend.push_back({mineral_colour(study, name), name});
  return legend;
}

Panel cracks_at_end(const StudyResult& study, const SeriesCase& item, std::string caption, int width,
                    const std::function<void(render::Scene&)>& load) {
  Picture picture = section_cracks(study, *item.record, all_cracks, item.label, width);
  if (load) load(picture.scene);
  return {.id = "cracks_" + item.id,
          .caption = std::move(caption),
          .alt = "Cracks at the end of loading: " + crack_words(crack_numbers(*item.record, all_cracks)) + ".",
          .content = std::move(picture)};
}

Agreement agreement_within(const analysis::Estimate& mean, double low, double high) {
  if (!mean.has_interval()) return Agreement::undecided;
  if (mean.low >= low && mean.high <= high) return Agreement::agrees;
  return mean.high < low || mean.low > high ? Agreement::disagrees : Agreement::undecided;
}

std::string first_seed(const std::vector<SeriesCase>& cases) {
  return std::ranges::any_of(cases, [](const SeriesCase& item) { return item.repeats.size() > 1; }) ? ", first seed"
                                                                                                    : "";
}

render::Chart load_curves(const std::vector<SeriesCase>& cases, const CurveOf& of, const std::string& x_title,
                          const std::string& y_title) {
  render::Chart chart;
  chart.x.title = x_title;
  chart.left.title = y_title;
  chart.left.low = 0;
  add_curves(chart, cases, of);
  leave_room(chart);
  chart.legend = cases.size() > 1 ? render::Chart::Legend::below : render::Chart::Legend::none;
  return chart;
}

bool mark_end_of_loading(render::Chart& chart, const std::vector<SeriesCase>& cases, const CurveOf& of) {
  if (std::ranges::none_of(cases, [](const SeriesCase& item) { return analysis::is_followed(*item.record); }))
    return false;
  render::Series marks{.label = "end of loading",
                       .x = {},
                       .y = {},
                       .colour = {0, 0, 0},
                       .line = render::Line::none,
                       .marker = render::Marker::cross,
                       .y_error = {}};
  for (const SeriesCase& item : cases) {
    const dem::Table& history = item.record->table("history");
    const std::size_t end = analysis::end_of_loading(*item.record);
    marks.x.push_back(of.x_factor * history.real(of.x)[end]);
    marks.y.push_back(of.y_factor * history.real(of.y)[end]);
  }
  chart.series.push_back(std::move(marks));
  return true;
}

std::string reading_of(const dem::Record& record, const StudyResult& study) {
  const dem::Scenario& s = *study.scenario;
  std::vector<std::string> readings;
  const auto add = [&](const dem::Parameter& one, const auto& value, const auto& usual) {
    if (value != usual) readings.push_back(parameter_words(one, value));
  };
  using namespace parameter;
  add(seed_scale, record.number(seed_scale.id), s.real(seed_scale.key));
  add(growth, record.text(growth.id), s.text(growth.key));
  add(between, record.text(between.id), s.text(between.key));
  add(pressure_ratio, record.number(pressure_ratio.id), s.real(pressure_ratio.key));
  return joined(readings, ", ");
}

}  // namespace reports::texture
