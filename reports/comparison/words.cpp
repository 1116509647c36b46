// The words of a page.
#include <algorithm>
#include <array>

#include "engine/core/text.h"
#include "reports/comparison/snapshot.h"

namespace comparison {
namespace {

/// Parts of the page that are compared as numbers, or that say how and from what the page was made.
constexpr std::array left_out = {"since-reference", "diagnostics", "results",  "published", "checks",
                                 "energy",          "again",       "scenario", "contents",  "what-was-run"};
constexpr std::array blocks = {"p",  "li", "tr",  "dt",      "dd",         "h1",      "h2",     "h3",     "h4",   "ul",
                               "ol", "dl", "div", "section", "figcaption", "caption", "header", "footer", "table"};

std::string attribute(std::string_view tag, std::string_view name) {
  const std::size_t at = tag.find(" " + std::string(name) + "=\"");
  if (at == std::string_view::npos) return {};
  const std::size_t from = at + name.size() + 3;
  return std::string(tag.substr(from, tag.find('"', from) - from));
}

std::string decoded(std::string_view text) {
  static const std::array<std::pair<std::string_view, std::string_view>, 7> entities = {{{"&amp;", "&"},
                                                                                         {"&lt;", "<"},
                                                                                         {"&gt;", ">"},
                                                                                         {"&quot;", "\""},
                                                                                         {"&#39;", "'"},
                                                                                         {"&#160;", " "},
                                                                                         {"&nbsp;", " "}}};
  std::string all;
  while (!text.empty()) {
    const auto known = std::ranges::find_if(entities, [&](const auto& e) { return text.starts_with(e.first); });
    if (known == entities.end()) {
      all += text.front();
      text.remove_prefix(1);
    } else {
      all += known->second;
      text.remove_prefix(known->first.size());
    }
  }
  return all;
}

bool is_digit(char32_t code) {
  const bool superscript = code == 0xb2 || code == 0xb3 || code == 0xb9 || (code >= 0x2070 && code <= 0x2079);
  return (code >= '0' && code <= '9') || superscript;
}
/// What may stand inside a number, before another digit: ".", ",", thin spaces, " × 10".
bool is_inside(char32_t code) {
  return code == '.' || code == ',' || code == 0x2009 || code == 0x202f || code == 0xa0 || code == 0x207b;
}
bool is_sign(char32_t code) { return code == 0x2212 || code == '+' || code == 0xb1; }

/// "−12.3 MPa and 3.2 × 10⁻⁵" -> "# MPa and #".
std::string without_numbers(const std::string& text) {
  std::string all;
  std::string waiting;  // inside a number, if a digit follows
  bool in_number = false;
  for (std::size_t i = 0; i < text.size();) {
    const std::string_view rest = std::string_view(text).substr(i);
    const dem::Character c = dem::first_character(rest);
    const std::string_view bytes = rest.substr(0, c.bytes);
    i += c.bytes;
    if (is_digit(c.code)) {
      if (!in_number) all += '#';
      in_number = true;
      waiting.clear();
    } else if (in_number && rest.starts_with(" × 10")) {
      i += std::string_view("× 10").size();
    } else if (in_number && is_inside(c.code)) {
      waiting += bytes;
    } else {
      all += waiting;
      waiting.clear();
      in_number = false;
      if (!is_sign(c.code)) all += bytes;
    }
  }
  return all + waiting;
}

/// One blank between words, none at the ends.
std::string squeezed(const std::string& text) {
  std::string all;
  for (const char c : text) {
    const bool blank = c == ' ' || c == '\n' || c == '\t' || c == '\r';
    if (!blank) all += c;
    if (blank && !all.empty() && all.back() != ' ') all += ' ';
  }
  while (!all.empty() && all.back() == ' ') all.pop_back();
  return all;
}

bool has_letter(std::string_view text) {
  return std::ranges::any_of(text, [](unsigned char c) { return (c | 32) >= 'a' && (c | 32) <= 'z'; });
}

class Reader {
 public:
  std::vector<Passage> read(std::string_view html) {
    const std::size_t body = html.find("<body");
    if (body != std::string_view::npos) html.remove_prefix(body);
    while (!html.empty()) {
      const std::size_t open = std::min(html.find('<'), html.size());
      if (!silent()) line_ += decoded(html.substr(0, open));
      html.remove_prefix(open);
      if (html.empty()) break;
      const std::size_t close = std::min(html.find('>'), html.size() - 1);
      tag(html.substr(0, close));
      html.remove_prefix(close + 1);
    }
    end_line();
    return std::move(passages_);
  }

 private:
  struct Open {
    std::string element, id;
    bool silent;
  };

  [[nodiscard]] bool silent() const { return !open_.empty() && open_.back().silent; }

  void tag(std::string_view text) {
    const bool closes = text.starts_with("</");
    text.remove_prefix(closes ? 2 : 1);
    const std::string name(text.substr(0, text.find_first_of(" \n/")));
    if (std::ranges::find(blocks, name) != blocks.end()) end_line();
    if (name == "td" || name == "th") line_ += " ";
    if (name == "img" && !silent()) {
      end_line();
      line_ = "[" + decoded(attribute(text, "alt")) + "]";
      end_line();
    }
    if (name != "section" && name != "nav" && name != "style" && name != "header" && name != "footer") return;
    if (closes) {
      if (!open_.empty()) open_.pop_back();
      return;
    }
    std::string id = attribute(text, "id");
    if (id.empty()) id = name == "section" && !open_.empty() ? open_.back().id : name == "nav" ? "contents" : name;
    const bool quiet =
        silent() || name == "style" || name == "nav" || std::ranges::find(left_out, id) != left_out.end();
    open_.push_back({name, id, quiet});
  }

  void end_line() {
    const std::string words = silent() ? "" : squeezed(without_numbers(line_));
    line_.clear();
    if (!has_letter(words)) return;
    const std::string section = open_.empty() ? "page" : open_.back().id;
    if (passages_.empty() || passages_.back().section != section) {
      const auto at = std::ranges::find(passages_, section, &Passage::section);
      if (at != passages_.end()) {
        at->lines.push_back(words);
        return;
      }
      passages_.push_back({section, {}});
    }
    passages_.back().lines.push_back(words);
  }

  std::vector<Open> open_;
  std::string line_;
  std::vector<Passage> passages_;
};

}  // namespace

std::vector<Passage> words_of(std::string_view html) { return Reader().read(html); }

}  // namespace comparison
