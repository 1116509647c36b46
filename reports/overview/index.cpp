#include "reports/overview/index.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "engine/core/base64.h"
#include "engine/core/files.h"
#include "reports/template.h"
#include "reports/text.h"

namespace overview {
namespace {

using Data = reports::PageData;
using Json = nlohmann::ordered_json;

constexpr std::size_t most_lines = 6;  // of sparklines a study, those that stepped first

std::string time_text(double seconds) {
  if (seconds <= 0) return "–";
  if (seconds < 60) return reports::number(seconds, 2) + " s";
  const auto whole = static_cast<long>(seconds + 0.5);
  return whole < 3600 ? fmt::format("{} min {:02} s", whole / 60, whole % 60)
                      : fmt::format("{} h {:02} min", whole / 3600, whole % 3600 / 60);
}

void set(Data& data, const std::string& name, const std::string& text) {
  data.set(name, text);
  data.set("has_" + name, Data{text.empty() ? Data::type::bool_false : Data::type::bool_true});
}

struct Line {
  Series series;
  std::vector<Step> steps;
  std::string name;
};

/// The time, the key results of the first case, and whatever stepped.
std::vector<Line> lines_of(const History& history, const StudyRow& row) {
  std::vector<Line> stepped, calm;
  for (Series& series : series_of(history, row.folder)) {
    if (series.values.size() < 2) continue;
    const std::string id = series.id.starts_with("results/") ? series.id.substr(8) : "";
    const auto number = std::ranges::find(row.numbers, id, &Number::id);
    const bool known = number != row.numbers.end();
    std::string name = series.id;
    if (series.id == "seconds") name = "time, s";
    if (known && !number->name.empty()) {
      name = number->name + (number->unit.empty() ? "" : ", " + number->unit) + " (" + id.substr(0, id.find('/')) + ")";
    }
    Line line{series, steps(series.values), name};
    const bool first_case = known && !row.cases.empty() && id.starts_with(row.cases[0].id + "/");
    if (!line.steps.empty()) {
      stepped.push_back(std::move(line));
    } else if (series.id == "seconds" || (first_case && number->key)) {
      calm.push_back(std::move(line));
    }
  }
  // The time first among the calm ones.
  std::ranges::stable_partition(calm, [](const Line& line) { return line.series.id == "seconds"; });
  for (Line& line : calm) {
    if (stepped.size() < most_lines) stepped.push_back(std::move(line));
  }
  return stepped;
}

std::string sparkline(const Line& line) {
  const std::vector<double>& values = line.series.values;
  const auto [low, high] = std::ranges::minmax(values);
  const double scale = high > low ? high - low : 1;
  const double width = 160.0 / static_cast<double>(std::max<std::size_t>(values.size() - 1, 1));
  const auto y = [&](double value) { return 27 - 24 * (value - low) / scale; };
  std::string points, marks;
  for (std::size_t i = 0; i < values.size(); ++i) {
    points += fmt::format("{}{:.1f},{:.1f}", i > 0 ? " " : "", 4 + width * static_cast<double>(i), y(values[i]));
  }
  for (const Step& step : line.steps) {
    marks += fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"3\"/>", 4 + width * static_cast<double>(step.at),
                         y(values[step.at]));
  }
  return fmt::format(
      "<svg class=\"spark\" viewBox=\"0 0 168 30\" role=\"img\" aria-label=\"{} values from {} to {}\"><polyline "
      "points=\"{}\"/>{}</svg>",
      values.size(), reports::number(low, 3), reports::number(high, 3), points, marks);
}

std::string step_text(const Line& line, const Step& step) {
  std::string before, after;
  for (const int digits : {4, 7, 17}) {  // enough to tell them apart
    before = reports::number(step.before, digits), after = reports::number(step.after, digits);
    if (before != after) break;
  }
  return fmt::format("{} → {} at {}", before, after, line.series.labels[step.at]);
}

Data row_data(const StudyRow& row, const History* history) {
  Data data;
  data.set("folder", row.folder);
  data.set("scenario", row.scenario);
  data.set("scale", row.scale);
  data.set("state", row.state());
  std::string classes = row.state();
  if (row.count("missed") > 0) classes += " missed";
  if (row.count("undecided") > 0) classes += " undecided";
  if (row.since_state == "new") classes += " new";
  data.set("classes", classes);
  set(data, "error", row.error);
  set(data, "report", row.report);
  const std::size_t failed = row.failed_cases();
  data.set("cases",
           failed > 0 ? fmt::format("{} of {} failed", failed, row.cases.size()) : std::to_string(row.cases.size()));
  data.set("cases_class", failed > 0 ? "bad" : "");
  const bool broken = row.checks_held() < row.checks.size();
  data.set("checks", fmt::format("{} of {}", row.checks_held(), row.checks.size()));
  data.set("checks_class", broken ? "bad" : "");
  std::string published = row.published.empty() ? "–"
                          : row.judged() > 0    ? fmt::format("{} of {} met", row.count("met"), row.published.size())
                                                : fmt::format("none of {} judged", row.published.size());
  for (const char* word : {"missed", "undecided"}) {
    if (const std::size_t count = row.count(word); count > 0) published += fmt::format(", {} {}", count, word);
  }
  data.set("published", published);
  std::string since = row.since;
  if (since.empty()) since = "not compared";
  if (row.since_state == "new") since = "new";
  data.set("since", since);
  data.set("since_class", row.since_state == "changed" || row.since_state == "unreadable" ? "bad" : "");
  set(data, "comparison", row.since_state.empty() || row.since_state == "new" ? "" : row.folder + "/comparison.html");
  data.set("time", time_text(row.seconds));
  set(data, "thumbnail", row.thumbnail.empty() ? "" : "data:image/png;base64," + dem::base64(row.thumbnail));
  Data lines{Data::type::list};
  bool any = false;
  if (history) {
    for (const Line& line : lines_of(*history, row)) {
      Data one;
      one.set("svg", sparkline(line));
      one.set("name", line.name);
      std::string text;
      for (const Step& step : line.steps) text += (text.empty() ? "" : "; ") + step_text(line, step);
      set(one, "steps", text);
      lines.push_back(one);
      any = true;
    }
  }
  data.set("lines", lines);
  data.set("has_lines", Data{any ? Data::type::bool_true : Data::type::bool_false});
  return data;
}

std::size_t in_state(const std::vector<StudyRow>& rows, const std::string& state) {
  return static_cast<std::size_t>(
      std::ranges::count_if(rows, [&](const StudyRow& row) { return row.state() == state; }));
}

std::string verdict(const std::vector<StudyRow>& rows) {
  const std::size_t failed = in_state(rows, "failed"), changed = in_state(rows, "changed");
  std::string text = fmt::format("{} {}", rows.size(), rows.size() == 1 ? "study" : "studies");
  if (failed > 0) text += fmt::format(", {} failed", failed);
  if (changed > 0) text += fmt::format(", {} changed", changed);
  return failed + changed > 0 ? text : text + ": all well";
}

}  // namespace

