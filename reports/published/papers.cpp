#include "reports/published/papers.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>

#include "engine/core/errors.h"
#include "engine/core/files.h"
#include "engine/scenario/suggest.h"

namespace reports {
namespace {

using Json = nlohmann::json;

// The rock of a scenario; "" for models without one.
std::string rock_of(const dem::Scenario& scenario) { return scenario.declares("rock") ? scenario.text("rock") : ""; }

}  // namespace

std::vector<Paper> papers_of(const std::string& model, const std::filesystem::path& papers) {
  std::vector<Paper> found;
  std::error_code error;
  for (std::filesystem::directory_iterator at(papers, error), end; !error && at != end; at.increment(error)) {
    const std::filesystem::path file = at->path() / "paper.json";
    if (!std::filesystem::exists(file)) continue;
    try {
      const Json json = Json::parse(dem::read_file(file));
      Paper paper{at->path(), json.at("model").get<std::string>(), json.at("paper").get<std::string>(),
                  json.value("scale", "paper"), json.value("rock", "")};
      if (paper.model == model) found.push_back(std::move(paper));
    } catch (const Json::exception& broken) {
      throw dem::EnvironmentError("papers/" + at->path().filename().string() +
                                  "/paper.json cannot be read: " + broken.what());
    }
  }
  std::ranges::sort(found, {}, &Paper::folder);
  return found;
}

bool of_a_paper(const dem::Scenario& scenario, const std::filesystem::path& papers) {
  const std::vector<Paper> known = papers_of(scenario.model(), papers);
  return std::ranges::all_of(known, [](const Paper& p) { return p.rock.empty(); }) ||
         std::ranges::any_of(known, [&](const Paper& p) { return !p.rock.empty() && p.rock == rock_of(scenario); });
}

void check_topics(const dem::Scenario& scenario, const std::filesystem::path& papers) {
  const std::vector<std::string>& asked = scenario.texts("published");
  if (asked.empty()) return;
  std::set<std::string> topics;
  for (const Paper& paper : papers_of(scenario.model(), papers)) {
    const std::filesystem::path file = paper.folder / "published.json";
    if (!std::filesystem::exists(file)) continue;
    const Json json = Json::parse(dem::read_file(file), nullptr, false);
    if (json.is_discarded()) continue;  // said when it is read for its numbers
    for (const Json& entry : json.value("numbers", Json::array())) {
      for (const Json& topic : entry.value("topics", Json::array())) topics.insert(topic.get<std::string>());
    }
  }
  const std::vector<std::string> known(topics.begin(), topics.end());
  for (const std::string& topic : asked) {
    if (topics.contains(topic)) continue;
    throw scenario.error("published", "there is no topic '" + topic + "'",
                         known.empty() ? "no published numbers are kept for this model: leave the key out"
                                       : dem::advice(topic, known, "the topics are"));
  }
}

}  // namespace reports
