#include "reports/page/page.h"

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
    data.set("scenario_text", text);
  }
  return pattern.render(data);
}

}  // namespace reports
