#pragma once
// One case: one specimen in one test. Its identity is its parameters; its id is a name for folders and is never read
// back. Its content is the text of everything that its record depends on, by what the keys declare (Key::affects).
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "engine/core/record.h"
#include "engine/scenario/scenario.h"

namespace dem {

struct Model;

struct CaseSpec {
  std::string id;         ///< "compression_ar_2"
  Scenario scenario;      ///< resolved, with the swept values of this case put in
  std::string content;    ///< canonical text of everything the result depends on, seed and physics version included
  Parameters parameters;  ///< "test" first
  int threads = 1;        ///< that serve it better than a case beside it serves the study (a case that fills the cache)
  std::vector<std::pair<std::string, std::string>> idle = {};  ///< keys that it does not use though it might: path, why

  [[nodiscard]] const std::string& test() const;  ///< the parameter "test"
};

/// A case of `model` in `scenario`. `kinds` are the words that decide which keys matter (Key::when): the test, and the
/// solver where there is a choice. `inputs` are lines for what lies outside the scenario, such as the hash of a file.
CaseSpec make_case(const Model& model, std::string id, Scenario scenario, Parameters parameters,
                   const std::vector<std::string>& kinds, std::string_view inputs = {});

/// The record that a case begins with: whose it is, and what its model declares.
Record new_record(const Model& model, const CaseSpec& spec);

/// The value that each declared parameter has in the scenario where no case says otherwise, in the parameter's unit; but for
/// the seed.
Parameters usual_values(std::span<const Parameter> declared, const Scenario& scenario);

/// Throws InputError when a list of a sweep names a value twice: it would make one case, and nobody would be told.
void refuse_repeated(const Scenario& scenario, std::string_view path, const std::vector<std::int64_t>& values);
void refuse_repeated(const Scenario& scenario, std::string_view path, const std::vector<double>& values);
void refuse_repeated(const Scenario& scenario, std::string_view path, const std::vector<std::string>& values);

/// The key `repeats` of a model whose specimens have a seed, and the seeds that it asks for: seed, seed + 1, ... Throws
/// InputError when the last of them is too large.
Key repeats_key();
std::vector<std::int64_t> seeds_of(const Scenario& scenario);
/// How their cases are told apart: nothing for the scenario's own, "_seed_2".
std::string seed_part(const Scenario& scenario, std::int64_t seed);

/// A value as part of an id, of a-z, 0-9 and _ alone, whatever the value: 1.5 is "1_5", -1 "m1", "Alkali feldspar"
/// "alkali_feldspar". The one place where values become names of folders and files.
std::string id_part(double value);
std::string id_part(std::string_view text);

}  // namespace dem
