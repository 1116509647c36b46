#include "reports/output/drawing.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <stdexcept>

#include "engine/core/errors.h"
#include "engine/core/files.h"
#include "engine/model/model.h"
#include "reports/figures/parts.h"
#include "reports/output/csv.h"
#include "reports/output/workers.h"
#include "reports/provenance.h"
#include "reports/text.h"

namespace reports {
namespace {

constexpr std::size_t points_in_a_picture = 10000;
constexpr int pictures_per_row = 3;  // where a figure does not say

/// `key` is what names it: the key "figures" or the option --only.
const Figure& named_figure(const StudyResult& study, std::string_view id, const std::string& key) {
  std::vector<std::string> known;
  for (const Figure& figure : figures()) {
    if (figure.model != study.scenario->model()) continue;
    if (figure.id == id) return figure;
    known.emplace_back(figure.id);
  }
  throw study.scenario->error(key, "there is no figure '" + std::string(id) + "' of this model",
                              "known are " + listed(known));
}

/// A panel on its way to its files.
struct Job {
  const Panel* panel = nullptr;
  std::string name;  // of the files
  render::Provenance facts;
};

/// What only drawing tells, as bytes that a process can hand over.
struct Drawn {
  render::SceneResult scene;
  std::array<char, 128> renderer;
};

constexpr std::string_view pictures = "figures/", tables = "data/";

// A picture with as many pixels as it needs in print, and lines and words as wide as in charts. Pictures beside each other
// share the page.
render::Scene sized(render::Scene scene, int per_row, bool whole_width, double dpi) {
  scene.shown = static_cast<double>(render::page_width) / (whole_width ? 1 : std::max(2, per_row));
  const double mm = scene.shown * render::column_mm / render::column_width;
  // A high picture is printed less wide: its words are as large as all others there.
  scene.shown *= std::min(1.0, highest_picture(per_row) * scene.width / scene.height / mm);
  const double factor = mm / 25.4 * dpi / scene.width;
  scene.width = std::max(1, static_cast<int>(std::lround(factor * scene.width)));
  scene.height = std::max(1, static_cast<int>(std::lround(factor * scene.height)));
  return scene;
}

// Scenes without spheres are also drawn as vectors, unless they would take megabytes.
bool as_vectors(const render::Scene& scene) {
  constexpr std::size_t most = 8000;
  std::size_t shapes = scene.lines.size();
  for (const render::Discs& discs : scene.discs) shapes += discs.centre.size();
  return scene.spheres.empty() && scene.camera.parallel && shapes <= most;
}

// The files of a panel, the one to show first.
std::vector<std::string> files_of(const Panel& panel, const std::string& name) {
  const std::string picture = std::string(pictures) + name, table = std::string(tables) + name + ".csv";
  if (const auto* chart = std::get_if<render::Chart>(&panel.content)) {
    std::vector<std::string> files{picture + ".svg", picture + ".png"};
    for (const CsvTable& one : csv_tables(*chart))
      files.push_back(std::string(tables) + name + (one.suffix.empty() ? "" : "_" + one.suffix) + ".csv");
    return files;
  }
  if (const auto* drawn = std::get_if<Picture>(&panel.content)) {
    if (as_vectors(drawn->scene)) return {picture + ".png", picture + ".svg"};
    return {picture + ".png"};
  }
  if (std::holds_alternative<TextTable>(panel.content)) return {table};
  return {picture + ".svg"};
}

// All of a drawn panel but what only drawing tells.
DrawnPanel described(const Panel& panel, const std::string& name) {
  DrawnPanel drawn{.caption = panel.caption, .alt = panel.alt};
  drawn.files = files_of(panel, name);
  if (const auto* chart = std::get_if<render::Chart>(&panel.content)) {
    const Sampled picture = sampled(*chart, points_in_a_picture);
    if (picture.drawn < picture.all) {
      const auto csv =
          std::ranges::find_if(drawn.files, [](const std::string& file) { return file.ends_with(".csv"); });
      drawn.note = fmt::format("Drawn from {} of {} points; {} has all.", count(static_cast<double>(picture.drawn)),
                               count(static_cast<double>(picture.all)), csv == drawn.files.end() ? "the CSV" : *csv);
    }
    drawn.width = chart->width;
    drawn.height = chart->height;
  }
  if (const auto* picture = std::get_if<Picture>(&panel.content)) {
    drawn.label = picture->label;
    drawn.legend = picture->legend;
    drawn.per_row = pictures_per_row;
  }
  if (const auto* table = std::get_if<TextTable>(&panel.content))
    drawn.table = *table;
  else
    drawn.image = drawn.files.front();
  if (panel.per_row > 0) drawn.per_row = panel.per_row;
  drawn.whole_width = panel.whole_width;
  return drawn;
}

// Writes the files of a panel.
render::SceneResult draw(const Job& job, const std::filesystem::path& folder, double dpi, const CanvasSource& canvas) {
  std::vector<std::filesystem::path> files;
  for (const std::string& file : files_of(*job.panel, job.name)) files.push_back(dem::inside(folder, file));
  render::SceneResult result;
  if (const auto* chart = std::get_if<render::Chart>(&job.panel->content)) {
    canvas().draw(sampled(*chart, points_in_a_picture).chart, files[1], files[0], job.facts, dpi);
    const std::vector<CsvTable> data = csv_tables(*chart);
    for (std::size_t i = 0; i < data.size(); ++i) dem::write_file(files[i + 2], data[i].text());
  } else if (const auto* picture = std::get_if<Picture>(&job.panel->content)) {
    const int per_row = job.panel->per_row > 0 ? job.panel->per_row : pictures_per_row;
    result = canvas().draw(sized(picture->scene, per_row, job.panel->whole_width, dpi), files[0], job.facts, dpi,
                           files.size() > 1 ? files[1] : std::filesystem::path());
  } else if (const auto* table = std::get_if<TextTable>(&job.panel->content)) {
    dem::write_file(files[0], csv(*table));
  } else {
    dem::write_file(files[0], std::get<std::string>(job.panel->content));
  }
  return result;
}

Drawn drawn_by(const Job& job, const std::filesystem::path& folder, double dpi, const CanvasSource& canvas) {
  Drawn drawn{draw(job, folder, dpi, canvas), {}};
  const std::string name = canvas().gl_renderer();
  std::copy_n(name.begin(), std::min(name.size(), drawn.renderer.size() - 1), drawn.renderer.begin());
  return drawn;
}

// A process that a driver crashed says nothing more: what is set here may tell why.
template <class Work>
auto in_drawing_processes(std::size_t count, int workers, const Work& work, const std::function<bool()>& stopped,
                          const std::function<void(std::size_t)>& taken = {}) {
  try {
    return in_processes<decltype(work(std::size_t{0}))>(count, workers, work, stopped, taken);
  } catch (const ProcessEnded& ended) {
    throw dem::EnvironmentError(ended.what() + render::Canvas::settings());
  }
}

// Drawn in processes of their own, be it one: so that a signal, or a GL driver that crashes, can be answered at once.
// A GL context that was made before a fork is of no use after it: then all is drawn here.
std::vector<Drawn> draw_all(const std::vector<Job>& jobs, const ReportOptions& options, const CanvasSource& canvas) {
  constexpr std::size_t most = 8;  // each holds a GL driver with its own threads
  if (render::Canvas::any_made()) {
    std::vector<Drawn> all;
    for (const Job& job : jobs) {
      if (options.stopped()) throw dem::Interrupted{};
      all.push_back(drawn_by(job, options.folder, options.dpi, canvas));
    }
    return all;
  }
  const int workers = std::min(options.workers, static_cast<int>(std::min(jobs.size(), most)));
  std::optional<render::Canvas> own;  // of each process: still empty at the fork
  const auto one = [&](std::size_t i) {
    return drawn_by(jobs[i], options.folder, options.dpi, [&]() -> render::Canvas& {
      if (!own) own.emplace();
      return *own;
    });
  };
  return in_drawing_processes(jobs.size(), workers, one, options.stopped, [&](std::size_t taken) {
    if (options.drawing) options.drawing(taken, jobs.size());
  });
}

/// What processes that were ended left in the folders.
void clear(const std::filesystem::path& folder) {
  for (const auto& place : {folder, folder / "figures", folder / "data"}) dem::remove_leftovers(place);
}

/// What a figure says, before it is drawn.
FigureContent content_of(const StudyResult& study, const Figure& figure, DrawnFigure& drawn) {
  try {
    FigureContent content = figure.make(study);
    lay_out(content.panels);
    if (study.of_a_paper) {
      drawn.mirrors = figure.source;
      drawn.statement = content.statement;
      drawn.rows = content.rows;
      drawn.agreement = content.agreement;
      drawn.expected = content.expected;
    }
    drawn.finding = content.finding;
    drawn.headline = content.headline;
    return content;
  } catch (const std::out_of_range& missing) {
    drawn.problem = std::string("This figure could not be drawn: ") + missing.what() + ".";
    return {};
  }
}

Job job_of(const Figure& figure, const Panel& panel, const render::Provenance& study_facts) {
  Job job{&panel, std::string(figure.id) + (panel.id.empty() ? "" : "_" + panel.id), study_facts};
  job.facts.emplace_back("Figure", figure.id);
  job.facts.emplace_back("Source", figure.source);
  job.facts.emplace_back("Title", panel.caption.empty() ? std::string(figure.title) : panel.caption);
  job.facts.emplace_back("Description", panel.alt);
  return job;
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
                                    static_cast<std::size_t>(std::max_element(first, last) - series.y.begin()),
                                    end - 1};
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

ChosenFigures chosen_figures(const StudyResult& study, const std::string& only) {
  if (!only.empty()) return {{&named_figure(study, only, "--only")}};
  std::vector<const Figure*> chosen;
  for (const std::string& id : study.scenario->texts("figures")) chosen.push_back(&named_figure(study, id, "figures"));
  if (!chosen.empty()) return {chosen};
  for (const Figure& figure : figures()) {
    if (figure.model == study.scenario->model()) chosen.push_back(&figure);
  }
  return {chosen, true};
}

void check_drawing(const std::function<bool()>& stopped) {
  const auto one = [](std::size_t) {
    render::Canvas::check_fonts();
    const render::Canvas canvas;
    return 0;
  };
  if (!render::Canvas::any_made()) in_drawing_processes(1, 1, one, stopped);
}

Drawings draw_figures(const StudyResult& study, const ChosenFigures& chosen, const ReportOptions& options,
                      const CanvasSource& canvas) {
  const render::Provenance facts{{"Scenario", study.scenario->name()},
                                 {"Scale", study.scenario->scale()},
                                 {"Scenario hash", provenance_of(study, options.engine_version).scenario_sha256},
                                 {"Engine", options.engine_version}};
  dem::make_folder(options.folder / "figures");
  dem::make_folder(options.folder / "data");
  clear(options.folder);
  Drawings made;
  std::vector<FigureContent> contents;  // jobs point into their panels
  for (const Figure* figure : chosen.figures) {
    if (options.stopped()) throw dem::Interrupted{};
    DrawnFigure drawn{.figure = figure};
    FigureContent content = content_of(study, *figure, drawn);
    if (chosen.whole_model && std::ranges::all_of(content.panels, is_note)) continue;
    const bool nothing = content.panels.empty() && content.finding.empty() && drawn.problem.empty();
    if (nothing && options.only.empty()) continue;
    drawn.number = static_cast<int>(made.figures.size()) + 1;
    made.figures.push_back(std::move(drawn));
    contents.push_back(std::move(content));
  }
  std::vector<Job> jobs;
  for (std::size_t f = 0; f < contents.size(); ++f) {
    for (const Panel& panel : contents[f].panels) jobs.push_back(job_of(*made.figures[f].figure, panel, facts));
  }
  std::vector<Drawn> results;
  try {
    results = draw_all(jobs, options, canvas);
  } catch (...) {
    clear(options.folder);
    throw;
  }
  auto job = jobs.begin();
  auto result = results.begin();
  for (std::size_t f = 0; f < contents.size(); ++f) {
    DrawnFigure& drawn = made.figures[f];
    for (const Panel& panel : contents[f].panels) {
      DrawnPanel shown = described(panel, (job++)->name);
      const render::SceneResult& scene = (result++)->scene;
      if (const auto* picture = std::get_if<Picture>(&panel.content)) {
        shown.width = scene.width;
        shown.height = scene.height;
        if (picture->scale_bar) shown.bar = scale_bar(scene);
      }
      if (contents[f].panels.size() > 1)
        shown.letter = std::string(1, static_cast<char>('a' + drawn.panels.size() % 26));
      drawn.files.insert(drawn.files.end(), shown.files.begin(), shown.files.end());
      drawn.panels.push_back(std::move(shown));
    }
  }
  if (!results.empty()) made.gl_renderer = results.front().renderer.data();
  return made;
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
  const auto [scale, unit] = length >= 1      ? std::pair{1.0, "m"}
                             : length >= 1e-3 ? std::pair{1e3, "mm"}
                                              : std::pair{1e6, "µm"};
  return {fmt::format("{:g} {}", length * scale, unit), 100 * length / width};
}

}  // namespace reports
