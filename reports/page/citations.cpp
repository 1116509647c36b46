#include "reports/page/citations.h"

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>

#include "reports/text.h"

namespace reports {
namespace {

/// The field that says where it appeared.
std::string_view venue_field(std::string_view type) {
  if (type == "inproceedings") return "booktitle";
  return type == "book" ? "publisher" : "journal";
}

/// "Strack ODL" -> "Strack, O. D. L."; a name without initials is one word to BibTeX: "{The dem-report authors}".
std::string bibtex_name(const std::string& name) {
  const std::size_t blank = name.rfind(' ');
  const std::string initials = blank == std::string::npos ? "" : name.substr(blank + 1);
  if (initials.empty() || !std::ranges::all_of(initials, [](char c) { return c >= 'A' && c <= 'Z'; })) {
    return "{" + name + "}";
  }
  std::string text = name.substr(0, blank) + ",";
  for (const char c : initials) text += std::string(" ") + c + ".";
  return text;
}

/// What LaTeX would read otherwise.
std::string for_latex(std::string_view text) {
  constexpr std::string_view dash = "–";
  std::string escaped;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text.substr(i).starts_with(dash)) {
      escaped += "--";
      i += dash.size() - 1;
      continue;
    }
    if (std::string_view("&%$#_").find(text[i]) != std::string_view::npos) escaped += '\\';
    escaped += text[i];
  }
  return escaped;
}

}  // namespace

Citation citation(const nlohmann::json& declared) {
  const auto optional = [&](const std::string& name) { return declared.value(name, std::string()); };
  Citation cited{.key = declared.at("key"),
                 .type = declared.at("type"),
                 .title = declared.at("title"),
                 .venue = {},
                 .year = optional("year"),
                 .volume = optional("volume"),
                 .number = optional("number"),
                 .pages = optional("pages"),
                 .doi = optional("doi"),
                 .reason = declared.at("for"),
                 .authors = declared.at("authors"),
                 .version = {},
                 .note = optional("note")};
  if (cited.type != "software" && cited.type != "unpublished")
    cited.venue = declared.at(std::string(venue_field(cited.type)));
  return cited;
}

std::string reference(const Citation& cited) {
  std::string text = cited.authors.empty() ? "" : joined(cited.authors, ", ") + " (" + cited.year + "). ";
  text += cited.title;
  if (!cited.note.empty()) text += "; " + cited.note;
  if (!cited.version.empty()) text += ", version " + cited.version;
  if (!cited.venue.empty()) text += ". " + cited.venue;
  if (!cited.volume.empty()) text += " " + cited.volume;
  if (!cited.number.empty()) text += "(" + cited.number + ")";
  if (!cited.pages.empty()) text += ":" + cited.pages;
  return text + ".";
}

std::string bibtex(const Citation& cited) {
  std::vector<std::string> authors;
  for (const std::string& name : cited.authors) authors.push_back(bibtex_name(name));
  const std::string note = cited.version.empty() ? cited.note : "Version " + cited.version;
  const std::array<std::pair<std::string_view, std::string>, 8> fields{
      {{"title", "{" + for_latex(cited.title) + "}"},
       {venue_field(cited.type), for_latex(cited.venue)},
       {"year", cited.year},
       {"volume", cited.volume},
       {"number", cited.number},
       {"pages", for_latex(cited.pages)},
       {"doi", cited.doi},
       {"note", note}}};
  // Every BibTeX knows "misc"; "software" is known to some.
  std::string text = "@" + (cited.type == "software" ? std::string("misc") : cited.type) + "{" + cited.key + ",\n";
  if (!authors.empty()) text += "  author = {" + joined(authors, " and ") + "},\n";
  std::string rest;
  for (const auto& [name, value] : fields) {
    if (!value.empty()) rest += (rest.empty() ? "  " : ",\n  ") + std::string(name) + " = {" + value + "}";
  }
  return text + rest + "\n}\n";
}

}  // namespace reports
