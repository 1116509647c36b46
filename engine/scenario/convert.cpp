#include "engine/scenario/convert.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <optional>
#include <stdexcept>

#include "engine/core/text.h"
#include "engine/scenario/measured.h"
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
  if (const auto* text = node.as_string()) return "the text \"" + excerpt(text->get()) + "\"";
  if (const auto* number = node.as_integer()) return "the number " + std::to_string(number->get());
  if (const auto* number = node.as_floating_point()) return "the number " + shortest(number->get());
  if (const auto* truth = node.as_boolean()) return truth->get() ? "true" : "false";
  if (node.is_array()) return "a list";
  if (node.is_table()) return "a table";
  return "a date or time";
}

std::string bound(double limit, const Key& key) { return shortest(limit) + (key.unit.empty() ? "" : " " + key.unit); }

struct Limits {
  std::size_t letters;  ///< of the text
  std::size_t word;     ///< of what has no blank inside
};

Limits limits_of(Form form) {
  switch (form) {
    case Form::line:
      return {200, 60};
    case Form::paragraph:
      return {5000, 200};  // an address has no blanks
    case Form::name:
      return {40, 40};
    case Form::path:
      return {1000, 1000};
  }
  throw std::logic_error("a form of text without limits");
}

std::size_t longest_word(std::string_view text) {
  std::size_t longest = 0;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find_first_of(" \n\t"), text.size());
    longest = std::max(longest, length_of(text.substr(0, end)));
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return longest;
}

/// The first character of a text that its form does not allow, for a person; "" when there is none.
std::string misplaced(std::string_view text, Form form) {
  while (!text.empty()) {
    const Character next = first_character(text);
    const bool line_end = next.code == '\n' || next.code == '\t' || next.code == '\r';
    const bool control = is_control(next.code) && !(form == Form::paragraph && line_end);
    const bool sign =
        next.code < 128 && std::string_view(" -_()+").find(static_cast<char>(next.code)) != std::string_view::npos;
    const bool foreign = form == Form::name && !sign && !is_letter_or_digit(next.code);
    if (!next.valid || control) return "the control character " + printable(text.substr(0, next.bytes));
    if (foreign) return "'" + std::string(text.substr(0, next.bytes)) + "'";
    text.remove_prefix(next.bytes);
  }
  return {};
}

void check_text(const Place& place, const std::string& text, Form form) {
  const std::string bad = misplaced(text, form);
  if (!bad.empty() && form == Form::name) {
    place.refuse("the name \"" + excerpt(text) + "\" has " + bad,
                 "names are made of letters, digits, blanks and - _ ( ) +, for they become names of folders");
  }
  if (!bad.empty()) place.refuse("\"" + excerpt(text) + "\" has " + bad, "leave it out");
  const Limits limits = limits_of(form);
  if (const std::size_t length = length_of(text); length > limits.letters) {
    place.refuse("\"" + excerpt(text) + "\" has " + std::to_string(length) + " characters",
                 "write at most " + std::to_string(limits.letters));
  }
  if (const std::size_t length = longest_word(text); length > limits.word) {
    place.refuse("\"" + excerpt(text) + "\" has a word of " + std::to_string(length) + " characters",
                 "write words of at most " + std::to_string(limits.word));
  }
  if (form != Form::name) return;
  if (text.empty()) {
    if (place.key.standard != "\"\"") place.refuse("the name is empty", "give it one");
    return;
  }
  if (!is_letter_or_digit(first_character(text).code) || text.ends_with(' ')) {
    place.refuse("the name \"" + text + "\" " + (text.ends_with(' ') ? "ends with a blank" : "begins with a sign"),
                 "begin with a letter or digit and end with no blank");
  }
}

std::string range_text(const Key& key) {
  const bool low = std::isfinite(key.low);
  const bool high = std::isfinite(key.high);
  if (low && high) return "from " + bound(key.low, key) + " to " + bound(key.high, key);
  if (low) return bound(key.low, key) + " or more";
  if (high) return bound(key.high, key) + " or less";
  return {};
}

bool is_list(KeyType type) {
  return type == KeyType::integers || type == KeyType::reals || type == KeyType::texts || type == KeyType::measured_at;
}

bool in_range(const Key& key, double si) { return si >= to_si(key.low, key.unit) && si <= to_si(key.high, key.unit); }

