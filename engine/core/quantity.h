#pragma once
// What a case gives and what sets it apart, declared once: the quantities of its results and the parameters of its cases.
// Table rows, units and factors of charts, headings of CSV files, keys of summary.json and the page docs/use/results.md
// come from these declarations. A model lists its own in quantities.h beside its keys.
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace dem {

enum class QuantityKind {
  result,      ///< what the study is made for: a modulus, a strength
  diagnostic,  ///< how well it was made: residuals, steps, settings that follow from others
  count,       ///< a whole number: particles, cracks
};

/// One result of a record. `id` is its key in records and in summary.json; "family.*" stands for one result a member
/// ("mineral_share.quartz"), whose name follows the family's.
struct Quantity {
  std::string_view id;           ///< "young_modulus", "cracks.inter_tension", "mineral_share.*"
  std::string_view name;         ///< begins with a capital: "Young’s modulus"
  std::string_view symbol = {};  ///< "E", "σ_cd" (what follows _ is an index, one word)
  std::string_view unit = {};    ///< of the stored value: "GPa", "N/m"; "" without
  std::string_view shown = {};   ///< the unit in which people read it, where it is another one: "%", "10⁶ N/m"
  double factor = 1;             ///< from the stored value to the shown one
  int digits = 3;                ///< significant digits that a reader needs
  QuantityKind kind = QuantityKind::result;
  bool of_size = false;           ///< grows with the specimen or its resolution: means nothing beside another size
  double scatter = 0;             ///< relative standard deviation between seeds at draft scale; 0: not known, or none
  std::string_view tests = {};    ///< the tests that give it, with spaces between; "": every one
  std::string_view meaning = {};  ///< one sentence: how it is defined and measured
  /// Of the largest value of a curve that a run may leave while it rises: the name where it has fallen again
  /// (engine/analysis/peaks.h). `name` is true of either.
  std::string_view peak_name = {};

  [[nodiscard]] bool family() const { return id.ends_with(".*"); }
  [[nodiscard]] std::string_view shown_unit() const { return shown.empty() ? unit : shown; }
  /// Whether a result called `result` is this quantity, or a member of this family.
  [[nodiscard]] bool covers(std::string_view result) const;
  [[nodiscard]] bool given_by(std::string_view test) const;
};

/// One of several ways to read the same thing off a test.
struct Reading {
  std::string_view id;    ///< of fits and panels: "axial_stiffness"
  std::string_view name;  ///< in sentences: "axial stiffness"
  Quantity quantity;
};

using ParameterValue = std::variant<double, std::string>;

/// One thing that cases of a study may differ in: an axis of a sweep, or a choice.
struct Parameter {
  std::string_view id;            ///< in records, summary.json and published terms: "confining_pressure"
  std::string_view name;          ///< title of an axis: "Confining pressure"
  std::string_view symbol = {};   ///< in labels, before the value: "σ₃"; "": the value stands alone
  std::string_view unit = {};     ///< of its values: "MPa", "°"
  std::string_view in_ids = {};   ///< in ids of cases and names of files: "sigma3"
  std::string_view key = {};      ///< scenario key of its value where nothing sweeps it; "": `usual`
  std::string_view usual = {};    ///< the value of a case without it: a number or a word
  std::string_view at_zero = {};  ///< in labels, instead of symbol and value where that is 0: "flat platens"
  std::string_view behind = {};   ///< in labels, after a value without a unit: "R" of "jaws of 1.5 R"
  bool axis = false;              ///< a quantity that results are plotted against
  std::string_view words = {};    ///< in sentences: "the confining pressure"
  std::string_view step = {};     ///< "MPa of confining pressure", after "per"
};

/// What laboratories measure that a model gives: a key below [measured] of its scenarios.
struct Measurable {
  std::string_view key;           ///< "ucs"
  std::string_view name;          ///< begins with a capital: "Uniaxial compressive strength"
  std::string_view symbol = {};   ///< "UCS"
  std::string_view unit = {};     ///< "MPa"
  double low = 0, high = 0;       ///< what a value may be, in the unit
  std::string_view test = {};     ///< that gives it
  std::string_view result = {};   ///< id of the result; "": it is fitted
  std::string_view by = {};       ///< a key below [measured] whose word completes that id: a choice of readings
  std::string_view fit = {};      ///< name of the fit: "peak.m"
  bool confined = false;          ///< a list of values, each at a confining pressure
  std::string_view meaning = {};  ///< for the help of the key
};

/// What sets a case apart, by the ids of its model's parameters; "test" comes first.
using Parameters = std::vector<std::pair<std::string, ParameterValue>>;

/// nullptr when absent.
const ParameterValue* find_value(const Parameters& parameters, std::string_view id);

/// The quantity of a result, the declared one or the family that it belongs to.
/// Throws std::out_of_range naming it when none is declared.
const Quantity& find_quantity(std::span<const Quantity> declared, std::string_view result);
/// Throws std::out_of_range naming it when it is not declared.
const Parameter& find_parameter(std::span<const Parameter> declared, std::string_view id);

}  // namespace dem
