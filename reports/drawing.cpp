#include "reports/drawing.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

#include "engine/core/errors.h"
#include "engine/core/files.h"
#include "engine/core/hash.h"
#include "reports/csv.h"
#include "reports/text.h"

namespace reports {
namespace {

constexpr std::size_t points_in_a_picture = 10000;

bool belongs(const Figure& figure, std::string_view scenario) {
  return std::ranges::find(figure.scenarios, scenario) != figure.scenarios.end();
}

const Figure& named_figure(const StudyResult& study, std::string_view id) {
  std::vector<std::string> known;
  for (const Figure& figure : figures()) {
    if (figure.model != study.scenario->model()) continue;
    if (figure.id == id) return figure;
    known.emplace_back(figure.id);
  }
  throw dem::InputError("there is no figure '" + std::string(id) + "' of this model", "known are " + listed(known));
}

/// Draws the panels of one figure.
class Drawer {
 public:
  Drawer(const Figure& figure, const ReportOptions& options, render::Canvas& canvas, render::Provenance facts)
      : figure_(figure), options_(options), canvas_(canvas), facts_(std::move(facts)) {}

  DrawnPanel draw(const Panel& panel) {
    DrawnPanel drawn{.caption = panel.caption, .alt = panel.alt};
    name_ = std::string(figure_.id) + (panel.id.empty() ? "" : "_" + panel.id);
    panel_facts_ = facts_;
    panel_facts_.emplace_back("Title", panel.caption.empty() ? std::string(figure_.title) : panel.caption);
    panel_facts_.emplace_back("Description", panel.alt);
    std::visit([&](const auto& content) { put(content, drawn); }, panel.content);
    if (panel.per_row > 0) drawn.per_row = panel.per_row;
    return drawn;
  }

 private:
  std::string file(const std::string& folder, const std::string& extension, DrawnPanel& drawn) const {
    drawn.files.push_back(folder + "/" + name_ + extension);
    return drawn.files.back();
  }

  void put(const render::Chart& chart, DrawnPanel& drawn) {
    const Sampled picture = sampled(chart, points_in_a_picture);
    if (picture.drawn < picture.all) {
      drawn.note = fmt::format("Drawn from {} of {} points; the CSV has all.", count(static_cast<double>(picture.drawn)),
                               count(static_cast<double>(picture.all)));
    }
    const std::string png = file("figures", ".png", drawn);
    drawn.image = file("figures", ".svg", drawn);
    canvas_.draw(picture.chart, options_.folder / png, options_.folder / drawn.image, panel_facts_);
    dem::write_file(options_.folder / file("data", ".csv", drawn), csv(chart));
    drawn.width = chart.width;
    drawn.height = chart.height;
    drawn.per_row = chart.width > 560 ? 1 : 2;
  }

  void put(const Picture& picture, DrawnPanel& drawn) {
    drawn.image = file("figures", ".png", drawn);
    const render::SceneResult result = canvas_.draw(picture.scene, options_.folder / drawn.image, panel_facts_);
    if (picture.scale_bar) drawn.bar = scale_bar(result);
    drawn.label = picture.label;
    drawn.legend = picture.legend;
    drawn.width = result.width;
    drawn.height = result.height;
    drawn.per_row = 3;
  }

  void put(const TextTable& table, DrawnPanel& drawn) {
    dem::write_file(options_.folder / file("data", ".csv", drawn), csv(table));
    drawn.table = table;
  }

  void put(const std::string& svg, DrawnPanel& drawn) {
    drawn.image = file("figures", ".svg", drawn);
    dem::write_file(options_.folder / drawn.image, svg);
  }

