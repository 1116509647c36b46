#include "reports/overview/study_row.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "engine/core/errors.h"
#include "engine/core/files.h"
#include "render/png.h"
#include "reports/text.h"

namespace overview {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

std::string amount_text(const Json& amount, const std::string& unit) {
  std::string text;
  if (amount.is_number()) text = reports::number(amount.get<double>(), 4);
  if (amount.is_string()) text = amount.get<std::string>();
  if (amount.is_array() && amount.size() == 2) {
    text = reports::number(amount[0].get<double>(), 4) + " to " + reports::number(amount[1].get<double>(), 4);
  }
  if (text.empty()) return "none";
  return unit.empty() ? text : text + " " + unit;
}

void add_numbers(const Json& results, const Json& quantities, const std::string& id, const std::string& case_id,
                 std::vector<Number>& numbers) {
  for (const auto& [key, value] : results.items()) {
    const std::string whole = id.empty() ? key : id + "." + key;
    if (value.is_object()) add_numbers(value, quantities, whole, case_id, numbers);
    if (!value.is_number()) continue;
    Number number{case_id + "/" + whole, value.get<double>()};
    if (const auto at = quantities.find(whole); at != quantities.end()) {
      number.name = at->value("name", whole);
      number.unit = at->value("unit", "");
      number.key = at->value("kind", "") == "result";
    }
    numbers.push_back(std::move(number));
  }
}

void read_summary(const fs::path& folder, StudyRow& row, std::vector<std::string>& pictures) {
  const Json summary = Json::parse(dem::read_file(folder / "summary.json"));
  row.scenario = summary.at("scenario").get<std::string>();
  row.scale = summary.at("scale").get<std::string>();
  const Json quantities = summary.value("quantities", Json::object());
  for (const Json& one : summary.at("cases")) {
    row.cases.push_back({one.at("id").get<std::string>(), one.value("error", "")});
    add_numbers(one.at("results"), quantities, {}, row.cases.back().id, row.numbers);
  }
  for (const Json& check : summary.at("checks")) {
    row.checks.push_back({check.at("id").get<std::string>(), check.at("held").get<bool>()});
    if (check.at("value").is_number()) row.checks.back().value = check.at("value").get<double>();
    row.checks.back().limit = check.at("limit").get<double>();
  }
  for (const Json& one : summary.at("comparisons")) {
    if (one.value("role", "number") != "number") continue;  // other readings, fitted rows and theory do not count
    PublishedOf published{one.at("id").get<std::string>(), one.value("source", ""), one.value("verdict", "")};
    const std::string unit = one.value("unit", "");
    published.text =
        "published " + amount_text(one.at("published"), unit) + ", computed " + amount_text(one.at("computed"), unit);
    row.published.push_back(std::move(published));
  }
  for (const Json& figure : summary.at("figures")) {
    for (const Json& file : figure.at("files")) {
      if (file.get<std::string>().ends_with(".png")) pictures.push_back(file.get<std::string>());
    }
  }
}

void read_run(const fs::path& folder, StudyRow& row) {
  const Json run = Json::parse(dem::read_file(folder / "run.json"));
  row.error = run.value("error", "");
  row.report_seconds = run.value("report_seconds", 0.0);
  row.seconds += row.report_seconds;
  if (!run.contains("case_seconds")) return;
  for (const auto& [id, seconds] : run.at("case_seconds").items()) {
    row.seconds += seconds.get<double>();
    const auto at = std::ranges::find(row.cases, id, &CaseOf::id);
    if (at != row.cases.end()) at->seconds = seconds.get<double>();
  }
}

void read_comparison(const fs::path& folder, StudyRow& row) {
  const Json json = Json::parse(dem::read_file(folder / "comparison.json"));
  const Json& study = json.at("studies").at(0);
  row.since = study.at("sentence").get<std::string>();
  row.since_state = study.at("state").get<std::string>();
  for (const Json& cause : study.at("causes")) row.causes.push_back(cause.at("cause").get<std::string>());
  for (const Json& item : study.at("changed")) {
    ChangeOf change{item.at("id").get<std::string>(), item.at("state").get<std::string>()};
    change.alarms = change.state == "beyond_tolerance" || change.state == "new" || change.state == "gone";
    change.text = item.value("old", "");
    if (item.contains("new")) change.text += (change.text.empty() ? "" : " -> ") + item.at("new").get<std::string>();
    if (item.contains("difference")) {
      change.text += (change.text.empty() ? "" : "; ") + item.at("difference").get<std::string>();
    }
    row.changes.push_back(std::move(change));
  }
  for (const Json& id : study.at("same")) row.changes.push_back({id.get<std::string>(), "same"});
}

/// The tallest picture that is no chart says most; at most 160 px wide.
std::string thumbnail(const fs::path& folder, const std::vector<std::string>& pictures) {
  for (const bool drawn : {false, true}) {
    for (const std::string& picture : pictures) {
      const fs::path png = folder / picture;
      std::error_code error;
      fs::path svg = png;
      if (fs::exists(svg.replace_extension(".svg"), error) != drawn) continue;
      const render::Image image = render::read_png(png);
      const int factor = std::max(1, (std::max(image.width, image.height) + 199) / 200);
      render::Image whole((image.width / factor) * factor, (image.height / factor) * factor);
      for (int row = 0; row < whole.height; ++row) {
        std::copy_n(&image.rgb[image.at(0, row)], 3 * whole.width, &whole.rgb[whole.at(0, row)]);
      }
      return render::png_bytes(render::shrink(whole, factor), {}, render::Content::photograph);
    }
  }
  return {};
}

int rank(const StudyRow& row) {
  const std::string state = row.state();
  return state == "failed" ? (row.error.empty() ? 1 : 0) : state == "changed" ? 2 : 3;
}

}  // namespace

