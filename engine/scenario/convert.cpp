#include "engine/scenario/convert.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>

#include "engine/scenario/suggest.h"
#include "engine/scenario/units.h"

namespace dem::scenario_detail {
namespace {

struct Place {
  const Key& key;
  Location where;
  std::string shown;

  [[noreturn]] void refuse(const std::string& wrong, std::string right) const {
    throw InputError(where, shown, wrong, std::move(right));
  }
};

std::string in_words(const toml::node& node) {
  if (const auto* text = node.as_string()) return "the text \"" + text->get() + "\"";
  if (const auto* number = node.as_integer()) return "the number " + std::to_string(number->get());
  if (const auto* number = node.as_floating_point()) return "the number " + shortest(number->get());
  if (const auto* truth = node.as_boolean()) return truth->get() ? "true" : "false";
  if (node.is_array()) return "a list";
  if (node.is_table()) return "a table";
  return "a date or time";
}

std::string bound(double limit, const Key& key) { return shortest(limit) + (key.unit.empty() ? "" : " " + key.unit); }

std::string range_text(const Key& key) {
  const bool low = std::isfinite(key.low);
  const bool high = std::isfinite(key.high);
  if (low && high) return "from " + bound(key.low, key) + " to " + bound(key.high, key);
  if (low) return bound(key.low, key) + " or more";
  if (high) return bound(key.high, key) + " or less";
  return {};
}

bool is_list(KeyType type) { return type == KeyType::integers || type == KeyType::reals || type == KeyType::texts; }

void check_range(const Place& place, double si) {
  const Key& key = place.key;
  if (si >= to_si(key.low, key.unit) && si <= to_si(key.high, key.unit)) return;
  place.refuse(in_unit(si, key.unit) + " is out of range", "allowed is " + range_text(key));
}

double bare_number(const Place& place, const toml::node& node) {
  if (const auto* number = node.as_integer()) return static_cast<double>(number->get());
  if (const auto* number = node.as_floating_point()) {
    if (!std::isfinite(number->get())) place.refuse("it is not a finite number", "write " + expectation(place.key));
    return number->get();
  }
  if (node.is_string()) {
    place.refuse("wrong type: " + in_words(node) + " where a bare number is needed",
                 "this key has no unit: write " + expectation(place.key) + " without quotes");
  }
  place.refuse("wrong type: " + in_words(node), "write " + expectation(place.key));
}

double real_value(const Place& place, const toml::node& node) {
  const Key& key = place.key;
  double si = 0;
  if (key.unit.empty()) {
    si = bare_number(place, node);
  } else if (const auto* text = node.as_string()) {
    try {
      si = read_quantity(text->get(), key.unit);
    } catch (const InputError& error) {
      place.refuse(error.what(), {});
    }
  } else if (node.is_number()) {
    const double number =
        node.is_integer() ? static_cast<double>(node.as_integer()->get()) : node.as_floating_point()->get();
    place.refuse("the bare number " + shortest(number) + " has no unit",
                 "write it with its unit, such as \"" + shortest(number) + " " + key.unit + "\"");
  } else {
    place.refuse("wrong type: " + in_words(node), "write " + expectation(key));
  }
  check_range(place, si);
  return si;
}

std::int64_t integer_value(const Place& place, const toml::node& node) {
  const auto* number = node.as_integer();
  if (!number) place.refuse("wrong type: " + in_words(node), "write " + expectation(place.key));
  check_range(place, static_cast<double>(number->get()));
  return number->get();
}

std::string text_value(const Place& place, const toml::node& node) {
  const auto* text = node.as_string();
  if (!text) {
    const bool number = node.is_number();
    place.refuse("wrong type: " + in_words(node), "write " + expectation(place.key) + (number ? " in quotes" : ""));
  }
  const auto& choices = place.key.choices;
  if (!choices.empty() && std::ranges::find(choices, text->get()) == choices.end()) {
    place.refuse("'" + text->get() + "' is not a choice", advice(text->get(), choices, "the choices are"));
  }
  return text->get();
}

template <class One>
auto list_value(const Place& place, const toml::node& node, One one) {
  std::vector<decltype(one(place, node))> values;
  const auto* array = node.as_array();
  if (!array) {
    place.refuse("wrong type: " + in_words(node) + " where a list is needed",
                 "write " + expectation(place.key) + ", in square brackets");
  }
  if (array->empty() && place.key.standard != "[]") {
    place.refuse("the list is empty", "give at least one value: " + expectation(place.key));
  }
  for (std::size_t i = 0; i < array->size(); ++i) {
    const toml::node& item = *array->get(i);
    Place at{place.key, place.where, place.shown + "[" + std::to_string(i) + "]"};
    if (item.source().begin) at.where = location(place.where.file, item.source());
    values.push_back(one(at, item));
  }
  return values;
}

}  // namespace

Location location(const std::string& file, const toml::source_region& source) {
  return {file, static_cast<int>(source.begin.line), static_cast<int>(source.begin.column)};
}

std::string expectation(const Key& key) {
  const bool list = is_list(key.type);
  std::string range = range_text(key);
  if (!range.empty()) range = ", " + range;
  switch (key.type) {
    case KeyType::boolean:
      return "true or false";
    case KeyType::integer:
    case KeyType::integers:
      return (list ? "a list of whole numbers" : "a whole number") + range;
    case KeyType::real:
    case KeyType::reals: {
      if (key.unit.empty()) return (list ? "a list of numbers" : "a number") + range;
      const double sample = std::isfinite(key.low) && key.low > 0 ? key.low : std::isfinite(key.high) ? key.high : 1;
      const std::string example = "\"" + shortest(sample) + " " + key.unit + "\"";
      return (list ? "a list of quantities, such as [" + example + "]" : "a quantity, such as " + example) + range;
    }
    case KeyType::text:
    case KeyType::texts:
      if (!key.choices.empty()) return (list ? "a list of words out of " : "one of: ") + joined(key.choices);
      return list ? "a list of texts" : "a text";
  }
  throw std::logic_error("a key type without a description");
}

Value convert(const Key& key, const toml::node& node, const Location& where, const std::string& shown) {
  const Place place{key, where, shown};
  switch (key.type) {
    case KeyType::boolean: {
      const auto* truth = node.as_boolean();
      if (!truth) place.refuse("wrong type: " + in_words(node), "write true or false, without quotes");
      return truth->get();
    }
    case KeyType::integer:
      return integer_value(place, node);
    case KeyType::real:
      return real_value(place, node);
    case KeyType::text:
      return text_value(place, node);
    case KeyType::integers:
      return list_value(place, node, integer_value);
    case KeyType::reals:
      return list_value(place, node, real_value);
    case KeyType::texts:
      return list_value(place, node, text_value);
  }
  throw std::logic_error("a key type that cannot be read");
}

Value standard_value(const Key& key) {
  try {
    const toml::table table = toml::parse("value = " + key.standard);
    return convert(key, *table.get("value"), Location{}, key.path);
  } catch (const toml::parse_error& error) {
    throw std::logic_error("the default of " + key.path + " is not TOML: " + std::string(error.description()));
  } catch (const InputError& error) {
    throw std::logic_error("the default of " + key.path + " is refused: " + error.what());
  }
}

}  // namespace dem::scenario_detail