  const Figure& figure_;
  const ReportOptions& options_;
  render::Canvas& canvas_;
  render::Provenance facts_;
  render::Provenance panel_facts_;
  std::string name_;
};

DrawnFigure draw_figure(const StudyResult& study, const Figure& figure, const ReportOptions& options,
                        render::Canvas& canvas, const render::Provenance& study_facts) {
  DrawnFigure drawn{.figure = &figure};
  FigureContent content;
  try {
    content = figure.make(study);
  } catch (const std::out_of_range& missing) {
    drawn.problem = std::string("This figure could not be drawn: ") + missing.what() + ".";
    return drawn;
  }
  drawn.statement = content.statement;
  drawn.finding = content.finding;
  render::Provenance facts = study_facts;
  facts.emplace_back("Figure", figure.id);
  facts.emplace_back("Source", figure.source);
  Drawer drawer(figure, options, canvas, facts);
  for (const Panel& panel : content.panels) {
    drawn.panels.push_back(drawer.draw(panel));
    DrawnPanel& last = drawn.panels.back();
    if (content.panels.size() > 1) last.letter = std::string(1, static_cast<char>('a' + (drawn.panels.size() - 1) % 26));
    drawn.files.insert(drawn.files.end(), last.files.begin(), last.files.end());
  }
  return drawn;
}

// First, lowest, highest and last point of each of `stretches` equal stretches, in their order.
render::Series thinned(const render::Series& series, std::size_t stretches) {
  render::Series thin = series;
  thin.x.clear();
  thin.y.clear();
  thin.y_error.clear();
  const std::size_t points = std::min(series.x.size(), series.y.size());
  for (std::size_t s = 0; s < stretches; ++s) {
    const std::size_t begin = s * points / stretches;
    const std::size_t end = (s + 1) * points / stretches;
    if (begin >= end) continue;
    const auto first = series.y.begin() + static_cast<std::ptrdiff_t>(begin);
    const auto last = series.y.begin() + static_cast<std::ptrdiff_t>(end);
    std::array<std::size_t, 4> kept{begin, static_cast<std::size_t>(std::min_element(first, last) - series.y.begin()),
                                    static_cast<std::size_t>(std::max_element(first, last) - series.y.begin()), end - 1};
    std::ranges::sort(kept);
    const auto unique_end = std::ranges::unique(kept).begin();
    for (auto i = kept.begin(); i != unique_end; ++i) {
      thin.x.push_back(series.x[*i]);
      thin.y.push_back(series.y[*i]);
      if (*i < series.y_error.size()) thin.y_error.push_back(series.y_error[*i]);
    }
  }
  return thin;
}

render::Band thinned(const render::Band& band, std::size_t points) {
  render::Band thin = band;
  thin.x.clear();
  thin.low.clear();
  thin.high.clear();
  const std::size_t all = band.x.size();
  for (std::size_t k = 0; k < points; ++k) {
    const std::size_t i = k * (all - 1) / (points - 1);
    thin.x.push_back(band.x[i]);
    thin.low.push_back(band.low[i]);
    thin.high.push_back(band.high[i]);
  }
  return thin;
}

}  // namespace

std::vector<const Figure*> chosen_figures(const StudyResult& study, const std::string& only) {
  std::vector<const Figure*> chosen;
  if (!only.empty()) return {&named_figure(study, only)};
  for (const std::string& id : study.scenario->texts("figures")) chosen.push_back(&named_figure(study, id));
  if (!chosen.empty()) return chosen;
  for (const Figure& figure : figures()) {
    if (figure.model == study.scenario->model() && belongs(figure, study.scenario->name())) chosen.push_back(&figure);
  }
  if (!chosen.empty()) return chosen;
  // A scenario of the user's own: every figure of its model.
  for (const Figure& figure : figures()) {
    if (figure.model == study.scenario->model()) chosen.push_back(&figure);
  }
  return chosen;
}

std::vector<DrawnFigure> draw_figures(const StudyResult& study, const std::vector<const Figure*>& chosen,
                                      const ReportOptions& options, render::Canvas& canvas) {
  const std::vector<std::string> everything{""};
  const render::Provenance facts{{"Scenario", study.scenario->name()},
                                 {"Scale", study.scenario->scale()},
                                 {"Scenario hash", dem::sha256(study.scenario->canonical(everything))},
                                 {"Engine", options.engine_version}};
  dem::make_folder(options.folder / "figures");
  dem::make_folder(options.folder / "data");
  std::vector<DrawnFigure> drawn;
  for (const Figure* figure : chosen) {
    drawn.push_back(draw_figure(study, *figure, options, canvas, facts));
    drawn.back().number = static_cast<int>(drawn.size());
  }
  return drawn;
}

Sampled sampled(render::Chart chart, std::size_t points) {
  Sampled result;
  for (const auto& series : chart.series) result.all += series.x.size();
  for (const auto& band : chart.bands) result.all += band.x.size();
  result.drawn = result.all;
  if (result.all > points) {
    const double keep = static_cast<double>(points) / static_cast<double>(result.all);
    result.drawn = 0;
    for (auto& series : chart.series) {
      const auto stretches = static_cast<std::size_t>(keep * static_cast<double>(series.x.size()) / 4);
      if (stretches >= 1 && series.x.size() > 4) series = thinned(series, stretches);
      result.drawn += series.x.size();
    }
    for (auto& band : chart.bands) {
      const auto kept = static_cast<std::size_t>(keep * static_cast<double>(band.x.size()));
      if (kept >= 2) band = thinned(band, kept);
      result.drawn += band.x.size();
    }
  }
  result.chart = std::move(chart);
  return result;
}

ScaleBar scale_bar(const render::SceneResult& drawn) {
  const double width = drawn.metres_per_pixel * drawn.width;
  if (!(width > 0)) return {};
  const double target = 0.4 * width;
  double length = std::pow(10.0, std::floor(std::log10(target)));
  for (const double factor : {5.0, 2.0}) {
    if (factor * length <= target) {
      length *= factor;
      break;
    }
  }
  const auto [scale, unit] = length >= 1 ? std::pair{1.0, "m"} : length >= 1e-3 ? std::pair{1e3, "mm"} : std::pair{1e6, "µm"};
  return {fmt::format("{:g} {}", length * scale, unit), 100 * length / width};
}

}  // namespace reports
