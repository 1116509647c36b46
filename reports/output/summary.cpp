#include "reports/output/summary.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "reports/provenance.h"
#include "reports/published/laboratory.h"

namespace reports {
namespace {

using Json = nlohmann::ordered_json;

void put(Json& object, std::string_view name, Json value) {
  const std::size_t dot = name.find('.');
  if (dot == std::string_view::npos)
    object[std::string(name)] = std::move(value);
  else
    put(object[std::string(name.substr(0, dot))], name.substr(dot + 1), std::move(value));
}

// Counts and seeds are written as whole numbers, as far as a double holds every one.
Json plain(double value) {
  if (std::floor(value) == value && std::abs(value) <= 0x1p53) return static_cast<std::int64_t>(value);
  return value;
}

Json plain(const std::variant<double, std::string>& value) {
  if (const auto* text = std::get_if<std::string>(&value)) return *text;
  return plain(std::get<double>(value));
}

Json plain(const Amount& amount) {
  if (const auto* text = std::get_if<std::string>(&amount)) return *text;
  if (const auto* range = std::get_if<std::pair<double, double>>(&amount)) {
    return Json::array({plain(range->first), plain(range->second)});
  }
  return plain(std::get<double>(amount));
}

template <class T>
Json or_null(const std::optional<T>& value) {
  return value ? plain(*value) : Json();
}

constexpr std::uint64_t most_of_a_double = std::uint64_t{1} << 53;

/// Where readers of JSON would lose digits it is a text.
Json seed(std::uint64_t value) {
  if (value > most_of_a_double) return std::to_string(value);
  return value;
}

Json provenance_json(const StudyResult& study, const std::string& engine_version) {
  const Provenance origin = provenance_of(study, engine_version);
  return {{"scenario_sha256", origin.scenario_sha256},
          {"engine_version", origin.engine_version},
          {"physics_version", origin.physics_version},
          {"seed", seed(origin.seed)}};
}

Json case_json(const CaseResult& result) {
  Json json{{"id", result.id}, {"parameters", Json::object()}, {"results", Json::object()}};
  for (const auto& [id, value] : result.parameters) put(json["parameters"], id, plain(value));
  // The record has the seed whole.
  if (result.record && result.record->seed > most_of_a_double) json["parameters"]["seed"] = seed(result.record->seed);
  if (!result.record) {
    json["error"] = result.error;
    return json;
  }
  for (const auto& [name, value] : result.record->results) {
    if (std::isfinite(value)) put(json["results"], name, plain(value));
  }
  return json;
}

std::string_view kind_word(dem::QuantityKind kind) {
  switch (kind) {
    case dem::QuantityKind::result:
      return "result";
    case dem::QuantityKind::diagnostic:
      return "diagnostic";
    case dem::QuantityKind::count:
      break;
  }
  return "count";
}

// Of the results that the cases have, in the order of their declarations: the unit of the numbers, and what they are.
Json quantities_json(const StudyResult& study) {
  Json json = Json::object();
  for (const dem::Quantity& quantity : study.quantities) {
    const bool there = std::ranges::any_of(study.cases, [&](const CaseResult& result) {
      return result.record &&
             std::ranges::any_of(result.record->results, [&](const auto& r) { return quantity.covers(r.first); });
    });
    if (!there) continue;
    json[std::string(quantity.id)] = {{"name", quantity.name},
                                      {"symbol", quantity.symbol},
                                      {"unit", quantity.unit},
                                      {"kind", kind_word(quantity.kind)},
                                      {"of_size", quantity.of_size}};
  }
  return json;
}

Json comparison_json(const Comparison& row) {
  Json json{{"id", row.id},
            {"source", row.source},
            {"published", row.stated.empty() ? plain(row.published) : Json(row.stated)},
            {"computed", or_null(row.computed)},
            {"deviation", or_null(row.deviation)},
            {"tolerance", or_null(row.tolerance)},
            {"verdict", verdict_word(row.verdict)},
            {"role", role_word(row.role)},
            {"of", row.of},
            {"scale", row.scale},
            {"unit", row.unit},
            {"relative", row.relative}};
  if (!row.stated.empty()) json["read_as"] = plain(row.published);
  if (row.estimate && row.estimate->has_interval()) {
    if (row.kind == "trend") json["slope"] = plain(row.estimate->value);
    if (row.kind == "greater") json["difference"] = plain(row.estimate->value);
    json["interval"] = {plain(row.estimate->low), plain(row.estimate->high)};
  }
  if (row.p_value && std::isfinite(*row.p_value)) json["p_value"] = plain(*row.p_value);
  return json;
}

Json laboratory_json(const LaboratoryRow& row) {
  const LaboratoryNumber& number = row.number;
  Json json{{"key", number.key},
            {"mineral", number.mineral},
            {"confining_pressure", plain(number.pressure)},
            {"unit", number.unit},
            {"measured", {plain(number.low), plain(number.high)}},
            {"computed", row.ours ? plain(row.ours->value) : Json()}};
  if (row.ours && row.ours->has_interval()) json["interval"] = {plain(row.ours->low), plain(row.ours->high)};
  json["verdict"] = laboratory_word(row.verdict);
  return json;
}

Json tally_json(const Tally& counts) {
  return {{"met", counts.met},
          {"missed", counts.missed},
          {"undecided", counts.undecided},
          {"not_judged", counts.not_judged},
          {"not_computed", counts.not_computed},
          {"fitted", counts.fitted},
          {"theory", counts.theory},
          {"stated", counts.stated},
          {"derived", counts.derived}};
}

}  // namespace

std::string summary_json(const StudyResult& study, const Comparisons& comparisons,
                         const std::vector<DrawnFigure>& figures, const std::string& engine_version) {
  Json json{{"format", summary_format},
            {"scenario", study.scenario->name()},
            {"scale", study.scenario->scale()},
            {"provenance", provenance_json(study, engine_version)},
            {"quantities", quantities_json(study)},
            {"cases", Json::array()},
            {"verdicts", tally_json(comparisons.tally())},
            {"comparisons", Json::array()},
            {"checks", Json::array()},
            {"figures", Json::array()}};
  for (const CaseResult& result : study.cases) {
    json["cases"].push_back(case_json(result));
    if (!result.record) continue;
    for (const dem::Check& check : result.record->checks) {
      Json item{{"id", result.id + "." + check.id}, {"value", Json()}, {"limit", plain(check.limit)}};
      if (std::isfinite(check.value)) item["value"] = plain(check.value);
      item["held"] = check.held;
      json["checks"].push_back(std::move(item));
    }
  }
  for (const Comparison& row : comparisons.rows) json["comparisons"].push_back(comparison_json(row));
  for (const LaboratoryRow& row : beside_laboratory(study)) json["laboratory"].push_back(laboratory_json(row));
  for (const DrawnFigure& figure : figures) {
    json["figures"].push_back({{"id", figure.figure->id},
                               {"title", figure.figure->title},
                               {"source", figure.figure->source},
                               {"files", figure.files}});
  }
  return json.dump(2) + "\n";
}

std::string run_json(const RunFacts& facts) {
  Json json = Json::object();
  for (const auto& [name, value] : facts) put(json, name, plain(value));
  return json.dump(2) + "\n";
}

}  // namespace reports
