#pragma once
// The papers that the program mirrors: a folder each in assets/papers with
//   paper.json      {"model", "paper": how it is cited, "scale": of its numbers, "rock": the one that it is about, if it names one}
//   published.json  its numbers (reports/published/published.h); may be missing
//   choices.json, citations.json  what the report says of the model's choices and sources; those with "rock" are about
//                   the paper's rock and left out for others
#include <filesystem>
#include <string>
#include <vector>

#include "engine/scenario/scenario.h"

namespace reports {

struct Paper {
  std::filesystem::path folder;
  std::string model, name, scale, rock;
};

/// The papers of a model, by folder name. Throws dem::EnvironmentError naming a file that cannot be read.
std::vector<Paper> papers_of(const std::string& model, const std::filesystem::path& papers);

/// Whether one of them is about what the scenario studies: no paper names a rock, or one names the scenario's (key `rock`).
bool of_a_paper(const dem::Scenario& scenario, const std::filesystem::path& papers);

/// Throws dem::InputError when the scenario's key `published` names a topic that no paper of its model has.
void check_topics(const dem::Scenario& scenario, const std::filesystem::path& papers);

}  // namespace reports
