#pragma once
// Figures: one published figure each, redrawn from records. A figure is one file in reports/figures ending in one entry
// of the explicit table figures(): --list-figures, the report's contents and the smoke test over all figures come from it.
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "engine/analysis/cases.h"
#include "engine/scenario/scenario.h"
#include "render/chart/chart.h"
#include "render/scene/scene.h"

namespace reports {

namespace analysis = dem::analysis;

/// A case of the study as figures see it: its parameters, its record, or why there is none.
using analysis::CaseResult;

/// A number that a paper states: a value, or a range.
struct PublishedNumber {
  std::string id, source, quantity, unit;
  double low = 0, high = 0;  ///< the same for a value
};

/// A number that the user's laboratory measured: of the rock, or of a mineral alone. In `unit`.
struct LaboratoryNumber {
  /// "ucs", "Uniaxial compressive strength", "UCS", "MPa" (dem::Measurable).
  std::string_view key, name, symbol, unit;
  std::string mineral;                           ///< "": the rock
  std::string test = {}, result = {}, fit = {};  ///< what of ours it is compared with
  double pressure = 0;                           ///< confining, MPa
  double value = 0, low = 0, high = 0;           ///< with the band that the laboratory states
  double deviation = 0;                          ///< standard deviation; 0: none is stated
  bool is_range = false;                         ///< it was written as a range
};

struct StudyResult {
  const dem::Scenario* scenario = nullptr;
  std::vector<CaseResult> cases;
  std::span<const dem::Quantity> quantities{};  ///< what the model declares
  std::span<const dem::Parameter> parameters{};
  /// Whether a paper is about what is studied: the model's rock. For another rock nothing published stands beside ours.
  bool of_a_paper = true;
  /// What figures show beside ours, of assets/papers.
  std::vector<PublishedNumber> published{};
  std::span<const dem::Measurable> measurables{};  ///< what the model declares
  std::vector<LaboratoryNumber> laboratory{};      ///< what figures show beside ours of the user's own tests

  [[nodiscard]] const dem::Record* find(std::string_view id) const;
  [[nodiscard]] double published_value(std::string_view id) const;  ///< NaN when there is none
  /// The first of that key and mineral; nullptr when it was not measured.
  [[nodiscard]] const LaboratoryNumber* measured(std::string_view key, std::string_view mineral = {}) const;
};

/// Text table, also written as CSV.
struct TextTable {
  std::vector<std::string> head;
  std::vector<std::vector<std::string>> rows;
};

/// An entry of a legend composed by the page: a swatch, its text, and what differs from picture to picture: a count.
/// Pictures beside each other whose colours and texts agree share one legend, and keep their counts.
struct LegendEntry {
  render::Colour colour;
  std::string text;
  std::string count{};
};

/// A scene with what the page writes around it.
struct Picture {
  render::Scene scene;
  std::string label;  ///< under the picture: "AR 2"
  std::vector<LegendEntry> legend;
  bool scale_bar = true;
};

/// One part of a figure: "a", "b", ... `id` is a suffix of the figure's id and names its files.
struct Panel {
  std::string id;
  std::string caption;  ///< one sentence
  std::string alt;      ///< what a reader who cannot see it must know, numbers included
  std::variant<render::Chart, Picture, TextTable, std::string> content;  ///< std::string: a complete SVG drawing
  int per_row = 0;           ///< panels beside each other on the page; 0: charts two, pictures three
  bool whole_width = false;  ///< alone in its row, it is as wide as the printed page
};

/// Whether ours agrees with the statement of a figure.
enum class Agreement { agrees, disagrees, undecided };

struct FigureContent {
  std::vector<Panel> panels;
  std::string statement;  ///< what the paper says of this figure, in our words; nothing that its source does not say
  std::string finding;   ///< what ours shows, with numbers from the records; the word before it is composed from these:
  std::string headline;  ///< what the findings of the report begin with, where no result of a case says it
  std::vector<std::string> rows;       ///< ids of the published numbers that the statement stands on
  std::optional<Agreement> agreement;  ///< by the figure's own measure, where no number is published
  bool expected = false;               ///< the statement is no paper's: what one expects
};

/// Gives charts the width at which they are shown, so that their text has one size everywhere: those beside each other a
/// column each and one height, the others, and one that would be left alone, the page.
void lay_out(std::vector<Panel>& panels);

struct Figure {
  std::string_view id;  ///< "crack_maps"
  std::string_view title;
  std::string_view source;  ///< "Zhao et al. 2021, Fig. 15a"
  std::string_view model;   ///< records it needs
  FigureContent (*make)(const StudyResult&);
};

std::span<const Figure> figures();  ///< reports/figures/table.cpp

}  // namespace reports