std::string index_page(const std::vector<StudyRow>& rows, const History* history, const std::filesystem::path& assets) {
  Data data, list{Data::type::list};
  for (const StudyRow& row : rows) list.push_back(row_data(row, history));
  data.set("style", dem::read_file(assets / "page" / "night.css"));
  data.set("verdict", verdict(rows));
  data.set("verdict_class", in_state(rows, "failed") + in_state(rows, "changed") > 0 ? "bad" : "good");
  data.set("rows", list);
  const auto count = [&](const std::string& name, auto&& belongs) {
    data.set("count_" + name, std::to_string(std::ranges::count_if(rows, belongs)));
  };
  count("all", [](const StudyRow&) { return true; });
  count("failed", [](const StudyRow& row) { return row.state() == "failed"; });
  count("changed", [](const StudyRow& row) { return row.state() == "changed"; });
  count("missed", [](const StudyRow& row) { return row.count("missed") > 0; });
  count("undecided", [](const StudyRow& row) { return row.count("undecided") > 0; });
  count("well", [](const StudyRow& row) { return row.state() == "well"; });
  data.set("has_history", Data{history ? Data::type::bool_true : Data::type::bool_false});
  data.set("penalty", penalty_text);
  data.set("damaged", history && history->damaged > 0
                          ? fmt::format("{} lines of the history are damaged and left out.", history->damaged)
                          : std::string());
  return reports::fill_template(assets / "page" / "index.html", std::move(data));
}

std::string index_json(const std::vector<StudyRow>& rows, const History* history) {
  Json json{{"format", 1}, {"well", in_state(rows, "well") == rows.size()}, {"studies", Json::array()}};
  for (const StudyRow& row : rows) {
    Json one{{"study", row.folder},
             {"scenario", row.scenario},
             {"scale", row.scale},
             {"state", row.state()},
             {"verdict", row.verdict()},
             {"cases", row.cases.size()},
             {"cases_failed", row.failed_cases()},
             {"checks", row.checks.size()},
             {"checks_held", row.checks_held()},
             {"published", Json::object()},
             {"seconds", row.seconds}};
    for (const PublishedOf& published : row.published) {
      Json& count = one["published"][published.verdict];
      count = count.is_null() ? 1 : count.get<int>() + 1;
    }
    if (!row.error.empty()) one["error"] = row.error;
    if (!row.report.empty()) one["report"] = row.report;
    if (!row.since_state.empty()) one["since_reference"] = {{"state", row.since_state}, {"sentence", row.since}};
    if (history) {
      one["steps"] = Json::array();
      for (const Series& series : series_of(*history, row.folder)) {
        for (const Step& step : steps(series.values)) {
          one["steps"].push_back({{"number", series.id},
                                  {"label", series.labels[step.at]},
                                  {"before", step.before},
                                  {"after", step.after}});
        }
      }
    }
    json["studies"].push_back(std::move(one));
  }
  return json.dump(1) + "\n";
}

void write_index(const std::filesystem::path& output, const std::vector<StudyRow>& rows, const History* history,
                 const std::filesystem::path& assets) {
  dem::remove_leftovers(output);
  dem::write_file(output / "index.json", index_json(rows, history));
  dem::write_file(output / "index.html", index_page(rows, history, assets));
}

}  // namespace overview
