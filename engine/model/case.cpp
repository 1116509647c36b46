#include "engine/model/case.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <stdexcept>

#include "engine/core/text.h"
#include "engine/model/model.h"
#include "engine/scenario/units.h"

namespace dem {
namespace {

bool matters(const Key& key, const std::vector<std::string>& kinds) {
  if (key.affects != Affects::specimen && key.affects != Affects::test) return false;
  return key.when.empty() || std::ranges::any_of(key.when, [&](const std::string& w) {
           return std::ranges::find(kinds, w) != kinds.end();
         });
}

ParameterValue usual_of(const Parameter& parameter) {
  double number = 0;
  const char* end = parameter.usual.data() + parameter.usual.size();
  const auto [at, error] = std::from_chars(parameter.usual.data(), end, number);
  return error == std::errc() && at == end ? ParameterValue(number) : ParameterValue(std::string(parameter.usual));
}

ParameterValue value_of(const Parameter& parameter, const Scenario& scenario) {
  const Value& value = scenario.value(parameter.key);
  if (const auto* text = std::get_if<std::string>(&value)) return *text;
  // Without the noise of conversions, as in the parameters of cases.
  const double scale = to_si(1, parameter.unit == "°" ? "deg" : parameter.unit);
  return std::round(scenario.real(parameter.key) / scale * 1e9) / 1e9;
}

template <class T>
void refuse(const Scenario& scenario, std::string_view path, const std::vector<T>& values) {
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (std::find(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(i), values[i]) ==
        values.begin() + static_cast<std::ptrdiff_t>(i))
      continue;
    throw scenario.error(path,
                         fmt::format("entries {} and {} of the list are the same",
                                     1 + std::distance(values.begin(), std::ranges::find(values, values[i])), i + 1),
                         "name each value once: every one makes a case of its own");
  }
}

}  // namespace

void refuse_repeated(const Scenario& scenario, std::string_view path, const std::vector<std::int64_t>& values) {
  refuse(scenario, path, values);
}
void refuse_repeated(const Scenario& scenario, std::string_view path, const std::vector<double>& values) {
  refuse(scenario, path, values);
}
void refuse_repeated(const Scenario& scenario, std::string_view path, const std::vector<std::string>& values) {
  refuse(scenario, path, values);
}

Key repeats_key() {
  return {.path = "repeats",
          .type = KeyType::integer,
          .low = 1,
          .high = 1000,
          .standard = "1",
          .affects = Affects::cases,
          .help = "specimens of each kind, with seed, seed + 1, ...: tells a trend from scatter"};
}

std::vector<std::int64_t> seeds_of(const Scenario& scenario) {
  const auto first = static_cast<std::int64_t>(scenario.seed());
  const std::int64_t repeats = scenario.integer("repeats");
  if (const std::int64_t room = largest_seed - first; repeats - 1 > room) {
    throw scenario.error("repeats",
                         fmt::format("the last of {} seeds from {} on is beyond {}", repeats, first, largest_seed),
                         room > 0 ? fmt::format("ask for at most {}, or begin with a smaller seed", room + 1)
                                  : "begin with a smaller seed");
  }
  std::vector<std::int64_t> seeds;
  for (std::int64_t k = 0; k < repeats; ++k) seeds.push_back(first + k);
  return seeds;
}

std::string seed_part(const Scenario& scenario, std::int64_t seed) {
  return seed == static_cast<std::int64_t>(scenario.seed()) ? "" : fmt::format("_seed_{}", seed);
}

const std::string& CaseSpec::test() const {
  const ParameterValue* value = find_value(parameters, "test");
  const auto* name = value ? std::get_if<std::string>(value) : nullptr;
  if (!name) throw std::logic_error("case '" + id + "' has no test");
  return *name;
}

CaseSpec make_case(const Model& model, std::string id, Scenario scenario, Parameters parameters,
                   const std::vector<std::string>& kinds, std::string_view inputs) {
  constexpr std::size_t longest = 200;  // of a file's name
  const bool plain = !id.empty() && id.size() <= longest &&
                     id.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789_") == std::string::npos;
  if (!plain) throw std::logic_error("'" + id + "' cannot be the id of a case; ids are made with id_part()");
  std::vector<std::string> paths;
  const auto add = [&](std::span<const Key> keys) {
    for (const Key& key : keys) {
      if (matters(key, kinds)) paths.push_back(key.path);
    }
  };
  add(common_keys());
  add(model.keys());
  CaseSpec spec{std::move(id), std::move(scenario), {}, std::move(parameters), 1, {}};
  spec.content = fmt::format("model = {}\nphysics version = {}\nkind = {}\n{}{}", model.name, model.physics_version,
                             fmt::join(kinds, ", "), spec.scenario.canonical(paths), inputs);
  return spec;
}

Record new_record(const Model& model, const CaseSpec& spec) {
  Record record;
  record.model = model.name;
  record.scenario = spec.scenario.name();
  record.case_id = spec.id;
  record.content = spec.content;
  record.physics_version = model.physics_version;
  record.seed = spec.scenario.seed();
  record.parameters = spec.parameters;
  record.quantities = model.quantities();
  return record;
}

Parameters usual_values(std::span<const Parameter> declared, const Scenario& scenario) {
  Parameters values;
  for (const Parameter& parameter : declared) {
    if (parameter.id == "seed") continue;
    values.emplace_back(parameter.id, parameter.key.empty() ? usual_of(parameter) : value_of(parameter, scenario));
  }
  return values;
}

std::string id_part(double value) { return id_part(fmt::format("{}", value)); }

std::string id_part(std::string_view text) {
  double number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  const bool is_number = error == std::errc() && end == text.data() + text.size();
  std::string part;
  while (!text.empty()) {
    const Character next = first_character(text);
    if (next.code >= 128) {
      part += fmt::format("u{:x}", static_cast<std::uint32_t>(next.code));
    } else if (std::isalnum(static_cast<int>(next.code)) != 0) {
      part += static_cast<char>(std::tolower(static_cast<int>(next.code)));
    } else if (is_number && next.code == '-') {
      part += 'm';
    } else if (!is_number || next.code != '+') {
      part += '_';
    }
    text.remove_prefix(next.bytes);
  }
  return part;
}

}  // namespace dem
