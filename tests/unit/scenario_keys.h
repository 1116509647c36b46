#pragma once
// A small model for the tests of the scenario reader, and a file that it accepts.
#include <fstream>
#include <span>
#include <string>
#include <vector>

#include "engine/scenario/scenario.h"
#include "tests/support/scratch.h"

namespace test {

inline std::span<const dem::Key> keys_of(std::string_view model) {
  using dem::KeyType;
  static const std::vector<dem::Key> keys = {
      {.path = "specimen.diameter", .unit = "mm", .low = 1, .high = 500, .help = "of the cylinder"},
      {.path = "specimen.height", .unit = "mm", .low = 1, .high = 1000, .standard = "\"50 mm\"", .help = "along z"},
      {.path = "specimen.shape",
       .type = KeyType::text,
       .choices = {"cylinder", "prism"},
       .standard = "\"cylinder\"",
       .help = "of the vessel"},
      {.path = "specimen.ratio", .low = 1, .high = 10, .standard = "1.66", .help = "R_max / R_min"},
      {.path = "specimen.layers",
       .type = KeyType::integer,
       .low = 1,
       .high = 9,
       .standard = "3",
       .help = "of particles"},
      {.path = "specimen.periodic", .type = KeyType::boolean, .standard = "false", .help = "joins the sides"},
      {.path = "mineral[].name", .type = KeyType::text, .form = dem::Form::name, .help = "of the mineral"},
      {.path = "mineral[].share", .unit = "%", .low = 0, .high = 100, .help = "volume share"},
      {.path = "mineral[].cohesion", .unit = "MPa", .low = 0, .standard = "\"100 MPa\"", .help = "C"},
      {.path = "extra[].shape",
       .type = KeyType::text,
       .choices = {"cylinder", "prism"},
       .otherwise = "specimen.shape",
       .help = "of a specimen beside the sweep"},
      {.path = "extra[].height",
       .unit = "mm",
       .low = 1,
       .high = 1000,
       .otherwise = "specimen.height",
       .help = "of a specimen beside the sweep"},
      {.path = "length.cylinder", .unit = "mm", .low = 1, .high = 99, .standard = "\"10 mm\"", .help = "of cylinders"},
      {.path = "length.prism", .unit = "mm", .low = 1, .high = 99, .standard = "\"20 mm\"", .help = "of prisms"},
      {.path = "extra[].length",
       .unit = "mm",
       .low = 1,
       .high = 99,
       .otherwise = "length.{shape}",
       .help = "of a specimen beside the sweep"},
      {.path = "sweep.aspect_ratio", .type = KeyType::reals, .low = 1, .high = 10, .standard = "[1]", .help = "AR"},
      {.path = "sweep.dip",
       .type = KeyType::reals,
       .unit = "deg",
       .low = 0,
       .high = 90,
       .standard = "[\"90 deg\"]",
       .help = "of the long axis"},
      {.path = "sweep.mineral", .type = KeyType::texts, .form = dem::Form::name, .standard = "[]", .help = "alone"},
      {.path = "sweep.tests",
       .type = KeyType::texts,
       .choices = {"compression", "tension"},
       .standard = "[\"compression\"]",
       .help = "loadings"},
  };
  if (model != "rock") throw dem::InputError("unknown model '" + std::string(model) + "'", "the models are: rock");
  return keys;
}

inline const std::string good = R"(model = "rock"
title = "A study"

[specimen]
diameter = "25 mm"

[[mineral]]
name = "quartz"
share = "60 %"
[[mineral]]
name = "mica"
share = "40 %"
cohesion = "0.3 GPa"

[sweep]
aspect_ratio = [1, 2.5]

[scales.draft.specimen]
diameter = "12.5 mm"
[scales.paper]
)";

inline dem::Scenario read(const std::string& text, std::vector<std::string> overrides = {},
                          const std::string& scale = "paper") {
  const Scratch folder;
  const std::string file = folder / "study.toml";
  std::ofstream(file) << text;
  return dem::Scenario::read(file, scale, overrides, keys_of);
}

/// `text` with the first `from` replaced.
inline std::string changed(std::string text, const std::string& from, const std::string& to) {
  return text.replace(text.find(from), from.size(), to);
}

}  // namespace test
