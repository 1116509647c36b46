#include "reports/page/page.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "engine/core/errors.h"
#include "engine/core/files.h"
#include "reports/page/page_parts.h"
#include "reports/published/papers.h"

namespace reports {
namespace {

using Json = nlohmann::json;

Json asset(const std::filesystem::path& file) {
  if (!std::filesystem::exists(file)) return Json::array();
  try {
    return Json::parse(dem::read_file(file));
  } catch (const Json::exception& error) {
    throw dem::EnvironmentError("the asset " + file.filename().string() + " cannot be read: " + error.what());
  }
}

// A list of objects of texts, as it is.
PageData list_of(const Json& items) {
  PageData list{PageData::type::list};
  for (const Json& item : items) {
    PageData entry;
    for (const auto& [key, value] : item.items()) entry.set(key, value.get<std::string>());
    list.push_back(entry);
  }
  return list;
}

std::string command(const StudyResult& study, const ReportOptions& options) {
  if (!options.command.empty()) return options.command;
  const dem::Scenario& scenario = *study.scenario;
  return "dem-report scenarios/" + scenario.name() + ".toml --scale " + scenario.scale() + " --seed " +
         std::to_string(scenario.seed());
}

/// Words of a comment that no line holds are cut: to break one of 20,000 letters takes WeasyPrint minutes.
std::string with_short_words(std::string_view text) {
  constexpr std::size_t most = 300;
  std::string shown;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find_first_of(" \n\t,"), text.size());
    std::size_t kept = std::min(end, most);
    while (kept < end && kept > 0 && (static_cast<unsigned char>(text[kept]) & 0xc0) == 0x80)
      --kept;  // whole characters
    shown += text.substr(0, kept);
    if (kept < end) shown += fmt::format("... ({} bytes more)", end - kept);
    if (end < text.size()) shown += text[end];
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return shown;
}

}  // namespace

std::string page(const StudyResult& study, const Comparisons& comparisons, const std::vector<DrawnFigure>& figures,
                 const ReportOptions& options, Images images) {
  const dem::Scenario& scenario = *study.scenario;
  kainjow::mustache::mustache pattern(dem::read_file(options.assets / "page" / "report.html"));
  if (!pattern.is_valid()) {
    throw dem::EnvironmentError("the page template report.html is broken: " + pattern.error_message());
  }
  Json choices = Json::array(), citations = Json::array();
  for (const Paper& paper : papers_of(scenario.model(), options.assets / "papers")) {
    for (const Json& one : asset(paper.folder / "choices.json")) choices.push_back(one);
    for (const Json& one : asset(paper.folder / "citations.json")) citations.push_back(one);
  }
  PageData data = title_data(study, options);
  data.set("style", dem::read_file(options.assets / "page" / "report.css"));
  data.set("cases", cases_data(study));
  data.set("findings", findings_data(study, comparisons, figures));
  data.set("results", results_data(study));
  data.set("published", comparisons_data(comparisons));
  data.set("figures", figures_data(figures, images == Images::embedded ? options.folder : std::filesystem::path()));
  data.set("ledger", ledger_data(study));
  data.set("checks", checks_data(study));
  data.set("notes", notes_data(study));
  data.set("choices", list_of(choices));
  data.set("citations", list_of(citations));
  data.set("command", command(study, options));
  if (std::filesystem::exists(scenario.file())) {
    std::string text = dem::read_file(scenario.file());
    if (!scenario.included().empty() && std::filesystem::exists(scenario.included())) {
      const std::string name = std::filesystem::path(scenario.included()).filename().string();
      text += "\n# Included: " + name + "\n" + dem::read_file(scenario.included());
    }
    data.set("scenario_text", with_short_words(text));
  }
  return pattern.render(data);
}

}  // namespace reports
