#include "engine/texture/model.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>

#include "engine/core/archive.h"
#include "engine/texture/keys.h"
#include "engine/texture/loading.h"
#include "engine/texture/results.h"

namespace dem::texture {
namespace {

// Raised whenever results change.
constexpr std::string_view physics_version = "grain_texture 2";

// 1 -> "1", 1.5 -> "1_5", 0.675 -> "0_675"
std::string word(double value) {
  std::string text = fmt::format("{}", value);
  std::replace(text.begin(), text.end(), '.', '_');
  return text;
}

/// One specimen of the scenario.
struct Variant {
  double aspect_ratio = 1, seed_scale = 1;
  std::string growth;
  friend bool operator==(const Variant&, const Variant&) = default;
};

CaseSpec make_case(const Scenario& base, const std::string& test, const Variant& v) {
  CaseSpec spec{test + "_ar_" + word(v.aspect_ratio), base.with("texture.aspect_ratio", v.aspect_ratio), {}, {}};
  spec.scenario = spec.scenario.with("texture.seed_scale", v.seed_scale).with("texture.growth", v.growth);
  if (v.seed_scale != base.real("texture.seed_scale")) spec.id += "_seed_scale_" + word(v.seed_scale);
  if (v.growth != base.text("texture.growth")) spec.id += "_" + v.growth;
  const std::vector<std::string> prefixes = {"seed", "specimen.", "packing.", "mineral[", "interaction.",
                                             "texture.", "solver.", "measure.", test + "."};
  spec.content = fmt::format("model = grain_texture\nphysics = {}\ntest = {}\n{}", physics_version, test,
                             spec.scenario.canonical(prefixes));
  constexpr double degrees = 57.295779513082323;
  spec.parameters = {{"test", test},
                     {"aspect_ratio", v.aspect_ratio},
                     {"dip", std::round(spec.scenario.real("texture.dip") * degrees * 1e9) / 1e9},
                     {"seed_scale", v.seed_scale},
                     {"growth", v.growth}};
  return spec;
}

TestKind kind_of(const std::string& test) {
  return test == "compression" ? TestKind::compression : TestKind::direct_tension;
}

std::vector<CaseSpec> cases(const Scenario& scenario) {
  std::vector<Variant> variants;
  const auto add = [&](Variant v, const std::string& key) {
    if (std::find(variants.begin(), variants.end(), v) != variants.end()) {
      throw scenario.error(key, "the same specimen is asked for twice", "give each specimen once");
    }
    variants.push_back(std::move(v));
  };
  for (const double ar : scenario.reals("sweep.aspect_ratio")) {
    add({ar, scenario.real("texture.seed_scale"), scenario.text("texture.growth")}, "sweep.aspect_ratio");
  }
  for (std::size_t i = 0; i < scenario.count("extra"); ++i) {
    const auto key = [i](const char* name) { return fmt::format("extra[{}].{}", i, name); };
    add({scenario.real(key("aspect_ratio")), scenario.real(key("seed_scale")), scenario.text(key("growth"))},
        key("aspect_ratio"));
  }
  const std::vector<std::string>& tests = scenario.texts("tests");
  std::vector<CaseSpec> list;
  for (const std::string& test : tests) {
    if (std::count(tests.begin(), tests.end(), test) > 1) {
      throw scenario.error("tests", "'" + test + "' is named twice", "name each test once");
    }
    for (const Variant& v : variants) {
      list.push_back(make_case(scenario, test, v));
      (void)read_settings(list.back().scenario, kind_of(test));
    }
  }
  return list;
}

Record run(const CaseSpec& spec, RunContext& context) {
  const TestKind kind = kind_of(std::get<std::string>(spec.parameters.front().second));
  const Settings settings = read_settings(spec.scenario, kind);
  const Specimen specimen = make_specimen(settings, context);
  LoadingTest test(specimen, settings, context.threads);
  if (!context.checkpoint.empty()) {
    LoadingTest loaded = test;
    std::string bytes;
    if (load_checkpoint(context.checkpoint, spec.content, loaded).loaded) test = std::move(loaded);
  }
  using Clock = std::chrono::steady_clock;
  auto saved = Clock::now();
  const bool compression = kind == TestKind::compression;
  while (!test.ended()) {
    const bool stop = context.stop != nullptr && *context.stop;
    const bool due = std::chrono::duration<double>(Clock::now() - saved).count() > context.checkpoint_seconds;
    if ((stop || due) && !context.checkpoint.empty()) {
      save_checkpoint(context.checkpoint, spec.content, test);
      saved = Clock::now();
    }
    if (stop) throw Interrupted{};
    test.advance();
    const HistoryRow& row = test.history().back();
    context.report({compression ? "compression" : "direct tension", static_cast<std::int64_t>(row.step), test.fraction(),
                    row.platen_strain, row.axial_stress});
  }
  Record record = make_record(specimen, settings, test);
  record.model = "grain_texture";
  record.scenario = spec.scenario.name();
  record.case_id = spec.id;
  record.content = spec.content;
  record.physics_version = physics_version;
  record.seed = spec.scenario.seed();
  record.parameters = spec.parameters;
  return record;
}

}  // namespace

Model model() { return {"grain_texture", physics_version, &keys, &cases, &run}; }

}  // namespace dem::texture
