#include "reports/calibration/trials.h"

#include <algorithm>
#include <cmath>

#include "engine/core/hash.h"

namespace calibrate {
namespace {

// Bonds that no test breaks, and the strain to which it is then followed (platen strain).
constexpr double unbreakable = 1e11, elastic_strain = 2e-3;

}  // namespace

double Reading::value(std::string_view result) const {
  if (!results) return std::nan("");
  const auto at = results->find(result);
  return at == results->end() ? std::nan("") : at->second;
}

Trials::Trials(const dem::Study& study, const dem::StudyOptions& options, dem::StudyListener listener,
               std::function<void(int)> starting)
    : study_(study), options_(options), listener_(std::move(listener)), starting_(std::move(starting)) {}

dem::CaseSpec Trials::case_of(const Wish& wish) const {
  dem::Scenario s = study_.scenario;
  for (const auto& [key, value] : wish.values) s = s.with(key, value);
  if (wish.test.is_elastic) {
    for (std::size_t i = 0; i < s.count("mineral"); ++i) {
      const std::string entry = "mineral[" + std::to_string(i) + "].";
      s = s.with(entry + "tensile_strength", unbreakable).with(entry + "cohesion", unbreakable);
    }
    s = s.with("compression.largest_strain", elastic_strain);
  }
  s = s.with("tests", std::vector<std::string>{wish.test.name})
          .with("repeats", std::int64_t{1})
          .with("seed", static_cast<std::int64_t>(wish.seed))
          .with("sweep.aspect_ratio", std::vector<double>{s.real("texture.aspect_ratio")})
          .with("sweep.dip", std::vector<double>{s.real("texture.dip")})
          .with("sweep.confining_pressure", std::vector<double>{1e6 * wish.test.pressure})
          .with("sweep.jaw_ratio", std::vector<double>{s.real("brazilian.jaw_ratio")})
          .with("sweep.mineral", std::vector<std::string>{wish.mineral})
          .with("sweep.raised", std::vector<std::string>{});
  dem::CaseSpec spec = study_.model->cases(s).front();
  spec.id = "trial_" + dem::sha256(spec.content).substr(0, 20);
  return spec;
}

std::vector<Reading> Trials::run(const std::vector<Wish>& wishes) {
  dem::Study asked{study_.scenario, study_.model, {}, {}};
  std::vector<std::string> contents;
  for (const Wish& wish : wishes) {
    dem::CaseSpec spec = case_of(wish);
    contents.push_back(spec.content);
    const bool there = std::ranges::find(asked.cases, spec.id, &dem::CaseSpec::id) != asked.cases.end();
    if (!there && !known_.contains(spec.content)) asked.cases.push_back(std::move(spec));
  }
  if (!asked.cases.empty()) {
    starting_(static_cast<int>(asked.cases.size()));
    const std::vector<dem::CaseOutcome> outcomes = dem::run_study(asked, options_, listener_);
    for (std::size_t i = 0; i < outcomes.size(); ++i) {
      const dem::CaseOutcome& outcome = outcomes[i];
      ++tests_;
      if (outcome.state == dem::CaseState::simulated) ++simulated_;
      seconds_ += outcome.seconds;
      Reading reading;
      reading.error = outcome.error;
      if (outcome.record) {
        reading.results.emplace(outcome.record->results.begin(), outcome.record->results.end());
        for (const dem::Check& check : outcome.record->checks) {
          if (!check.held) reading.broken.push_back(check.id);
        }
        for (const std::string& note : outcome.record->notes) {
          if (note.starts_with("No strength")) reading.error = note;
        }
        if (const double steps = reading.value("steps"); std::isfinite(steps)) steps_ += steps;
      }
      known_[asked.cases[i].content] = std::move(reading);
    }
  }
  std::vector<Reading> readings;
  for (const std::string& content : contents) readings.push_back(known_.at(content));
  return readings;
}

}  // namespace calibrate
