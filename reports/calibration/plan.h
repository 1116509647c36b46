#pragma once
// What is calibrated: minerals that have measured values of their own, each alone, then the rock; with the parameters that may
// move, the values that are aimed at, and the stages of the search. Errors in the input are found here, before anything runs.
#include <string>
#include <string_view>
#include <vector>

#include "engine/calibration/identify.h"
#include "engine/scenario/scenario.h"
#include "engine/texture/micro_parameters.h"
#include "reports/published/laboratory.h"

namespace calibrate {

/// A parameter that may move.
struct Parameter : dem::texture::MicroParameter {
  bool is_chosen = false;  ///< by the user
};

/// A measured value that is aimed at, in the coordinate of the search: the logarithm, but of Poisson's ratio.
struct Target {
  reports::LaboratoryNumber number;
  [[nodiscard]] bool is_logarithmic() const { return number.key != "poisson_ratio"; }
  [[nodiscard]] bool is_confined() const { return number.pressure > 0 || !number.fit.empty(); }
  [[nodiscard]] double to_search(double value) const;
  [[nodiscard]] double from_search(double value) const;
  [[nodiscard]] double laboratory_deviation() const;  ///< in the coordinate of the search
  [[nodiscard]] std::string name() const { return reports::laboratory_name(number); }
  [[nodiscard]] std::string symbol() const;
};

/// One test of one specimen.
struct Test {
  std::string name;         ///< "compression"
  double pressure = 0;      ///< MPa
  bool is_elastic = false;  ///< on bonds that do not break, to a small strain
  bool operator==(const Test&) const = default;
};

/// A part of the search: its parameters and targets by their places in the subject. Those of earlier stages stay free.
struct Stage {
  std::string id;  ///< "elastic", "strengths", "boundaries", "confined"
  std::vector<std::size_t> parameters, targets;
  std::vector<Test> tests;
};

/// A mineral alone, or the rock.
struct Subject {
  std::string mineral;                ///< "": the rock
  std::vector<Parameter> candidates;  ///< in the order in which they matter
  std::vector<Target> targets;
  dem::calibration::Identified known;  ///< of the candidates, by what is known before anything has run
  std::vector<std::size_t> moved;      ///< candidates that are searched for
  std::vector<Stage> stages;           ///< parameters by their places in `moved`
  std::vector<double> pressures;       ///< of the tests by which m is fitted, MPa; 0 is one of them
  std::vector<std::string> notes;      ///< targets that no test of this program gives
  int budget = 40;                     ///< tests

  [[nodiscard]] std::string title() const { return mineral.empty() ? "the rock" : mineral; }
};

struct Plan {
  std::vector<Subject> subjects;  ///< minerals first
  int seeds = 5;                  ///< fresh ones, to begin with
};

/// A direction whose standard deviation is above this (in logarithms: half to double at 95 %) is not determined.
constexpr double undetermined = 0.35;

/// Throws dem::InputError for targets that contradict each other, parameters and ranges that mean nothing, more parameters
/// than measured values.
Plan make_plan(const dem::Scenario& scenario, std::span<const dem::Measurable> measurables,
               std::span<const dem::Quantity> quantities);

/// Derivatives of targets by candidates before anything has run, over nothing or over the targets' deviations.
Eigen::MatrixXd known_derivatives(const Subject& subject, const std::vector<Parameter>& parameters);
double expected_deviation(const Target& target, int seeds);

/// "E", "TS": of the values in words.
std::string symbols(const Subject& subject, const std::vector<std::size_t>& targets);

}  // namespace calibrate