void check_range(const Place& place, double si) {
  const Key& key = place.key;
  if (in_range(key, si)) return;
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

/// What a number without unit may have been meant to be: in the declared unit, or in SI units (a fraction, 50e9), whichever
/// are in the range, the likelier first.
std::string with_unit(const Key& key, double number) {
  std::vector<std::string> meant;
  if (in_range(key, to_si(number, key.unit))) meant.push_back("\"" + shortest(number) + " " + key.unit + "\"");
  const std::string in_words = "\"" + in_unit(number, key.unit) + "\"";
  const bool rather = key.unit == "%" ? number > 0 && number <= 1 : number >= 1e4;  // 0.17, 50e9
  const bool si = std::isfinite(number) && in_range(key, number) && (meant.empty() || rather);
  if (si && (meant.empty() || meant.front() != in_words)) meant.insert(meant.begin(), in_words);
  if (meant.empty()) return "write " + expectation(key);
  return meant.size() == 1 ? meant.front() : meant[0] + ", or " + meant[1] + " if that is meant";
}

double real_value(const Place& place, const toml::node& node) {
  const Key& key = place.key;
  double si = 0;
  if (key.unit.empty()) {
    si = bare_number(place, node);
  } else if (const auto* text = node.as_string()) {
    check_text(place, text->get(), Form::line);
    if (const std::optional<double> bare = read_number(text->get())) {
      const std::string meant = with_unit(key, *bare);
      place.refuse("\"" + text->get() + "\" has no unit", (meant.starts_with('"') ? "write " : "") + meant);
    }
    try {
      si = read_quantity(text->get(), key.unit);
    } catch (const InputError& error) {
      place.refuse(error.what(), {});
    }
  } else if (node.is_number()) {
    const double number =
        node.is_integer() ? static_cast<double>(node.as_integer()->get()) : node.as_floating_point()->get();
    const std::string meant = with_unit(key, number);
    place.refuse("the bare number " + shortest(number) + " has no unit",
                 meant.starts_with('"') ? "write it with its unit, such as " + meant : meant);
  } else {
    place.refuse("wrong type: " + in_words(node), "write " + expectation(key));
  }
  check_range(place, si);
  return si;
}

std::int64_t integer_value(const Place& place, const toml::node& node) {
  const auto* number = node.as_integer();
  if (!number) place.refuse("wrong type: " + in_words(node), "write " + expectation(place.key));
  // Not as a double, which above 2^53 is another number.
  const std::int64_t value = number->get();
  const auto low = [&](double limit) {
    return limit <= -0x1p63 || value >= static_cast<std::int64_t>(std::ceil(limit));
  };
  const auto high = [&](double limit) {
    return limit >= 0x1p63 || value <= static_cast<std::int64_t>(std::floor(limit));
  };
  if (!low(place.key.low) || !high(place.key.high)) {
    place.refuse(std::to_string(value) + " is out of range", "allowed is " + range_text(place.key));
  }
  return value;
}

std::string text_value(const Place& place, const toml::node& node) {
  const auto* text = node.as_string();
  if (!text) {
    const bool number = node.is_number();
    place.refuse("wrong type: " + in_words(node), "write " + expectation(place.key) + (number ? " in quotes" : ""));
  }
  const auto& choices = place.key.choices;
  check_text(place, text->get(), choices.empty() ? place.key.form : Form::line);
  if (!choices.empty() && std::ranges::find(choices, text->get()) == choices.end()) {
    place.refuse("'" + text->get() + "' is not a choice", advice(text->get(), choices, "the choices are"));
  }
  return text->get();
}

/// "" is none.
std::vector<double> measured_value(const Place& place, const toml::node& node) {
  const Key& key = place.key;
  std::string said;
  if (const auto* text = node.as_string()) {
    check_text(place, text->get(), Form::line);
    said = text->get();
    if (said.empty()) return {};
  } else if (node.is_number() && key.unit.empty()) {
    said = shortest(bare_number(place, node));
  } else {
    place.refuse("wrong type: " + in_words(node), "write " + expectation(key));
  }
  Measured found;
  try {
    found = read_measured(said, key.unit, key.at_unit);
  } catch (const InputError& error) {
    place.refuse(error.wrong(), error.right());
  }
  check_range(place, found.value);
  return flat(found);
}

std::vector<double> measured_values(const Place& place, const toml::node& node) {
  std::vector<double> all;
  const auto* array = node.as_array();
  if (!array) {
    place.refuse("wrong type: " + in_words(node) + " where a list is needed",
                 "write " + expectation(place.key) + ", in square brackets");
  }
  for (std::size_t i = 0; i < array->size(); ++i) {
    Place at{place.key, place.where, place.shown + "[" + std::to_string(i) + "]"};
    for (const double number : measured_value(at, *array->get(i))) all.push_back(number);
  }
  return all;
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
    if (item.source().begin && place.where.line > 0) at.where = location(place.where.file, item.source());
    values.push_back(one(at, item));
  }
  return values;
}

}  // namespace

Location location(const std::string& file, const toml::source_region& source) {
  return {file, static_cast<int>(source.begin.line), static_cast<int>(source.begin.column)};
}

std::string excerpt(const std::string& text) {
  constexpr std::size_t most = 60;
  std::string shown;
  std::size_t letters = 0;
  for (std::string_view rest = text; !rest.empty(); ++letters) {
    if (letters == most) return shown + "...";
    const std::size_t bytes = first_character(rest).bytes;
    shown += printable(rest.substr(0, bytes));
    rest.remove_prefix(bytes);
  }
  return shown;
}

std::optional<bool> truth_of(std::string word) {
  std::ranges::transform(word, word.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  const auto is_one_of = [&](std::initializer_list<const char*> words) {
    return std::ranges::any_of(words, [&](const char* one) { return word == one; });
  };
  if (is_one_of({"true", "yes", "on", ".true."})) return true;
  if (is_one_of({"false", "no", "off", ".false."})) return false;
  return {};
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
    case KeyType::measured:
      return "a measured value such as " +
             (key.unit.empty() ? std::string("\"0.26 +- 0.02\"") : "\"210 " + key.unit + " +- 8\"") + range;
    case KeyType::measured_at:
      return "a list of measured values such as [\"320 " + key.unit + " +- 10 at 20 " + key.at_unit + "\"]" + range;
  }
  throw std::logic_error("a key type without a description");
}

Value convert(const Key& key, const toml::node& node, const Location& where, const std::string& shown) {
  const Place place{key, where, shown};
  switch (key.type) {
    case KeyType::boolean: {
      const auto* truth = node.as_boolean();
      if (!truth) {
        const std::optional<bool> meant = node.is_string() ? truth_of(node.as_string()->get()) : std::nullopt;
        place.refuse("wrong type: " + in_words(node), std::string("write ") +
                                                          (!meant   ? "true or false"
                                                           : *meant ? "true"
                                                                    : "false") +
                                                          ", without quotes");
      }
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
    case KeyType::measured:
      return measured_value(place, node);
    case KeyType::measured_at:
      return measured_values(place, node);
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
