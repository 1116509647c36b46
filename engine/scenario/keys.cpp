// The keys that every scenario has, and the text of --explain-keys.
#include <algorithm>
#include <cmath>

#include "engine/scenario/scenario.h"
#include "engine/scenario/suggest.h"
#include "engine/scenario/units.h"

namespace dem {
namespace {

std::string type_text(const Key& key) {
  switch (key.type) {
    case KeyType::boolean:
      return "true or false";
    case KeyType::integer:
      return "whole number";
    case KeyType::real:
      return key.unit.empty() ? "number" : "quantity in " + units_like(key.unit);
    case KeyType::text:
      return "text";
    case KeyType::integers:
      return "list of whole numbers";
    case KeyType::reals:
      return key.unit.empty() ? "list of numbers" : "list of quantities in " + units_like(key.unit);
    case KeyType::texts:
      return "list of texts";
    case KeyType::measured:
      return key.unit.empty() ? "measured number" : "measured quantity in " + units_like(key.unit);
    case KeyType::measured_at:
      return "list of measured quantities in " + units_like(key.unit) + ", each at one in " + units_like(key.at_unit);
  }
  return {};
}

std::string limit_text(const Key& key) {
  const std::string unit = key.unit.empty() ? "" : " " + key.unit;
  const bool low = std::isfinite(key.low);
  const bool high = std::isfinite(key.high);
  if (low && high) return shortest(key.low) + " to " + shortest(key.high) + unit;
  if (low) return shortest(key.low) + unit + " or more";
  if (high) return shortest(key.high) + unit + " or less";
  return key.choices.empty() ? "" : "one of " + joined(key.choices);
}

}  // namespace

std::span<const Key> common_keys() {
  static const std::vector<Key> keys = {
      {.path = "model", .type = KeyType::text, .affects = Affects::cases, .help = "the model that simulates the cases"},
      {.path = "include",
       .type = KeyType::text,
       .form = Form::path,
       .standard = "\"\"",
       .affects = Affects::cases,
       .help = "a file of keys to start from, such as a rock; this file's keys and lists go over them"},
      {.path = "title",
       .type = KeyType::text,
       .standard = "\"\"",
       .affects = Affects::drawing,
       .help = "title of the report, up to 200 characters"},
      {.path = "description",
       .type = KeyType::text,
       .form = Form::paragraph,
       .standard = "\"\"",
       .affects = Affects::drawing,
       .help = "what the study shows, a paragraph at the head of the report, up to 5000 characters"},
      {.path = "seed",
       .type = KeyType::integer,
       .low = 0,
       .high = static_cast<double>(largest_seed),
       .standard = "1",
       .affects = Affects::specimen,
       .help = "of all random numbers; another seed is another specimen"},
      {.path = "figures",
       .type = KeyType::texts,
       .standard = "[]",
       .affects = Affects::drawing,
       .help =
           "ids of the figures to draw (see --list-figures); empty: those of the model that have something to draw"},
      {.path = "published",
       .type = KeyType::texts,
       .standard = "[]",
       .affects = Affects::drawing,
       .help = "topics of the paper whose numbers stand beside ours (assets/papers); empty: every number that the "
               "cases can "
               "be compared with"},
  };
  return keys;
}

std::string explain(std::span<const Key> keys) {
  std::string text;
  std::string table;
  for (const Key& key : keys) {
    const std::size_t dot = key.path.rfind('.');
    const std::string here = dot == std::string::npos ? "" : key.path.substr(0, dot);
    if (here != table) {
      table = here;
      const bool list = table.ends_with("[]");
      text += "\n" + (list ? "[[" + table.substr(0, table.size() - 2) + "]]" : "[" + table + "]") + "\n";
    }
    text += "  " + key.path.substr(dot == std::string::npos ? 0 : dot + 1) + ": " + type_text(key);
    if (const std::string limit = limit_text(key); !limit.empty()) text += ", " + limit;
    text += !key.otherwise.empty() ? ", default that of " + key.otherwise
            : key.standard.empty() ? ", required"
                                   : ", default " + key.standard;
    text += "\n      " + key.help + "\n";
  }
  return text;
}

}  // namespace dem