std::size_t StudyRow::failed_cases() const {
  return static_cast<std::size_t>(std::ranges::count_if(cases, [](const CaseOf& one) { return !one.error.empty(); }));
}
std::size_t StudyRow::checks_held() const {
  return static_cast<std::size_t>(std::ranges::count_if(checks, &CheckOf::held));
}
std::size_t StudyRow::count(const std::string& verdict) const {
  return static_cast<std::size_t>(std::ranges::count(published, verdict, &PublishedOf::verdict));
}
std::size_t StudyRow::judged() const { return count("met") + count("missed") + count("undecided"); }
std::size_t StudyRow::alarms() const {
  return static_cast<std::size_t>(std::ranges::count_if(changes, &ChangeOf::alarms));
}

std::string StudyRow::state() const {
  if (!error.empty() || failed_cases() > 0 || checks_held() < checks.size()) return "failed";
  return since_state == "changed" || since_state == "unreadable" ? "changed" : "well";
}

std::string StudyRow::verdict() const {
  if (!error.empty()) return "could not run: " + error;
  std::string text;
  if (const std::size_t failed = failed_cases(); failed > 0) {
    text += fmt::format("{} of {} cases failed; ", failed, cases.size());
  }
  text += fmt::format("{} of {} checks held", checks_held(), checks.size());
  if (!published.empty()) {
    text += judged() > 0 ? fmt::format("; {} of {} published numbers met", count("met"), published.size())
                         : fmt::format("; none of {} published numbers judged at this scale", published.size());
    std::vector<std::string> words = {"met", "missed", "undecided"};
    for (const PublishedOf& one : published) {
      if (std::ranges::find(words, one.verdict) == words.end()) words.push_back(one.verdict);
    }
    for (std::size_t i = 1; i < words.size(); ++i) {
      if (judged() == 0 && words[i] == "not judged") continue;
      if (const std::size_t of_word = count(words[i]); of_word > 0) text += fmt::format(", {} {}", of_word, words[i]);
    }
  }
  if (!since.empty()) {
    text += since_state == "new"          ? "; new, without a reference"
            : since_state == "unreadable" ? "; " + since
                                          : "; " + since + " since the reference";
  }
  return text;
}

StudyRow read_row(const fs::path& folder, bool with_thumbnail) {
  StudyRow row{.folder = folder.filename().string()};
  row.scenario = row.folder.substr(0, row.folder.rfind('.'));
  row.scale = row.folder.substr(std::min(row.folder.rfind('.'), row.folder.size() - 1) + 1);
  std::vector<std::string> pictures;
  std::error_code error;
  try {
    if (fs::exists(folder / "summary.json", error)) read_summary(folder, row, pictures);
    if (fs::exists(folder / "run.json", error)) read_run(folder, row);
    if (fs::exists(folder / "comparison.json", error)) read_comparison(folder, row);
    if (fs::exists(folder / "report.html", error)) row.report = row.folder + "/report.html";
    if (row.error.empty() && !fs::exists(folder / "summary.json", error)) row.error = "there is no report yet";
    if (with_thumbnail) row.thumbnail = thumbnail(folder, pictures);
  } catch (const Json::exception& failure) {
    row.error = std::string("a file of this study is cut short or damaged: ") + failure.what();
  } catch (const dem::EnvironmentError& failure) {
    row.error = failure.what();
  }
  return row;
}

void sort_rows(std::vector<StudyRow>& rows) {
  std::ranges::stable_sort(rows, {}, [](const StudyRow& row) { return std::pair(rank(row), row.folder); });
}

std::vector<StudyRow> read_rows(const fs::path& output, bool with_thumbnails) {
  std::vector<StudyRow> rows;
  std::error_code error;
  for (fs::directory_iterator at(output, error), end; !error && at != end; at.increment(error)) {
    std::error_code ignored;
    const bool study = fs::exists(at->path() / "summary.json", ignored) || fs::exists(at->path() / "run.json", ignored);
    if (study && !at->path().filename().string().starts_with("."))
      rows.push_back(read_row(at->path(), with_thumbnails));
  }
  sort_rows(rows);
  return rows;
}

}  // namespace overview
