#include "reports/page/page.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <nlohmann/json.hpp>

#include "engine/core/errors.h"
#include "engine/core/files.h"
#include "engine/model/quantities.h"
#include "reports/page/abbreviations.h"
#include "reports/page/again.h"
#include "reports/page/choices.h"
#include "reports/page/citations.h"
#include "reports/page/downloads.h"
#include "reports/page/page_parts.h"
#include "reports/page/typeset.h"
#include "reports/published/papers.h"
#include "reports/text.h"

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

// What a reader meets.
std::string texts_of(const StudyResult& study, const Comparisons& comparisons, const std::vector<DrawnFigure>& figures,
                     const Json& choices) {
  std::string text;
  const auto add = [&](std::string_view more) { text += std::string(more) + "\n"; };
  for (const CaseResult& one : study.cases) add(case_label(study, one));
  for (const Json& choice : choices) add(choice.value("text", ""));
  for (const Comparison& row : comparisons.rows) add(row.quantity + " " + row.statement);
  for (const DrawnFigure& figure : figures) {
    add(figure.statement + " " + figure.finding);
    for (const DrawnPanel& panel : figure.panels) {
      add(panel.caption + " " + panel.label);
      for (const std::string& head : panel.table.head) add(head);
    }
  }
  return text;
}

Citation read_citation(const Json& declared) {
  try {
    return citation(declared);
  } catch (const Json::exception& error) {
    throw dem::EnvironmentError(std::string("an entry of citation.json or citations.json is broken: ") + error.what());
  }
}

/// What goes into a string of a style sheet.
std::string css_text(std::string_view text) {
  std::string escaped;
  for (const char c : text) {
    const bool plain = std::isalnum(static_cast<unsigned char>(c)) != 0 || static_cast<unsigned char>(c) >= 0x80 ||
                       std::string_view(" ._,-·").find(c) != std::string_view::npos;
    escaped += plain ? std::string(1, c) : fmt::format("\\{:06x}", static_cast<unsigned char>(c));
  }
  return escaped;
}

void set_diagnostics(PageData& data, const StudyResult& study) {
  const PageData checks = checks_data(study), ledger = ledger_data(study), inner = results_data(study, true);
  const std::string summary = checks_summary(study);
  data.set("checks_summary", summary.empty() ? "No case left a check." : summary);
  data.set("checks_state", checks_held(study) ? "good" : "bad");
  data.set("checks_broken", !checks_held(study));
  data.set("has_checks", !checks.is_empty_list());
  data.set("checks", checks);
  data.set("has_ledger", !ledger.is_empty_list());
  data.set("ledger", ledger);
  data.set("has_inner", !inner.is_empty_list());
  data.set("inner", inner);
}

void set_citations(PageData& data, const StudyResult& study, const ReportOptions& options) {
  std::vector<Json> declared{asset(options.assets / "page" / "citation.json")};
  for (const Paper& paper : papers_of(study.scenario->model(), options.assets / "papers")) {
    for (const Json& one : about(study, asset(paper.folder / "citations.json"))) declared.push_back(one);
  }
  PageData list{PageData::type::list};
  std::string entries;
  for (const Json& one : declared) {
    Citation cited = read_citation(one);
    if (cited.type == "software") cited.version = options.engine_version;
    PageData item;
    item.set("text", reference(cited));
    item.set("has_doi", !cited.doi.empty());
    item.set("doi", cited.doi);
    item.set("for", cited.reason);
    list.push_back(item);
    entries += (entries.empty() ? "" : "\n") + bibtex(cited);
  }
  data.set("citations", list);
  data.set("bibtex", entries);
  data.set("bibtex_href", data_uri(entries, "x.bib"));
}

}  // namespace

std::string page(const StudyResult& study, const Comparisons& comparisons, const std::vector<DrawnFigure>& figures,
                 const ReportOptions& options, Images images) {
  const dem::Scenario& scenario = *study.scenario;
  Json choices = Json::array();
  for (const Paper& paper : papers_of(scenario.model(), options.assets / "papers")) {
    for (const Json& one : about(study, asset(paper.folder / "choices.json"))) choices.push_back(one);
  }
  PageData data = title_data(study, options);
  data.set("running",
           css_text(scenario.name() + " · scale " + scenario.scale() + " · dem-report " + options.engine_version));
  data.set("style", dem::read_file(options.assets / "page" / "report.css"));
  data.set("cases", cases_data(study));
  int beside_case = 4;  // columns of the table of cases that all models fill
  for (const dem::Quantity& size : {dem::quantity::grains, dem::quantity::steps}) {
    const bool have = std::ranges::any_of(study.cases, [&](const auto& c) { return c.record && c.record->has(size); });
    data.set("have_" + std::string(size.id), have);
    beside_case += have ? 1 : 0;
  }
  data.set("beside_case", std::to_string(beside_case));
  data.set("findings", findings_data(study, comparisons, figures));
  data.set("results", results_data(study, false));
  PageData abbreviations{PageData::type::list};
  const auto used = abbreviations_in(texts_of(study, comparisons, figures, choices));
  for (std::size_t i = 0; i < used.size(); ++i) {
    PageData one;
    one.set("symbol", std::string(used[i].symbol));
    one.set("meaning", std::string(used[i].meaning));
    one.set("after", i + 1 == used.size() ? "." : "; ");
    abbreviations.push_back(one);
  }
  data.set("abbreviations", abbreviations);
  data.set("has_abbreviations", !used.empty());
  data.set("published", comparisons_data(comparisons));
  const PageData laboratory = laboratory_data(study);
  data.set("has_laboratory", !laboratory.is_empty_list());
  data.set("laboratory", laboratory);
  data.set("figures", figures_data(figures, images == Images::embedded ? options.folder : std::filesystem::path()));
  set_diagnostics(data, study);
  const PageData notes = notes_data(study);
  data.set("has_notes", !notes.is_empty_list());
  data.set("notes", notes);
  data.set("choices", list_of(choices));
  data.set("of_a_paper", study.of_a_paper);
  set_citations(data, study, options);
  data.set("sources", sources_data(scenario, options.again, images != Images::embedded));
  data.set("again", again_data(scenario, options.again));
  if (!options.again_installed.command.empty())
    data.set("again_installed", again_data(scenario, options.again_installed));
  data.set("since", images == Images::embedded ? options.since_reference.shown : options.since_reference.printed);
  return typeset(fill_template(options.assets / "page" / "report.html", std::move(data)));
}

}  // namespace reports
