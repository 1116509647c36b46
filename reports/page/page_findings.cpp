// What came out, in short.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "engine/analysis/peaks.h"
#include "engine/model/quantities.h"
#include "reports/page/page_cases.h"
#include "reports/page/page_parts.h"
#include "reports/page/page_tables.h"
#include "reports/published/laboratory.h"
#include "reports/text.h"

namespace reports {
namespace {

// "Missed most: UCS, AR 1 (−20.0 %) and ...": what is missed, the largest relative deviations first.
std::string missed_text(const Comparisons& comparisons) {
  constexpr std::size_t named = 4;
  std::vector<const Comparison*> missed;
  for (const Comparison& row : comparisons.rows) {
    if (row.role == Role::number && row.verdict == Verdict::missed) missed.push_back(&row);
  }
  if (missed.empty()) return {};
  // In tolerances: comparable among units.
  std::ranges::stable_sort(missed, std::greater{}, [](const Comparison* row) {
    return row->deviation && row->tolerance && *row->tolerance > 0 ? std::abs(*row->deviation) / *row->tolerance : 0.0;
  });
  std::vector<std::string> parts;
  for (const Comparison* row : missed) {
    if (parts.size() == named) break;
    parts.push_back(row->quantity + (row->deviation ? " (" + deviation_text(*row) + ")" : ""));
  }
  const bool all = parts.size() == missed.size();
  return (all ? "Missed: " : "Missed by most: ") + joined(parts, "; ") + ".";
}

// In the middle of a sentence; names of people keep their capital.
std::string lower(std::string text) {
  const bool of_a_person = std::string_view(text).substr(0, text.find(' ')).ends_with("’s");
  if (!of_a_person && text.size() > 1 && text[0] >= 'A' && text[0] <= 'Z' && text[1] >= 'a' && text[1] <= 'z')
    text[0] = static_cast<char>(text[0] - 'A' + 'a');
  return text;
}

// What tests measure, the most telling first; and what tells of a specimen, where nothing was measured on it.
constexpr std::array<std::string_view, 20> telling{"brazilian_strength",
                                                   "shear_strength",
                                                   "modulus_of_rupture",
                                                   "fracture_toughness",
                                                   "compressive_strength",
                                                   "tensile_strength",
                                                   "spacing_over_thickness",
                                                   "peak_differential_stress",
                                                   "residual_shear_strength",
                                                   "compressive_strength_error",
                                                   "tensile_strength_error",
                                                   "young_modulus",
                                                   "poisson_ratio",
                                                   "unloading_modulus",
                                                   "onset_strain",
                                                   "inter_grain_crack_share",
                                                   "mouth_opening",
                                                   "first_cracks.middle",
                                                   "first_cracks.band",
                                                   "peak_strain"};
constexpr std::array<std::string_view, 3> of_specimens{"inter_grain_share", "realised_aspect_ratio", "coordination"};

/// A result of a column, as it is said: "196 MPa"; "" where it has none.
std::string said_of(const StudyResult& study, const Repeats& repeats, std::string_view id) {
  const double value = analysis::spread(values_of(repeats, id)).mean;
  if (!std::isfinite(value)) return {};
  // Between walls that hold both stresses rise alike: their small difference tells nothing.
  if (id == "peak_differential_stress" && repeats.front()->test() == "growth") return {};
  const dem::Quantity& quantity = dem::find_quantity(study.quantities, id);
  const std::string_view unit = quantity.shown_unit();
  return shown_result(quantity, value) + (unit.empty() ? "" : " " + std::string(unit));
}

/// What a result of a column is called in the middle of a sentence.
std::string name_of(const StudyResult& study, const Repeats& repeats, std::string_view id) {
  std::vector<const dem::Record*> records;
  for (const CaseResult* result : repeats) records.push_back(result->record);
  return lower(std::string(analysis::name_of(dem::find_quantity(study.quantities, id), records)));
}

/// The results of one case.
std::vector<std::string> told_of(const StudyResult& study, const Repeats& repeats,
                                 std::span<const std::string_view> ids) {
  constexpr std::size_t most = 3;
  std::vector<std::string> told;
  for (const std::string_view id : ids) {
    if (told.size() == most) break;
    const std::string said = said_of(study, repeats, id);
    if (!said.empty()) told.push_back(name_of(study, repeats, id) + " " + said);
  }
  return told;
}

/// The most telling result of each of a few cases: "compressive strength 196 MPa (σ₃ 0 MPa) and 285 MPa (σ₃ 10 MPa)".
std::vector<std::string> told_of_each(const StudyResult& study, const std::vector<Repeats>& columns) {
  std::vector<std::string> told;
  std::vector<bool> done(columns.size(), false);
  for (const std::string_view id : telling) {
    std::vector<std::pair<std::string, std::vector<std::string>>> named;  // some may be peaks, and others not
    for (std::size_t i = 0; i < columns.size(); ++i) {
      const std::string said = done[i] ? "" : said_of(study, columns[i], id);
      if (said.empty()) continue;
      const std::string name = name_of(study, columns[i], id);
      auto group = std::ranges::find(named, name, [](const auto& one) { return one.first; });
      if (group == named.end()) group = named.insert(named.end(), {name, {}});
      group->second.push_back(said + " (" + case_label(study, *columns[i].front()) + ")");
      done[i] = true;
    }
    for (const auto& [name, values] : named) told.push_back(name + " " + listed(values));
  }
  return told;
}

// What each test gave, as means of its seeds: "Compression, AR 1: compressive strength 196 MPa, ...".
std::string headline(const StudyResult& study) {
  constexpr std::size_t few = 4;  // cases that are all told
  std::vector<std::string> tests;
  for (const auto& [test, group] : by_test(study)) {
    const std::vector<Repeats> columns = analysis::repeats_of(group);
    const CaseResult& first = *columns.front().front();
    const bool each = columns.size() > 1 && columns.size() <= few;
    std::vector<std::string> said;
    if (each) said = told_of_each(study, columns);
    const bool alone = !said.empty() || case_label(study, first) == capital(words(first.id));
    if (said.empty()) said = told_of(study, columns.front(), telling);
    if (said.empty()) said = told_of(study, columns.front(), of_specimens);
    if (said.empty()) continue;
    std::size_t seeds = 0;
    for (const Repeats& repeats : columns) seeds = std::max(seeds, repeats.size());
    tests.push_back((tests.empty() ? capital(test) : test) + (alone ? "" : ", " + case_label(study, first)) +
                    (seeds > 1 ? fmt::format(", {} of {} seeds: ", each ? "means" : "mean", seeds) : ": ") +
                    listed(said));
  }
  return tests.empty() ? "" : joined(tests, "; ") + ".";
}

// Which figures agree with what is published, which are as one expects, and which are neither.
PageData agreement_parts(const std::vector<DrawnFigure>& figures, const std::string& elsewhere) {
  struct Group {
    Agreement agreement;
    bool published, expected;
    const char* what;
  };
  PageData parts = new_list();
  bool first = true;
  for (const auto& [agreement, published, expected, what] :
       {Group{Agreement::agrees, true, false, "In agreement with what is published:"},
        Group{Agreement::disagrees, true, false, "In disagreement:"},
        Group{Agreement::agrees, false, true, "As expected:"},
        Group{Agreement::disagrees, false, true, "Not as expected:"},
        Group{Agreement::undecided, true, true, "Undecided:"}}) {
    std::vector<const DrawnFigure*> those;
    for (const DrawnFigure& figure : figures) {
      if (figure.agreement == agreement && (figure.expected ? expected : published)) those.push_back(&figure);
    }
    if (those.empty()) continue;
    PageData links = new_list();
    for (std::size_t i = 0; i < those.size(); ++i) {
      PageData link;
      link.set("before", i == 0 ? "" : i + 1 == those.size() ? " and " : ", ");
      link.set("figure_id", std::string(those[i]->figure->id));
      link.set("figure_number", std::to_string(those[i]->number));
      links.push_back(link);
    }
    PageData part;
    // At another scale the first words name it.
    part.set("what", first && !elsewhere.empty() ? "At " + elsewhere + " scale, " + lower(what) : what);
    first = false;
    part.set("links", links);
    parts.push_back(part);
  }
  return parts;
}

}  // namespace

std::span<const std::string_view> telling_results() { return telling; }

PageData findings_data(const StudyResult& study, const Comparisons& comparisons,
                       const std::vector<DrawnFigure>& figures) {
  PageData list = new_list();
  const auto add = [&](const std::string& text, const std::string& state, PageData parts = new_list()) {
    PageData item;
    item.set("text", text);
    item.set("state", state);
    item.set("parts", parts);
    list.push_back(item);
  };
  for (const CaseResult& result : study.cases) {
    if (!result.record && !result.error.empty()) add("Case " + result.id + " failed: " + result.error, "bad");
  }
  for (const DrawnFigure& figure : figures) {
    if (!figure.headline.empty()) add(figure.headline, "plain");
  }
  const std::string results = headline(study);
  if (!results.empty()) add(results, "plain");
  if (!comparisons.rows.empty()) {
    const Tally counts = comparisons.tally();
    add(joined_notes({tally_text(counts, comparisons.scale), missed_text(comparisons)}),
        counts.missed > 0                ? "bad"
        : counts.met > counts.not_judged ? "good"
                                         : "plain");
  }
  if (const std::vector<LaboratoryRow> rows = beside_laboratory(study); !rows.empty()) {
    const bool outside = std::ranges::count(rows, Verdict::missed, &LaboratoryRow::verdict) > 0;
    const bool within = std::ranges::count(rows, Verdict::met, &LaboratoryRow::verdict) > 0;
    const bool small = is_small(*study.scenario);
    add(joined_notes(
            {laboratory_tally(rows, small ? study.scenario->scale() : ""), laboratory_source(*study.scenario)}),
        small     ? "plain"
        : outside ? "bad"
        : within  ? "good"
                  : "plain");
  }
  if (std::ranges::any_of(figures, [](const DrawnFigure& f) { return f.agreement.has_value(); })) {
    const bool judged = comparisons.scale.empty() || comparisons.scale == study.scenario->scale();
    add("", "plain", agreement_parts(figures, judged ? "" : study.scenario->scale()));
  }
  if (const std::string checks = checks_summary(study); !checks.empty())
    add(checks, checks_held(study) ? "good" : "bad");
  return list;
}

}  // namespace reports
