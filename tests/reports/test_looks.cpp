// What every figure of every shipped scenario looks like, by numbers: colours that readers with and without red or green
// cones and grey print tell apart, lines and words that show on their ground, type of one size, axes that can be read.
// From the smallest scale of each scenario, whose records the comparison with the references has left; nothing is drawn.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <regex>
#include <set>
#include <thread>

#include "engine/model/model.h"
#include "engine/study/study.h"
#include "render/chart/layout.h"
#include "render/colour.h"
#include "reports/figure.h"
#include "reports/output/drawing.h"
#include "reports/published/papers.h"
#include "reports/published/published.h"

namespace {

namespace fs = std::filesystem;
using render::Chart;
using render::Colour;

const fs::path source = DEM_SOURCE_DIR;
constexpr double apart = 15, apart_in_grey = 10;
constexpr Colour white{1, 1, 1};

// One px of a chart where it is shown: in print a column is 85 mm wide; on a page of 1280 px it is 471 px wide.
constexpr double points = render::column_mm / 25.4 * 72 / render::column_width, screen = 471.0 / render::column_width;

/// What tells a class of a figure from the others besides its colour.
struct Class {
  std::string name;
  Colour colour;
  render::Line line = render::Line::none;
  render::Marker marker = render::Marker::none;
  bool hollow = false;
  render::Pattern pattern = render::Pattern::none;
  bool area = false;
  [[nodiscard]] bool patterned_as(const Class& other) const {
    return line == other.line && marker == other.marker && hollow == other.hollow && pattern == other.pattern &&
           area == other.area;
  }
};

std::vector<Class> classes_of(const Chart& chart) {
  std::vector<Class> found;
  if (chart.bars)
    for (std::size_t s = 0; s < chart.bars->labels.size(); ++s) {
      const bool hatched = s < chart.bars->patterns.size();
      found.push_back({.name = chart.bars->labels[s],
                       .colour = chart.bars->colours[s],
                       .pattern = hatched ? chart.bars->patterns[s] : render::Pattern::none,
                       .area = true});
    }
  for (const render::Series& s : chart.series)
    if (!s.label.empty())
      found.push_back({.name = s.label, .colour = s.colour, .line = s.line, .marker = s.marker, .hollow = s.hollow});
  for (const render::Band& b : chart.bands)
    if (!b.label.empty()) found.push_back({.name = b.label, .colour = b.colour, .area = true});
  return found;
}

void check_apart(const std::vector<Class>& classes) {
  for (std::size_t i = 0; i < classes.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) {
      const Class &one = classes[i], &two = classes[j];
      if (!one.patterned_as(two)) continue;
      CAPTURE(one.name);
      CAPTURE(two.name);
      CHECK(render::difference(one.colour, two.colour) >= apart);
      CHECK(std::abs(render::lab(one.colour).lightness - render::lab(two.colour).lightness) >= apart_in_grey);
    }
  for (std::size_t i = 1; i < classes.size(); ++i) {  // neighbours differ by colour, too, where they are areas
    if (!classes[i].area || !classes[i - 1].area || classes[i].pattern != classes[i - 1].pattern) continue;
    CAPTURE(classes[i].name);
    CHECK(render::difference(classes[i].colour, classes[i - 1].colour) >= apart);
  }
}

void check_ground(const Chart& chart) {
  for (const render::Series& s : chart.series) {
    CAPTURE(s.label);
    CHECK(render::contrast(s.colour, white) >= 3);
  }
  for (const render::Mark& m : chart.marks) {
    CAPTURE(m.label);
    CHECK(render::contrast(m.colour, white) >= 3);
  }
}

void check_axis(const render::Scale& scale, const std::string& title) {
  CAPTURE(title);
  std::size_t labelled = 0;
  for (const render::Tick& tick : scale.ticks) {
    const double share = scale.share(tick.value);
    if (!tick.label.empty() && share > -1e-6 && share < 1 + 1e-6) ++labelled;
  }
  CHECK(labelled > 2);
}

void check_axes(const Chart& chart) {
  const render::Rect area{0, 0, static_cast<double>(chart.width), static_cast<double>(chart.height - chart.foot)};
  const render::ChartLayout layout = render::lay_out(chart, area, 12, chart.legend);
  if (!chart.bars) check_axis(layout.x, chart.x.title);
  check_axis(layout.left, chart.left.title);
  if (layout.has_right) check_axis(layout.right, chart.right.title);
  // Bars from zero, and a curve on another axis: two panels.
  if (!chart.bars) return;
  for (const render::Series& s : chart.series) CHECK(s.side == chart.bars->side);
}

void check_type(const Chart& chart, double least) {
  const render::Paper paper = render::paper_of(chart);
  for (const auto& item : paper.items()) {
    const auto* run = std::get_if<render::Run>(&item);
    if (!run) continue;
    CAPTURE(run->text);
    CHECK(run->text.find("_{") == std::string::npos);
    CHECK(render::contrast(run->style.colour, run->style.colour.red > 0.5 ? Colour{0.3, 0.3, 0.3} : white) >= 4.5);
    if (run->index) continue;  // as small as indices are
    CHECK(run->style.size * points >= least);
    CHECK(run->style.size * points <= 9);
    CHECK(run->style.size * screen >= 11);
    CHECK(run->style.size * screen <= 16);
    const double width = render::text_width(run->text, run->style.size), size = run->style.size;
    const double back = run->style.anchor == render::Anchor::start    ? 0
                        : run->style.anchor == render::Anchor::middle ? width / 2
                                                                      : width;
    const double from = (run->style.upward ? -run->at.y : run->at.x) - back;
    const double end = run->style.upward ? 0 : paper.width();
    CHECK(from >= (run->style.upward ? -paper.height() - 1.0 : -1.0));
    CHECK(from + width <= end + 1);
    CHECK(run->at.y <= paper.height() + 0.3 * size);
  }
}

// The word in an area lies in it: beside it, in the ink for its colour, it would not be seen.
void check_words_in_bands(const Chart& chart) {
  const render::Rect area{0, 0, static_cast<double>(chart.width), static_cast<double>(chart.height - chart.foot)};
  const render::ChartLayout layout = render::lay_out(chart, area, 12, chart.legend);
  for (std::size_t b = 0; b < chart.bands.size(); ++b) {
    if (!layout.inside[b]) continue;
    const render::Band& band = chart.bands[b];
    CAPTURE(band.label);
    const double half = render::text_width(band.label, layout.text) / 2, tall = 0.5 * layout.text;
    const auto edge = [&](const std::vector<double>& values, double x) {
      std::size_t i = 0;
      while (i + 2 < band.x.size() && layout.across(band.x[i + 1]) < x) ++i;
      const double from = layout.across(band.x[i]), to = layout.across(band.x[i + 1]);
      const double t = to > from ? (x - from) / (to - from) : 0;
      return layout.down(values[i] + t * (values[i + 1] - values[i]), band.side);
    };
    for (const double x : {layout.inside[b]->x - half, layout.inside[b]->x, layout.inside[b]->x + half}) {
      CHECK(edge(band.high, x) <= layout.inside[b]->y - tall + 0.1);
      CHECK(edge(band.low, x) >= layout.inside[b]->y + tall - 0.1);
    }
  }
}

void check(const Chart& chart) {
  CHECK((chart.width == render::column_width || chart.width == render::page_width));
  check_apart(classes_of(chart));
  check_ground(chart);
  check_axes(chart);
  check_words_in_bands(chart);
  Chart outer = chart;
  outer.insets.clear();
  check_type(outer, 7);
  check_type(chart, 6);
  for (const render::Inset& inset : chart.insets) {
    check_ground(inset.chart[0]);
    check_apart(classes_of(inset.chart[0]));
  }
}

void check(const reports::Picture& picture) {
  std::vector<Class> classes;
  for (const reports::LegendEntry& entry : picture.legend)
    // Cracks are lines or discs, of which there is a count; minerals are areas.
    classes.push_back({.name = entry.text, .colour = entry.colour, .area = entry.count.empty()});
  check_apart(classes);
  for (std::size_t i = 0; i < classes.size(); ++i)  // cracks are seen on every mineral
    for (std::size_t j = 0; j < i; ++j) {
      CAPTURE(classes[i].name);
      CAPTURE(classes[j].name);
      CHECK(render::difference(classes[i].colour, classes[j].colour) >= apart);
    }
  for (const render::Polyline& line : picture.scene.lines) {
    if (!line.cased && !picture.scene.spheres.empty()) continue;
    REQUIRE(render::contrast(line.colour, white) >= 3);
  }
  if (picture.scene.camera.parallel) CHECK(picture.scene.axes);
}

void check_drawing(const std::string& svg, int shown) {
  std::smatch box;
  REQUIRE(std::regex_search(svg, box, std::regex("viewBox=\"[-0-9.]+ [-0-9.]+ ([0-9.]+) ")));
  const double scale = shown / std::stod(box[1]);
  CHECK(svg.find("<tspan") == std::string::npos);  // WeasyPrint and browsers put them in different places
  static const std::regex sizes("font-size=\"([0-9.]+)\"");
  for (std::sregex_iterator at(svg.begin(), svg.end(), sizes), end; at != end; ++at) {
    const double size = scale * std::stod((*at)[1]);
    const std::string element = svg.substr(0, static_cast<std::size_t>(at->position()));
    if (element.find("class=\"index\"", element.rfind('<')) != std::string::npos) continue;  // as small as indices are
    CAPTURE(at->str());
    CHECK(size * points >= 7);
    CHECK(size * points <= 9);
    CHECK(size * screen >= 11);
    CHECK(size * screen <= 16);
  }
}

void check(const reports::Panel& panel) {
  if (const auto* chart = std::get_if<Chart>(&panel.content)) check(*chart);
  if (const auto* picture = std::get_if<reports::Picture>(&panel.content)) check(*picture);
  if (const auto* drawing = std::get_if<std::string>(&panel.content))
    check_drawing(*drawing, render::page_width / std::max(1, panel.per_row));
}

std::vector<fs::path> scenarios() {
  std::vector<fs::path> files;
  for (const auto& file : fs::directory_iterator(source / "scenarios"))
    if (file.path().extension() == ".toml") files.push_back(file.path());
  std::ranges::sort(files);
  return files;
}

}  // namespace

