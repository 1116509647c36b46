#include "reports/page/typeset.h"

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

namespace reports {
namespace {

constexpr std::string_view no_break = "\u00a0";

bool is_digit(char c) { return c >= '0' && c <= '9'; }
bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }
bool is_wide(char c) { return (static_cast<unsigned char>(c) & 0x80) != 0; }
bool in_word(char c) { return is_letter(c) || is_digit(c) || c == '_' || is_wide(c); }

/// The character that ends at `end`, as many bytes as it has.
std::string_view before(std::string_view text, std::size_t end) {
  if (end == 0) return {};
  std::size_t begin = end - 1;
  while (begin > 0 && (static_cast<unsigned char>(text[begin]) & 0xc0) == 0x80) --begin;
  return text.substr(begin, end - begin);
}

bool is_symbol(std::string_view one) {  // a Latin or Greek letter
  if (one.size() == 1) return is_letter(one[0]);
  return one.size() == 2 && (one[0] == '\xce' || one[0] == '\xcf');
}

/// "ci" of "σ_ci" at the underscore; 0 where none follows: the length of what is an index.
std::size_t index_length(std::string_view after) {
  constexpr std::size_t most = 9;
  std::size_t n = 0;
  while (n < after.size() &&
         (in_word(after[n]) || (after[n] == ',' && n + 1 < after.size() && in_word(after[n + 1]))) && after[n] != '_') {
    ++n;
  }
  const bool of_file = n + 1 < after.size() && after[n] == '.' && is_letter(after[n + 1]);  // "a_b.toml"
  const bool ends = (n == after.size() || after[n] != '_') && !of_file;
  return ends && n <= most ? n : 0;
}

/// The letter or digit of an index that is written as a character of its own ("₃"); empty for any other.
std::string_view lowered(std::string_view rest) {
  constexpr std::array<std::pair<std::string_view, std::string_view>, 17> indices{{{"₀", "0"},
                                                                                   {"₁", "1"},
                                                                                   {"₂", "2"},
                                                                                   {"₃", "3"},
                                                                                   {"₄", "4"},
                                                                                   {"₅", "5"},
                                                                                   {"₆", "6"},
                                                                                   {"₇", "7"},
                                                                                   {"₈", "8"},
                                                                                   {"₉", "9"},
                                                                                   {"ₐ", "a"},
                                                                                   {"ₘ", "m"},
                                                                                   {"ₙ", "n"},
                                                                                   {"ₚ", "p"},
                                                                                   {"ₛ", "s"},
                                                                                   {"ᵢ", "i"},
                                                                                   {"ᵤ", "u"}}};
  const auto found = std::ranges::find_if(indices, [&](const auto& one) { return rest.starts_with(one.first); });
  return found == indices.end() ? std::string_view() : found->second;
}

std::string with_indices(std::string_view text) {
  constexpr std::array<std::string_view, 3> bare{"σci", "σcd", "σc"};  // as the papers write them in a line
  std::string out;
  for (std::size_t i = 0; i < text.size();) {
    const std::string_view rest = text.substr(i);
    const bool starts_word = i == 0 || !in_word(text[i - 1]);
    if (starts_word) {
      const auto known = std::ranges::find_if(bare, [&](std::string_view one) {
        return rest.starts_with(one) && (rest.size() == one.size() || !in_word(rest[one.size()]));
      });
      if (known != bare.end()) {
        out += "σ<sub>" + std::string(known->substr(2)) + "</sub>";
        i += known->size();
        continue;
      }
    }
    if (!lowered(rest).empty()) {
      std::string index;
      for (; !lowered(text.substr(i)).empty(); i += 3) index += lowered(text.substr(i));  // each has three bytes
      out += "<sub>" + index + "</sub>";
      continue;
    }
    const std::string_view symbol = before(text, i);
    const std::size_t start = i - symbol.size();
    if (text[i] == '_' && is_symbol(symbol) && (start == 0 || !in_word(text[start - 1]))) {
      if (rest.starts_with("_{") && rest.find('}') != std::string_view::npos) {
        const std::size_t end = rest.find('}');
        out += "<sub>" + std::string(rest.substr(2, end - 2)) + "</sub>";
        i += end + 1;
        continue;
      }
      if (const std::size_t n = index_length(rest.substr(1)); n > 0) {
        out += "<sub>" + std::string(rest.substr(1, n)) + "</sub>";
        i += 1 + n;
        continue;
      }
    }
    out += text[i++];
  }
  return out;
}

bool is_unit(std::string_view word) {
  constexpr std::array<std::string_view, 39> units{
      "%",   "m",   "mm",  "µm",   "nm",    "cm", "km", "mm²", "mm³", "m²",    "m³",   "Pa", "kPa",
      "MPa", "GPa", "N",   "kN",   "N/m",   "J",  "mJ", "µJ",  "kJ",  "kJ/m³", "J/m²", "s",  "ms",
      "µs",  "s⁻¹", "m/s", "mm/s", "kg/m³", "kg", "K",  "°C",  "rad", "MPa√m", "k",    "R",  "W"};
  while (!word.empty() && std::string_view(".,;:)?").find(word.back()) != std::string_view::npos) word.remove_suffix(1);
  return std::ranges::find(units, word) != units.end();
}

// What a number belongs to: "Fig. 14c", "AR 1", "σ₃ 10 MPa".
bool takes_number(std::string_view word) {
  constexpr std::array<std::string_view, 26> names{
      "Fig.", "Figs.", "Eq.", "Eqs.", "Table", "Tables", "Section", "section", "Sections",
      "AR",   "σ₃",    "σₙ",  "dip",  "m",     "M",      "b",       "≥",       "≤",
      "<",    "±",     "p",   "s",    "slope", "spread", "TS",      "UCS"};
  for (const std::string_view opening : {"(", "“"}) {
    if (word.starts_with(opening)) word.remove_prefix(opening.size());
  }
  return std::ranges::find(names, word) != names.end();
}

bool starts_number(std::string_view word) {
  if (word.starts_with("−") || word.starts_with("±")) word.remove_prefix(std::string_view("−").size());
  if (word.starts_with("(")) word.remove_prefix(1);
  return !word.empty() && is_digit(word[0]);
}

bool ends_number(std::string_view word) {
  if (word.empty()) return false;
  if (is_digit(word.back())) return true;
  constexpr std::array<std::string_view, 10> raised{"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
  return std::ranges::any_of(raised, [&](std::string_view one) { return word.ends_with(one); });
}

// Of a sign between two numbers or a symbol and its value.
bool binds(std::string_view word) { return word == "±" || word == "×" || word == "=" || word == "→"; }

/// "UCS/TS" and "1)/2" are not broken behind their stroke; a path is.
std::string whole_ratio(std::string_view word) {
  const std::size_t stroke = word.find('/'), dot = word.find('.', stroke);
  if (stroke == std::string_view::npos || stroke == 0 || stroke + 1 == word.size()) return std::string(word);
  if (word.find('_') != std::string_view::npos) return std::string(word);  // its indices are set later
  const bool path =
      word.find('/', stroke + 1) != std::string_view::npos || (dot != std::string_view::npos && dot + 1 < word.size());
  const char left = word[stroke - 1], right = word[stroke + 1];
  if (path || !(in_word(left) || left == ')') || !(is_letter(right) || is_digit(right))) return std::string(word);
  return std::string(word.substr(0, stroke + 1)) + "\u2060" + std::string(word.substr(stroke + 1));
}

std::string with_no_breaks(std::string_view text) {
  std::vector<std::string_view> parts;
  for (std::size_t begin = 0;;) {
    const std::size_t end = text.find(' ', begin);
    parts.push_back(text.substr(begin, end == std::string_view::npos ? end : end - begin));
    if (end == std::string_view::npos) break;
    begin = end + 1;
  }
  std::string out = whole_ratio(parts.front());
  for (std::size_t i = 1; i < parts.size(); ++i) {
    const std::string_view left = parts[i - 1], right = parts[i];
    const std::string_view next = i + 1 < parts.size() ? parts[i + 1] : std::string_view();
    if (ends_number(left) && right.starts_with("°") && !right.starts_with("°C")) {  // "5 °" is "5°"
      out += right;
      continue;
    }
    const bool list = !left.empty() && std::string_view(",;:").find(left.back()) != std::string_view::npos;
    const bool sign = binds(right) && right != "→" && starts_number(next) && !list;
    const bool after_sign = binds(left) && left != "→" && starts_number(right);
    const bool kept =
        (ends_number(left) && is_unit(right)) || (takes_number(left) && starts_number(right)) || sign || after_sign;
    out += kept ? no_break : std::string_view(" ");
    out += whole_ratio(right);
  }
  return out;
}

std::string with_apostrophes(std::string_view text) {
  std::string out;
  for (std::size_t i = 0; i < text.size();) {
    const std::string_view rest = text.substr(i);
    const std::string_view quote = rest.starts_with("&apos;") ? "&apos;" : rest.starts_with("'") ? "'" : "";
    if (!quote.empty() && i > 0 && (is_letter(text[i - 1]) || is_digit(text[i - 1]))) {
      out += "’";
      i += quote.size();
    } else {
      out += text[i++];
    }
  }
  return out;
}

std::string breaking_after_underscores(std::string_view text) {
  std::string out;
  for (const char c : text) {
    out += c;
    if (c == '_') out += "<wbr>";
  }
  return out;
}

/// Where the element named `name` that begins at `at` ends: behind its closing tag.
std::size_t end_of(std::string_view html, std::size_t at, std::string_view name) {
  const std::size_t end = html.find("</" + std::string(name), at);
  return end == std::string_view::npos ? html.size() : end;
}

}  // namespace

std::string typeset_text(std::string_view text) { return with_indices(with_no_breaks(with_apostrophes(text))); }

std::string typeset(std::string_view html) {
  constexpr std::array<std::string_view, 6> kept{"style", "script", "pre", "code", "title", "svg"};
  std::string out;
  out.reserve(html.size() + html.size() / 64);
  bool id = false;  // the text of an element of the class "id" comes next
  for (std::size_t at = 0; at < html.size();) {
    const std::size_t tag = std::min(html.find('<', at), html.size());
    const std::string_view text = html.substr(at, tag - at);
    out += id ? breaking_after_underscores(text) : typeset_text(text);
    if (tag == html.size()) break;
    const std::size_t end = std::min(html.find('>', tag), html.size() - 1);
    const std::string_view whole = html.substr(tag, end + 1 - tag);
    out += whole;
    at = end + 1;
    id = whole.find("class=\"id\"") != std::string_view::npos;
    const std::string_view name = whole.substr(1, whole.find_first_of(" >") - 1);
    if (std::ranges::find(kept, name) != kept.end()) {
      const std::size_t inside = end_of(html, at, name);
      out += html.substr(at, inside - at);
      at = inside;
      id = false;
    }
  }
  return out;
}

}  // namespace reports
