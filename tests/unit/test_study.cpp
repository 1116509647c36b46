// The runner, with a model that counts instead of simulating.
#include <doctest/doctest.h>

#include <algorithm>
#include <chrono>
#include <fstream>
#include <map>
#include <mutex>
#include <sstream>
#include <thread>
#include <tuple>

#include "engine/core/archive.h"
#include "engine/core/errors.h"
#include "engine/core/files.h"
#include "engine/store/store.h"
#include "engine/study/progress.h"
#include "engine/study/study.h"
#include "tests/support/scratch.h"

namespace {

namespace fs = std::filesystem;
using dem::CaseState;

std::span<const dem::Key> counter_keys() {
  static const std::vector<dem::Key> keys = {
      {.path = "load.stress",
       .unit = "MPa",
       .low = 0,
       .high = 1000,
       .standard = "\"100 MPa\"",
       .affects = dem::Affects::test,
       .help = "of the test"},
      {.path = "load.steps",
       .type = dem::KeyType::integer,
       .low = 1,
       .standard = "10",
       .affects = dem::Affects::test,
       .help = "to count"},
      {.path = "load.fails_at",
       .type = dem::KeyType::integer,
       .standard = "-1",
       .affects = dem::Affects::test,
       .help = "value whose case fails"},
      {.path = "load.breaks_at",
       .type = dem::KeyType::integer,
       .standard = "-1",
       .affects = dem::Affects::test,
       .help = "value whose case meets a full disk"},
      {.path = "load.value", .standard = "0", .affects = dem::Affects::test, .help = "of a case"},
      {.path = "sweep.value",
       .type = dem::KeyType::reals,
       .standard = "[1, 2, 3]",
       .affects = dem::Affects::cases,
       .help = "one case each"},
  };
  return keys;
}

int threads_asked = 1;  ///< by each case

constexpr dem::Quantity sum{.id = "sum", .name = "Sum"};
std::span<const dem::Quantity> counter_quantities() { return {&sum, 1}; }
std::span<const dem::Parameter> counter_parameters() {
  static constexpr dem::Parameter value{.id = "value", .name = "Value", .key = "load.value"};
  return {&value, 1};
}

template <int version>
dem::Model counter();

template <int version>
std::vector<dem::CaseSpec> counter_cases(const dem::Scenario& scenario) {
  std::vector<dem::CaseSpec> cases;
  for (const double value : scenario.reals("sweep.value")) {
    cases.push_back(dem::make_case(counter<version>(), "count_" + dem::id_part(value),
                                   scenario.with("load.value", value), {{"test", "count"}, {"value", value}},
                                   {"count"}));
    cases.back().threads = threads_asked;
  }
  return cases;
}

struct Counter {
  std::int64_t step = 0;
  double sum = 0;
  template <class Archive>
  void archive(Archive& a) {
    a(step, sum);
  }
};

/// Asks itself to stop at a step, as a signal would.
std::atomic<bool> stop = false;
std::int64_t stop_at = -1;

/// What the cases were seen to do.
struct Seen {
  std::mutex mutex;
  std::map<std::string, std::int64_t> first_step;  ///< at which a case began or went on
  std::map<std::string, int> threads;              ///< that it was lent
  int inside = 0, most_inside = 0;                 ///< cases that run at a time
};
Seen seen;
int meet = 1;   ///< a case goes on only when so many have begun
int grows = 0;  ///< count_1 goes on only when it is lent so many threads

/// A case waits until so many have begun together, or a while in vain.
bool met() {
  for (int i = 0; i < 10000; ++i) {
    {
      const std::lock_guard lock(seen.mutex);
      if (seen.most_inside >= meet) return true;
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  return false;
}

class Inside {
 public:
  Inside(const std::string& id, std::int64_t first_step, int threads) {
    const std::lock_guard lock(seen.mutex);
    seen.first_step[id] = first_step;
    seen.threads[id] = threads;
    seen.most_inside = std::max(seen.most_inside, ++seen.inside);
  }
  Inside(const Inside&) = delete;
  Inside& operator=(const Inside&) = delete;
  ~Inside() {
    const std::lock_guard lock(seen.mutex);
    --seen.inside;
  }
};

dem::Record counter_run(const dem::CaseSpec& spec, dem::RunContext& context) {
  const double value = spec.scenario.real("load.value");
  Counter state;
  dem::load_checkpoint(context.checkpoint, spec.content, state);
  const Inside inside(spec.id, state.step, context.threads);
  if (!met()) throw std::runtime_error("the cases did not run side by side");
  for (int i = 0; value == 1 && context.threads_now() < grows; ++i) {
    if (i == 10000) throw std::runtime_error("it was lent no more threads");
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  if (value == spec.scenario.real("load.fails_at")) throw dem::CaseError("the counter cannot be packed");
  const double breaks_at = spec.scenario.real("load.breaks_at");
  if (value == breaks_at) throw dem::EnvironmentError("the disk is full");
  const std::int64_t steps = spec.scenario.integer("load.steps");
  for (; state.step < steps; ++state.step) {
    if (state.step == stop_at) stop = true;
    // Beside a case that breaks, the others are still at work when it does.
    for (int i = 0; breaks_at >= 0 && state.step == 5 && i < 10000 && !context.stopped(); ++i) {
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    if (context.stopped()) {
      dem::save_checkpoint(context.checkpoint, spec.content, state);
      throw dem::Interrupted{};
    }
    state.sum += value / static_cast<double>(state.step + 1);
    context.report({"counting", state.step, static_cast<double>(state.step) / static_cast<double>(steps), 0, 0});
  }
  dem::Record record = dem::new_record(counter<1>(), spec);
  record.put(sum, state.sum);
  record.checks = {{"counted", 0, 1, true, "It counts."}};
  return record;
}

template <int version>
dem::Model counter() {
  static const std::string text = std::to_string(version);
  return {"counter", text, counter_keys, counter_quantities, counter_parameters, counter_cases<version>, counter_run};
}

template <int version>
std::vector<dem::Model> models_of_version() {
  return {counter<version>()};
}

/// A folder with a scenario, and what a run of it told.
struct Bench {
  test::Scratch folder;
  std::vector<dem::Model> models = models_of_version<1>();
  dem::StudyOptions options;
  std::map<std::string, std::string> why;  ///< of the cases that were simulated
  std::vector<std::string> notes;

  Bench() {
    stop = false;
    stop_at = -1;
    meet = 1;
    grows = 0;
    threads_asked = 1;
    options.output = folder / "out";
    options.stop = &stop;
    std::ofstream(folder / "study.toml") << "model = \"counter\"\n[scales.draft]\n";
  }

  std::vector<dem::CaseOutcome> run(const std::vector<std::string>& overrides = {}) {
    why.clear();
    notes.clear();
    seen.first_step.clear();
    seen.threads.clear();
    seen.inside = seen.most_inside = 0;
    const dem::Study study = dem::read_study(folder / "study.toml", "draft", overrides, models);
    dem::StudyListener listener;
    listener.begin = [&](const std::string& id, int, int, const std::string& reason) { why[id] = reason; };
    listener.note = [&](const std::string& note) { notes.push_back(note); };
    return dem::run_study(study, options, listener);
  }

  [[nodiscard]] fs::path record(const std::string& id) const {
    return folder.path() / "out/study.draft/cases" / id / "results.h5";
  }
};

std::vector<CaseState> states(const std::vector<dem::CaseOutcome>& outcomes) {
  std::vector<CaseState> all;
  for (const dem::CaseOutcome& outcome : outcomes) all.push_back(outcome.state);
  return all;
}

constexpr auto kept = CaseState::kept;
constexpr auto simulated = CaseState::simulated;

}  // namespace

TEST_CASE("a finished case is kept; a second call simulates nothing") {
  Bench bench;
  const auto first = bench.run();
  CHECK(states(first) == std::vector{simulated, simulated, simulated});
  CHECK(bench.why.at("count_1") == "no record yet");
  const std::string bytes = dem::read_file(bench.record("count_2"));
  const auto second = bench.run();
  CHECK(states(second) == std::vector{kept, kept, kept});
  CHECK(second.at(1).record->value(sum) == first.at(1).record->value(sum));
  CHECK(dem::read_file(bench.record("count_2")) == bytes);
}

TEST_CASE("the runner puts what it knows into the record") {
  Bench bench;
  bench.run({"seed=5"});
  const dem::Record record = dem::read_record(bench.record("count_3"));
  CHECK(record.model == "counter");
  CHECK(record.scenario == "study");
  CHECK(record.case_id == "count_3");
  CHECK(record.physics_version == "1");
  CHECK(record.seed == 5);
  CHECK(record.number("value") == 3);
  CHECK(record.content.find("load.steps = 10\n") != std::string::npos);
}

TEST_CASE("what changed is simulated again, and said in the declared unit") {
  Bench bench;
  bench.run();
  SUBCASE("the seed") {
    bench.run({"seed=2"});
    CHECK(bench.why.size() == 3);
    CHECK(bench.why.at("count_1") == "seed: 1 -> 2");
  }
  SUBCASE("a quantity") {
    bench.run({"load.stress=\"0.3 GPa\""});
    CHECK(bench.why.at("count_3") == "load.stress: 100 MPa -> 300 MPa");
  }
  SUBCASE("two keys") {
    bench.run({"load.stress=\"50 MPa\"", "load.steps=11"});
    CHECK(bench.why.at("count_3") == "load.steps: 10 -> 11, load.stress: 100 MPa -> 50 MPa");
  }
  SUBCASE("the version of the physics") {
    bench.models = models_of_version<2>();
    bench.run();
    CHECK(bench.why.at("count_1") == "physics version: 1 -> 2");
  }
  SUBCASE("a sweep that grows: only the new case") {
    CHECK(states(bench.run({"sweep.value=[1, 2, 3, 4]"})) == std::vector{kept, kept, kept, simulated});
    CHECK(bench.why == std::map<std::string, std::string>{{"count_4", "no record yet"}});
  }
  SUBCASE("a key that no case depends on, a touched file: nothing") {
    fs::last_write_time(bench.folder / "study.toml", fs::file_time_type::clock::now());
    CHECK(states(bench.run({"title=\"Another\""})) == std::vector{kept, kept, kept});
  }
  SUBCASE("a record that is damaged") {
    const std::string whole = dem::read_file(bench.record("count_2"));
    dem::write_file(bench.record("count_2"), whole.substr(0, whole.size() / 2));
    CHECK(states(bench.run()) == std::vector{kept, simulated, kept});
    CHECK(bench.why.at("count_2").find("cut short, damaged") != std::string::npos);
    CHECK(dem::read_file(bench.record("count_2")) == whole);
  }
  SUBCASE("--force") {
    bench.options.force = true;
    bench.options.only_case = "count_2";
    CHECK(states(bench.run()) == std::vector{kept, simulated, kept});
    CHECK(bench.why.at("count_2") == "asked for by --force");
  }
}

TEST_CASE("a case that is stopped goes on from its checkpoint to the same bytes") {
  Bench uncut;
  uncut.run();
  const std::string expected = dem::read_file(uncut.record("count_2"));

  Bench bench;
  bench.options.only_case = "count_2";
  stop_at = 4;
  CHECK_THROWS_AS(bench.run(), dem::Interrupted);
  const fs::path checkpoint = bench.record("count_2").parent_path() / "checkpoint";
  CHECK(fs::exists(checkpoint));
  CHECK_FALSE(fs::exists(bench.record("count_2")));
  stop = false;
  stop_at = -1;

  SUBCASE("goes on") {
    bench.run();
    CHECK(seen.first_step["count_2"] == 4);
    CHECK(bench.why.at("count_2") == "no record yet; goes on from its checkpoint");
    CHECK(dem::read_file(bench.record("count_2")) == expected);
  }
  SUBCASE("damaged: from the start, and said") {
    dem::write_file(checkpoint, dem::read_file(checkpoint).substr(0, 120));
    bench.run();
    CHECK(seen.first_step["count_2"] == 0);
    REQUIRE(bench.notes.size() == 1);
    CHECK(bench.notes[0].find("is damaged") != std::string::npos);
    CHECK(dem::read_file(bench.record("count_2")) == expected);
  }
  SUBCASE("of another input: from the start, and said") {
    bench.run({"load.steps=7"});
    CHECK(seen.first_step["count_2"] == 0);
    REQUIRE(bench.notes.size() == 1);
    CHECK(bench.notes[0].find("belongs to another input") != std::string::npos);
  }
  SUBCASE("--force: from the start") {
    bench.options.force = true;
    bench.run();
    CHECK(seen.first_step["count_2"] == 0);
  }
  CHECK_FALSE(fs::exists(checkpoint));
}

TEST_CASE("cases run side by side, to the same bytes, and are told in report order") {
  Bench alone;
  const auto expected = alone.run();
  for (const int threads : {2, 3, 8}) {
    CAPTURE(threads);
    Bench bench;
    bench.options.threads = threads;
    meet = std::min(threads, 3);
    const auto outcomes = bench.run();
    REQUIRE(states(outcomes) == std::vector{simulated, simulated, simulated});
    CHECK(seen.most_inside == meet);
    for (std::size_t i = 0; i < outcomes.size(); ++i) {
      CHECK(outcomes[i].id == expected[i].id);
      CHECK(outcomes[i].record->value(sum) == expected[i].record->value(sum));
      CHECK(dem::read_file(bench.record(outcomes[i].id)) == dem::read_file(alone.record(outcomes[i].id)));
    }
    CHECK(states(bench.run()) == std::vector{kept, kept, kept});
    CHECK(seen.threads.empty());
  }
}

TEST_CASE("threads are shared by the cases that have to be simulated, and memory bounds how many run at a time") {
  using Shares = std::map<std::string, int>;
  Bench bench;
  SUBCASE("one each") {
    bench.options.threads = 2;
    meet = 2;
    bench.run();
    CHECK(seen.threads["count_1"] == 1);
    CHECK(seen.threads["count_2"] == 1);
    CHECK(seen.threads["count_3"] >= 1);
    CHECK(seen.threads["count_3"] <= 2);  // both, where the others ended before it began
  }
  SUBCASE("more threads than cases") {
    bench.options.threads = 8;
    meet = 3;
    bench.run();
    int sum = 0;
    for (const auto& [id, threads] : seen.threads) {
      CHECK(threads >= 2);
      sum += threads;
    }
    CHECK(sum == 8);
  }
  SUBCASE("the last case has those that the others leave") {
    bench.options.threads = 3;
    meet = grows = 3;
    CHECK(states(bench.run()) == std::vector{simulated, simulated, simulated});
    CHECK(seen.threads == Shares{{"count_1", 1}, {"count_2", 1}, {"count_3", 1}});
  }
  SUBCASE("one that fails leaves its threads too") {
    bench.options.threads = 2;
    grows = 2;
    CHECK(states(bench.run({"load.fails_at=3"})) == std::vector{simulated, simulated, CaseState::failed});
    CHECK(seen.threads == Shares{{"count_1", 1}, {"count_2", 1}, {"count_3", 1}});
  }
  SUBCASE("one case that is not kept") {
    bench.run();
    bench.options.threads = 4;
    bench.run({"sweep.value=[1, 2, 3, 4]"});
    CHECK(seen.threads == Shares{{"count_4", 4}});
  }
  SUBCASE("cases that ask for two each") {
    bench.options.threads = 5;
    meet = 2;
    threads_asked = 2;
    bench.run();
    CHECK(seen.most_inside == 2);
    for (const auto& [id, threads] : seen.threads) CHECK(threads >= 2);
  }
  SUBCASE("cases that ask for more than there are: one after the other, with all of them") {
    bench.options.threads = 2;
    threads_asked = 7;
    bench.run();
    CHECK(seen.threads == Shares{{"count_1", 2}, {"count_2", 2}, {"count_3", 2}});
    CHECK(seen.most_inside == 1);
  }
  SUBCASE("a small machine: one after the other, with all threads") {
    bench.options.threads = 2;
    bench.options.memory = std::uint64_t{3} << 30;
    bench.run();
    CHECK(seen.threads == Shares{{"count_1", 2}, {"count_2", 2}, {"count_3", 2}});
    CHECK(seen.most_inside == 1);
  }
}

TEST_CASE("two cases that are stopped together both go on from their checkpoints") {
  Bench uncut;
  uncut.run();
  Bench bench;
  bench.options.threads = 2;
  meet = 2;
  stop_at = 4;
  CHECK_THROWS_AS(bench.run(), dem::Interrupted);
  stop = false;
  stop_at = -1;
  meet = 1;
  for (const char* id : {"count_1", "count_2"}) {
    CAPTURE(id);
    CHECK(fs::exists(bench.record(id).parent_path() / "checkpoint"));
    CHECK_FALSE(fs::exists(bench.record(id)));
  }
  CHECK_FALSE(fs::exists(bench.record("count_3").parent_path()));
  CHECK(states(bench.run()) == std::vector{simulated, simulated, simulated});
  CHECK(bench.why.at("count_1") == "no record yet; goes on from its checkpoint");
  CHECK(bench.why.at("count_2") == "no record yet; goes on from its checkpoint");
  CHECK(std::max(seen.first_step["count_1"], seen.first_step["count_2"]) == 4);
  for (const char* id : {"count_1", "count_2", "count_3"}) {
    CHECK(dem::read_file(bench.record(id)) == dem::read_file(uncut.record(id)));
  }
}

TEST_CASE("an error of the machine ends the study; the case beside keeps its state") {
  Bench bench;
  bench.options.threads = 2;
  meet = 2;
  CHECK_THROWS_WITH_AS(bench.run({"load.breaks_at=1"}), "the disk is full", dem::EnvironmentError);
  CHECK(fs::exists(bench.record("count_2").parent_path() / "checkpoint"));
  CHECK_FALSE(fs::exists(bench.record("count_3").parent_path()));
}

TEST_CASE("a stop before the first case simulates nothing") {
  Bench bench;
  stop = true;
  CHECK_THROWS_AS(bench.run(), dem::Interrupted);
  CHECK(bench.why.empty());
}

TEST_CASE("a case that fails does not stop the others, and is tried again") {
  Bench bench;
  SUBCASE("one after the other") {}
  SUBCASE("side by side") {
    bench.options.threads = 2;
    meet = 2;
  }
  const auto outcomes = bench.run({"load.fails_at=2"});
  CHECK(states(outcomes) == std::vector{simulated, CaseState::failed, simulated});
  CHECK(outcomes[1].error == "the counter cannot be packed");
  CHECK_FALSE(outcomes[1].record);
  meet = 1;
  CHECK(states(bench.run({"load.fails_at=2"})) == std::vector{kept, CaseState::failed, kept});

  bench.options.report_only = true;  // its words are still known; not those of another content
  const auto drawn = bench.run({"load.fails_at=2"});
  CHECK(states(drawn) == std::vector{kept, CaseState::failed, kept});
  CHECK(drawn[1].error == "the counter cannot be packed");
  CHECK(bench.run({"load.fails_at=2", "load.steps=11"})[1].state == CaseState::missing);
  bench.options.report_only = false;
  CHECK(bench.run({"load.fails_at=2", "load.steps=11"})[1].state == CaseState::failed);
  bench.options.report_only = true;  // of two contents, the last one counts
  CHECK(bench.run({"load.fails_at=2"})[1].state == CaseState::missing);
}

TEST_CASE("--case runs one; the others are taken when they are current") {
  Bench bench;
  bench.options.only_case = "count_2";
  CHECK(states(bench.run()) == std::vector{CaseState::left_out, simulated, CaseState::left_out});
  bench.options.only_case = "count_3";
  CHECK(states(bench.run()) == std::vector{CaseState::left_out, kept, simulated});
  bench.options.only_case = "count_4";
  CHECK_THROWS_WITH_AS(bench.run(), doctest::Contains("there is no case 'count_4'; did you mean 'count_1'?"),
                       dem::InputError);
}

TEST_CASE("--report-only simulates nothing and does not draw what belongs to another input") {
  Bench bench;
  bench.options.only_case = "count_1";
  bench.run();
  bench.options.only_case.clear();
  bench.options.report_only = true;
  const auto outcomes = bench.run();
  CHECK(states(outcomes) == std::vector{kept, CaseState::missing, CaseState::missing});
  CHECK(outcomes[1].error.find("no record") != std::string::npos);
  const auto other = bench.run({"seed=2"});
  CHECK(other[0].state == CaseState::missing);
  CHECK(other[0].error.find("seed: 1 -> 2") != std::string::npos);
  CHECK(bench.why.empty());
}

TEST_CASE("output that cannot be written is named") {
  Bench bench;
  dem::write_file(bench.folder / "out", "a file in the way");
  try {
    bench.run();
    FAIL("no error");
  } catch (const dem::EnvironmentError& error) {
    CHECK(std::string(error.what()).find((bench.folder / "out").string()) != std::string::npos);
  }
}

TEST_CASE("a sweep with a value twice is refused") {
  Bench bench;
  CHECK_THROWS_WITH_AS(bench.run({"sweep.value=[1, 1]"}),
                       doctest::Contains("sweep.value: two cases are alike (count_1)"), dem::InputError);
}

TEST_CASE("keys that change nothing: refused from --set, told from the scenario, passed over from what it includes") {
  const auto read = [](const std::string& name, std::vector<std::string> overrides) {
    return dem::read_study(std::string(DEM_SOURCE_DIR) + "/scenarios/" + name + ".toml", "smoke", overrides,
                           dem::models());
  };
  for (const auto& [name, set, part] :
       {std::tuple{"elle_polycrystal", "grains.layer_low=0.3", "grains.source is \"voronoi\""},
        {"elle_polycrystal", "grains.expanding_mineral=\"MICA\"", "grains.expanding is 0"},
        {"elle_polycrystal", "disorder.spread=0.3", "every case takes a value of its own"},
        {"elle_layer_extension", "historical.stop=1e-9", "it is for historical, and no case here is one"},
        {"elle_layer_extension", "rule[0].growth=0.01", "loading.kind is \"extension\""},
        {"elle_layer_extension", "grains.count=50", "it is for grown grains"},
        {"elle_expanding_grains", "loading.step=0.01", "by the growth of their [[rule]]"},
        {"ldb_dip_angle", "texture.dip=\"20 deg\"", "every case takes a value of its own"},
        {"quartzite_elastic", "loading.tension_motion=\"both\"", ""}}) {
    CAPTURE(set);
    CHECK_THROWS_WITH_AS((void)read(name, {set}), doctest::Contains(part), dem::InputError);
  }
  CHECK(read("elle_layer_extension", {"grains.layer_low=0.45"}).notes.empty());
  const test::Scratch scratch;
  std::ofstream(scratch / "own.toml") << "model = \"sheet\"\ntitle = \"Own\"\n[grains]\nlayer_low = "
                                         "0.3\n[loading]\nkind = \"extension\"\n[scales.smoke]\n";
  const dem::Study own = dem::read_study(scratch / "own.toml", "smoke", {}, dem::models());
  REQUIRE(own.notes.size() == 1);
  CHECK(own.notes[0].find("own.toml:4") != std::string::npos);
  CHECK(own.notes[0].find("grains.layer_low: this value changes nothing in this scenario") != std::string::npos);
}

TEST_CASE("each test of the lattice has planes of its own, and cases beside the sweep follow them") {
  const auto read = [](std::vector<std::string> overrides) {
    return dem::read_study(std::string(DEM_SOURCE_DIR) + "/scenarios/quartzite_energy.toml", "smoke", overrides,
                           dem::models());
  };
  const auto planes = [](const dem::Study& study) {
    std::vector<std::string> found;
    for (const dem::CaseSpec& spec : study.cases) {
      const auto* own = dem::find_value(spec.parameters, "planes_" + spec.test());
      REQUIRE(own);
      found.push_back(spec.id + " " + std::get<std::string>(*own));
    }
    return found;
  };
  CHECK(planes(read({})) == std::vector<std::string>{"compression_n_4 elastic", "tension_n_4 rigid",
                                                     "tension_n_4_plate plate", "tension_n_4_elastic elastic"});
  CHECK(planes(read({"planes.tension=\"elastic\"", "planes.compression=\"rigid\""})) ==
        std::vector<std::string>{"compression_n_4 rigid", "tension_n_4 elastic", "tension_n_4_plate plate"});
  const dem::Study strength =
      dem::read_study(std::string(DEM_SOURCE_DIR) + "/scenarios/quartzite_strength.toml", "paper", {}, dem::models());
  const auto pulled = std::ranges::find(strength.cases, std::string("tension_n_8_one"), &dem::CaseSpec::id);
  REQUIRE(pulled != strength.cases.end());
  CHECK(*dem::find_value(pulled->parameters, "planes_tension") == dem::ParameterValue(std::string("rigid")));
  CHECK_THROWS_WITH_AS((void)read({"loading.planes=\"rigid\""}),
                       doctest::Contains("did you mean a key of [planes]: compression, elastic, stiffness, tension?"),
                       dem::InputError);
}

TEST_CASE("no shipped scenario has a key that changes nothing, at any scale") {
  for (const auto& file : fs::directory_iterator(std::string(DEM_SOURCE_DIR) + "/scenarios")) {
    if (file.path().extension() != ".toml") continue;
    for (const char* scale : {"smoke", "draft", "paper", "high"}) {
      CAPTURE(file.path().string());
      CAPTURE(scale);
      try {
        const dem::Study study = dem::read_study(file.path(), scale, {}, dem::models());
        for (const std::string& note : study.notes) FAIL_CHECK(note);
      } catch (const dem::InputError& error) {
        CHECK(std::string(error.what()).find("scale") != std::string::npos);  // it has no such scale
      }
    }
  }
}

TEST_CASE("changes: indices of lists, values that come and go, and not too many at once") {
  const std::vector<dem::Key> keys = {{.path = "mineral[].cohesion", .unit = "MPa", .help = ""},
                                      {.path = "sweep.dip", .type = dem::KeyType::reals, .unit = "mm", .help = ""}};
  CHECK(dem::changes("mineral[2].cohesion = 2.92e+08\n", "mineral[2].cohesion = 3e+08\n", keys) ==
        "mineral[2].cohesion: 292 MPa -> 300 MPa");
  CHECK(dem::changes("sweep.dip = [0.001, 0.25]\n", "sweep.dip = [0.001]\n", keys) ==
        "sweep.dip: [1 mm, 250 mm] -> [1 mm]");
  CHECK(dem::changes("a = 1\n", "a = 1\nb = \"x\"\n", keys) == "b: (none) -> \"x\"");
  CHECK(dem::changes("a = 1\nb = 1\nc = 1\nd = 1\ne = 1\nf = 1\n", "a = 2\nb = 2\nc = 2\nd = 2\ne = 2\nf = 2\n",
                     keys) == "a: 1 -> 2, b: 1 -> 2, c: 1 -> 2, d: 1 -> 2 and 2 more");
  CHECK(dem::changes("a = 1\n", "a = 1\n", keys).empty());
}

TEST_CASE("progress in a log: a line now and then, with an estimate of the time left") {
  std::ostringstream out;
  double now = 100;
  dem::ProgressPrinter printer(out, dem::ProgressPrinter::Mode::lines, [&] { return now; });
  printer.start(6);
  printer.begin("compression_ar_2", 3);
  for (int second = 0; second <= 100; ++second, now += 1) {
    printer.update("compression_ar_2", {"loading", 100 * second, second / 100.0, 1e-5 * second, 1e6 * second});
  }
  std::istringstream lines(out.str());
  std::vector<std::string> all;
  for (std::string line; std::getline(lines, line);) all.push_back(line);
  REQUIRE(all.size() >= 9);
  CHECK(all.size() <= 10);
  CHECK(all[1] == "compression_ar_2 (3/6) loading 20 %, step 2000, strain 0.02 %, stress 20 MPa, 1 min 20 s left");
}

TEST_CASE("progress on a terminal: one line, redrawn; quiet: nothing") {
  std::ostringstream out;
  double now = 0;
  dem::ProgressPrinter bar(
      out, dem::ProgressPrinter::Mode::bar, [&] { return now; }, 40);
  bar.start(1);
  bar.begin("a", 1);
  for (int i = 0; i < 1000; ++i, now += 0.001) bar.update("a", {"loading", i, i / 1000.0, 0.01, 1e6});
  bar.say("done");
  const std::string text = out.str();
  CHECK(std::count(text.begin(), text.end(), '\n') == 1);
  CHECK(text.find("[##########..........] ") != std::string::npos);
  CHECK(std::count(text.begin(), text.end(), '\r') < 15);
  CHECK(text.ends_with("\r\033[Kdone\n"));

  std::ostringstream silent;
  dem::ProgressPrinter quiet(silent, dem::ProgressPrinter::Mode::quiet, [&] { return now; });
  quiet.start(1);
  quiet.begin("a", 1);
  quiet.update("a", {"loading", 1, 0.5, 0, 0});
  quiet.say("done");
  CHECK(silent.str().empty());
}

TEST_CASE("progress of cases that run side by side: lines of each in a log, one bar on a terminal") {
  double now = 0;
  const auto follow = [&](dem::ProgressPrinter& printer) {
    now = 0;
    printer.start(4);
    printer.end("kept");
    printer.begin("a", 2);
    printer.begin("b", 3);
    for (int second = 0; second <= 20; ++second, now += 1) {
      printer.update("a", {"loading", second, second / 40.0, 0, 0});
      printer.update("b", {"loading", second, second / 80.0, 0, 0});
    }
  };
  std::ostringstream log;
  dem::ProgressPrinter lines(log, dem::ProgressPrinter::Mode::lines, [&] { return now; });
  follow(lines);
  CHECK(log.str() ==
        "a (2/4) loading 25 %, step 10, 30 s left\nb (3/4) loading 12 %, step 10, 1 min 10 s left\n"
        "a (2/4) loading 50 %, step 20, 20 s left\nb (3/4) loading 25 %, step 20, 1 min 00 s left\n");

  std::ostringstream terminal;
  dem::ProgressPrinter bar(terminal, dem::ProgressPrinter::Mode::bar, [&] { return now; });
  follow(bar);
  const auto last = [&] { return terminal.str().substr(terminal.str().rfind("\r\033[K") + 4); };
  CHECK(last() == "[########............] 1/4 done, a 50 % (20 s left), b 24 % (1 min 04 s left)");
  bar.end("a");
  bar.update("b", {"loading", 60, 0.75, 0, 0});
  CHECK(last() == "[###############.....] b (3/4) loading 75 %, step 60, 7 s left");
}

TEST_CASE("durations as a person says them") {
  CHECK(dem::duration_text(0.2) == "0 s");
  CHECK(dem::duration_text(59.4) == "59 s");
  CHECK(dem::duration_text(83) == "1 min 23 s");
  CHECK(dem::duration_text(7500) == "2 h 05 min");
}
