#include "reports/page/listing.h"

#include <algorithm>
#include <vector>

namespace reports {
namespace {

/// Characters, not bytes.
std::size_t length(std::string_view text) {
  return static_cast<std::size_t>(
      std::ranges::count_if(text, [](char c) { return (static_cast<unsigned char>(c) & 0xc0) != 0x80; }));
}

/// Words, each with the blanks before it.
std::vector<std::string_view> words_of(std::string_view text) {
  std::vector<std::string_view> words;
  while (!text.empty()) {
    const std::size_t word = std::min(text.find_first_not_of(' '), text.size());
    const std::size_t end = std::min(text.find(' ', word), text.size());
    words.push_back(text.substr(0, end));
    text.remove_prefix(end);
  }
  return words;
}

/// A line of TOML outside texts of several lines: where its comment begins, and after which bytes a list may be broken.
struct Line {
  std::size_t comment = std::string_view::npos;
  std::vector<std::size_t> commas;
  bool opens = false;  ///< a text of several lines, which the line does not close
  int lists = 0;       ///< how many are open behind it
};
Line read(std::string_view line, int lists) {
  Line found{.commas = {}, .lists = lists};
  int tables = 0;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const char c = line[i];
    if (c == '"' || c == '\'') {
      const std::string three(3, c);
      const bool many = line.substr(i).starts_with(three);
      std::size_t end = i + (many ? 3 : 1);
      while (end < line.size() && !(many ? line.substr(end).starts_with(three) : line[end] == c))
        end += c == '"' && line[end] == '\\' ? 2 : 1;
      if (many && end >= line.size()) {
        found.opens = true;
        return found;
      }
      i = end + (many ? 2 : 0);
    } else if (c == '#') {
      found.comment = i;
      return found;
    } else if (c == '[' || c == ']') {
      found.lists += c == '[' ? 1 : -1;
    } else if (c == '{' || c == '}') {
      tables += c == '{' ? 1 : -1;
    } else if (c == ',' && found.lists > 0 && tables == 0) {
      found.commas.push_back(i + 1);
    }
  }
  return found;
}

void add_line(std::string& out, std::string_view line) {
  out += line;
  out += '\n';
}

/// `first` holds what the comment stands behind.
void add_comment(std::string& out, std::string first, std::string_view comment, std::size_t width) {
  std::string line = std::move(first);
  bool begun = false;  // the line has a word of the comment
  for (std::string_view word : words_of(comment)) {
    if (word.find_first_not_of(' ') == std::string_view::npos) continue;  // blanks at the end of the line
    if (begun && word.starts_with("  ")) word.remove_prefix(word.find_first_not_of(' ') - 1);
    if (begun && length(line) + length(word) > width) {
      add_line(out, line);
      line = "#";
    } else if (!begun && length(line) + length(word) > width && line.find_first_not_of(' ') != std::string::npos) {
      add_line(out, line.substr(0, line.find_last_not_of(' ') + 1));
      line.clear();
    }
    line += word;
    // A lone "#" is no word to end a line behind.
    begun = begun || word.find_first_not_of("# ") != std::string_view::npos;
  }
  add_line(out, line);
}

/// `key = "text"`, by itself in its line: whether it was written, as a text of several lines.
bool add_text(std::string& out, std::string_view code, std::size_t width) {
  const std::size_t equals = code.find('=');
  const std::size_t from = equals == std::string_view::npos ? equals : code.find_first_not_of(' ', equals + 1);
  if (from == std::string_view::npos || code[from] != '"' || code.substr(from).starts_with("\"\"\"")) return false;
  if (code.back() != '"' || from + 1 >= code.size() - 1) return false;
  const std::string_view text = code.substr(from + 1, code.size() - from - 2);
  if (text.find('"') != std::string_view::npos || text.find(' ') == std::string_view::npos ||
      text.find("  ") != std::string_view::npos || text.front() == ' ')
    return false;
  std::string line = std::string(code.substr(0, from)) + "\"\"\"";
  bool begun = false;
  for (const std::string_view word : words_of(text)) {
    if (length(line) + length(word) + 2 > width) {
      // A blank before the backslash is text, the one that was there; what follows is text again from its first letter.
      add_line(out, line + (begun ? " \\" : "\\"));
      line = word.substr(std::min(word.find_first_not_of(' '), word.size()));
    } else {
      line += word;
    }
    begun = true;
  }
  add_line(out, line + "\"\"\"");
  return true;
}

void add_code(std::string& out, std::string_view code, const Line& line, std::size_t width) {
  if (length(code) <= width || (line.commas.empty() && add_text(out, code, width))) {
    if (length(code) <= width) add_line(out, code);
    return;
  }
  std::string shown;
  std::size_t begin = 0;
  const auto part = [&](std::size_t end) {
    std::string_view next = code.substr(begin, end - begin);
    begin = end;
    if (!shown.empty() && length(shown) + length(next) > width) {
      add_line(out, shown);
      next.remove_prefix(std::min(next.find_first_not_of(' '), next.size()));
      shown = "  ";
    }
    shown += next;
  };
  for (const std::size_t comma : line.commas) part(comma);
  part(code.size());
  add_line(out, shown);
}

}  // namespace

std::string listing(std::string_view text, std::size_t width) {
  std::string out;
  int lists = 0;
  bool inside = false;  // a text of several lines: as it is
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    std::string_view line = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    if (line.ends_with('\r')) line.remove_suffix(1);
    if (inside) {
      inside = line.find("\"\"\"") == std::string_view::npos && line.find("'''") == std::string_view::npos;
      add_line(out, line);
      continue;
    }
    std::string set;  // the lines of a list stand below each other, whether they were broken here or before
    if (const std::size_t word = line.find_first_not_of(' '); lists > 0 && word != std::string_view::npos && word > 2) {
      set = "  " + std::string(line.substr(word));
      line = set;
    }
    const Line found = read(line, lists);
    inside = found.opens;
    lists = found.lists;
    if (length(line) <= width || inside) {
      add_line(out, line);
    } else if (found.comment == std::string_view::npos) {
      add_code(out, line, found, width);
    } else {
      const std::string_view before = line.substr(0, found.comment), comment = line.substr(found.comment);
      const std::size_t used = before.find_last_not_of(' ');
      // The blanks that set comments below each other are for longer lines.
      const std::string code =
          used == std::string_view::npos ? std::string(before) : std::string(before.substr(0, used + 1)) + "  ";
      if (used == std::string_view::npos || length(code) + 12 <= width) {
        add_comment(out, code, comment, width);
      } else {
        add_code(out, before.substr(0, used + 1), found, width);
        add_comment(out, "", comment, width);
      }
    }
  }
  return out;
}

}  // namespace reports
