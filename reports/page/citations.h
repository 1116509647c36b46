#pragma once
// What to cite, as a line of a reference list and as BibTeX, from one declaration (citations.json, assets/page/citation.json):
//   key, type ("article", "inproceedings", "book", "unpublished", "software"), authors ("Strack ODL": family, initials), title,
//   journal | booktitle | publisher, year, volume, number, pages ("47–65"), doi, note, for (what it is cited for)
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

namespace reports {

struct Citation {
  std::string key, type, title, venue, year, volume, number, pages, doi, reason;
  std::vector<std::string> authors;
  std::string version;  ///< of software
  std::string note;     ///< "a text without author or date"
};

/// Throws nlohmann::json::exception when a member that must be there is not.
Citation citation(const nlohmann::json& declared);

/// "Cundall PA, Strack ODL (1979). A discrete numerical model for granular assemblies. Géotechnique 29(1):47–65."
std::string reference(const Citation& cited);
/// An entry, ending in a line end. UTF-8, as BibTeX files are today.
std::string bibtex(const Citation& cited);

}  // namespace reports