TEST_CASE("figures of every scenario can be read by every reader") {
  dem::StudyOptions options;
  options.output = DEM_SMOKE;
  options.threads = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
  std::set<std::string> checked;
  for (const fs::path& file : scenarios()) {
    CAPTURE(file.filename().string());
    const dem::Study study = dem::read_study(file.string(), "smoke", {}, dem::models());
    const std::vector<dem::CaseOutcome> outcomes = dem::run_study(study, options, {});
    reports::StudyResult result{.scenario = &study.scenario,
                                .cases = {},
                                .quantities = study.model->quantities(),
                                .parameters = study.model->parameters()};
    for (std::size_t i = 0; i < outcomes.size(); ++i)
      result.cases.push_back({outcomes[i].id, study.cases[i].parameters,
                              outcomes[i].record ? &*outcomes[i].record : nullptr, outcomes[i].error});
    result.of_a_paper = reports::of_a_paper(study.scenario, source / "assets" / "papers");
    result.published = reports::published_numbers(result, source / "assets" / "papers");
    for (const reports::Figure* figure : reports::chosen_figures(result, "").figures) {
      reports::FigureContent content = figure->make(result);
      reports::lay_out(content.panels);
      for (const reports::Panel& panel : content.panels) {
        CAPTURE(figure->id);
        CAPTURE(panel.id);
        check(panel);
        checked.insert(std::string(figure->id));
      }
    }
  }
  CHECK(checked.size() > 40);
}
