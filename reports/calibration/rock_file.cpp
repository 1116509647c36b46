#include "reports/calibration/rock_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>

#include "engine/scenario/measured.h"
#include "engine/scenario/units.h"

namespace calibrate {
namespace {

std::string in_quotes(const std::string& text) { return "\"" + text + "\""; }

std::string plain(double si, const std::string& unit) {
  return fmt::format("{:.10g}", unit.empty() ? si : si / dem::to_si(1, unit));
}

std::string measured_text(const dem::Measured& value, const dem::Key& key) {
  const std::string unit = key.unit.empty() ? "" : " " + key.unit;
  std::string text;
  if (value.is_certain()) {
    text = plain(value.value, key.unit) + unit;
  } else if (value.high - value.low > 2.5 * value.deviation) {
    text = plain(value.low, key.unit) + "-" + plain(value.high, key.unit) + unit;
  } else {
    text = plain(value.value, key.unit) + unit + " +- " + plain(value.deviation, key.unit);
  }
  if (key.type == dem::KeyType::measured_at) text += " at " + plain(value.at, key.at_unit) + " " + key.at_unit;
  return in_quotes(text);
}

std::string value_text(const dem::Scenario& scenario, const std::string& path, const dem::Key& key,
                       const double* other) {
  const auto number = [&](double si) {
    return key.unit.empty() ? dem::shortest(si) : in_quotes(dem::in_unit(si, key.unit));
  };
  const auto list = [&](const auto& values, const auto& one) {
    std::string text = "[";
    for (const auto& value : values) text += (text.size() > 1 ? ", " : "") + one(value);
    return text + "]";
  };
  switch (key.type) {
    case dem::KeyType::boolean:
      return scenario.boolean(path) ? "true" : "false";
    case dem::KeyType::integer:
      return std::to_string(scenario.integer(path));
    case dem::KeyType::real:
      return number(other ? *other : scenario.real(path));
    case dem::KeyType::text:
      return in_quotes(scenario.text(path));
    case dem::KeyType::integers:
      return list(scenario.integers(path), [](std::int64_t v) { return std::to_string(v); });
    case dem::KeyType::reals:
      return list(scenario.reals(path), number);
    case dem::KeyType::texts:
      return list(scenario.texts(path), in_quotes);
    case dem::KeyType::measured:
      return measured_text(dem::measured(scenario, path).front(), key);
    case dem::KeyType::measured_at:
      return list(dem::measured(scenario, path), [&](const dem::Measured& v) { return measured_text(v, key); });
  }
  return {};
}

}  // namespace

double rounded(double si, const std::string& unit) {
  const std::string text = fmt::format("{:.4g}", unit.empty() ? si : si / dem::to_si(1, unit));
  return unit.empty() ? std::strtod(text.c_str(), nullptr) : dem::read_quantity(text + " " + unit, unit);
}

std::string rock_file(const dem::Scenario& scenario, const dem::Model& model,
                      const std::map<std::string, double>& values, const std::string& head) {
  std::string text = head;
  // Of the rock is what these tables say, and what else the file of the rock says.
  const auto of_rock = [&](const std::string& path) {
    if (path == "rock") return true;
    for (const char* table : {"packing.", "mineral[", "interaction.", "measured."}) {
      if (path.starts_with(table)) return true;
    }
    return !scenario.included().empty() && scenario.error(path, "", "").where().file == scenario.included();
  };
  std::string table;
  const auto write = [&](const std::string& path, const dem::Key& key, const std::string& header,
                         const std::string& leaf) {
    const auto moved = values.find(path);
    if (!scenario.given(path) && moved == values.end()) return;
    if (header != table && !header.empty()) text += "\n" + header + "\n";
    table = header;
    text += leaf + " = " + value_text(scenario, path, key, moved == values.end() ? nullptr : &moved->second) + "\n";
  };
  const auto leaf_of = [](const std::string& path) { return path.substr(path.rfind('.') + 1); };
  for (const dem::Key& key : model.keys()) {
    if (key.path.find("[]") != std::string::npos || !of_rock(key.path) || key.path.find('.') != std::string::npos)
      continue;
    write(key.path, key, "", key.path);
  }
  // A table at a time: keys of one may be declared apart.
  std::vector<std::string> tables;
  for (const dem::Key& key : model.keys()) {
    const std::size_t dot = key.path.rfind('.');
    if (dot == std::string::npos || key.path.find("[]") != std::string::npos || !of_rock(key.path)) continue;
    const std::string name = key.path.substr(0, dot);
    if (std::ranges::find(tables, name) == tables.end()) tables.push_back(name);
  }
  for (const std::string& name : tables) {
    for (const dem::Key& key : model.keys()) {
      if (key.path.starts_with(name + ".") && key.path.find('.', name.size() + 1) == std::string::npos &&
          of_rock(key.path))
        write(key.path, key, "[" + name + "]", leaf_of(key.path));
    }
  }
  for (std::size_t i = 0; i < scenario.count("mineral"); ++i) {
    table.clear();
    text += "\n[[mineral]]\n";
    const std::string entry = fmt::format("mineral[{}].", i);
    for (const bool measured : {false, true}) {
      for (const dem::Key& key : model.keys()) {
        if (!key.path.starts_with("mineral[].")) continue;
        const std::string rest = key.path.substr(10);
        if (rest.starts_with("measured.") != measured) continue;
        write(entry + rest, key, measured ? "[mineral.measured]" : "", leaf_of(rest));
      }
    }
  }
  return text;
}

}  // namespace calibrate
