// Plans: what a case will take, manifests as text, packs of cases and arrays of jobs.
#include <doctest/doctest.h>

#include <algorithm>
#include <set>

#include "engine/core/errors.h"
#include "engine/core/files.h"
#include "reports/cluster/estimate.h"
#include "reports/cluster/manifest.h"
#include "reports/cluster/packs.h"
#include "tests/support/near.h"
#include "tests/support/scratch.h"

namespace {

namespace fs = std::filesystem;

std::vector<std::size_t> all_lines(const cluster::Manifest& manifest) {
  std::vector<std::size_t> lines;
  for (std::size_t i = 1; i <= manifest.size(); ++i) lines.push_back(i);
  return lines;
}

cluster::Manifest lines_of(std::size_t count, double seconds) {
  cluster::Manifest manifest(count);
  for (cluster::Line& line : manifest) {
    line.seconds = seconds;
    line.memory = std::uint64_t{1} << 30;
  }
  return manifest;
}

bool none_missing(const std::string&) { return false; }
bool all_missing(const std::string&) { return true; }

}  // namespace

TEST_CASE(
    "5000 cases on a cluster whose arrays have at most 1001 elements: each is in one element, indices from 0 to 1000") {
  const cluster::Manifest manifest = lines_of(5000, 3600);  // an hour each: a job each
  const auto packs = cluster::packs(manifest, all_lines(manifest), {}, none_missing);
  REQUIRE(packs.size() == 5000);
  const auto arrays = cluster::arrays(packs, 1001);
  REQUIRE(arrays.size() == 5);
  std::set<std::size_t> seen;
  for (const cluster::Array& array : arrays) {
    CHECK(array.count <= 1001);
    for (std::size_t k = 0; k < array.count; ++k) {
      for (const std::size_t line : packs[array.first + k].lines) CHECK(seen.insert(line).second);
    }
  }
  CHECK(seen.size() == 5000);
  CHECK(*seen.begin() == 1);
  CHECK(*seen.rbegin() == 5000);
  CHECK(cluster::arrays(packs, 0).size() == 5000);  // a cluster that says nonsense
}

TEST_CASE("small cases go into packs of 10 to 20 minutes, long ones stand alone") {
  cluster::Manifest manifest = lines_of(200, 45);
  manifest[7].seconds = 7200;
  const auto packs = cluster::packs(manifest, all_lines(manifest), {}, none_missing);
  std::size_t cases = 0;
  int short_ones = 0;
  for (const cluster::Pack& pack : packs) {
    cases += pack.lines.size();
    if (pack.lines == std::vector<std::size_t>{8}) continue;
    CHECK(pack.seconds <= 1200);
    if (pack.seconds < 600) ++short_ones;
    CHECK(pack.memory == std::uint64_t{1} << 30);
  }
  CHECK(cases == 200);
  CHECK(short_ones <= 2);  // what is cut off by the long one, and the rest
  const auto pairs = cluster::packs(manifest, all_lines(manifest), {.cases_per_job = 2}, none_missing);
  CHECK(pairs.size() == 100);
}

TEST_CASE("packs are of one number of threads, and lines that share a specimen stand together") {
  cluster::Manifest manifest = lines_of(6, 400);
  for (const std::size_t i : {1U, 4U}) manifest[i].threads = 8;
  for (const std::size_t i : {0U, 3U, 5U}) manifest[i].specimens = {"b.h5"};
  manifest[2].specimens = {"a.h5"};
  const auto packs = cluster::packs(manifest, all_lines(manifest), {}, none_missing);
  REQUIRE(packs.size() == 3);
  CHECK(packs[0].lines == std::vector<std::size_t>{3, 1, 4});
  CHECK(packs[1].lines == std::vector<std::size_t>{6});
  CHECK(packs[2].lines == std::vector<std::size_t>{2, 5});
  CHECK(packs[2].threads == 8);
  CHECK(cluster::arrays(packs, 1001) == std::vector<cluster::Array>{{0, 2}, {2, 1}});
  CHECK(cluster::packs(manifest, {2, 5}, {.threads = 4}, none_missing).front().threads == 4);
}

TEST_CASE("a specimen that several packs need is made once, before them; one that a single pack needs is left to it") {
  cluster::Manifest manifest = lines_of(6, 1000);
  for (const std::size_t i : {0U, 1U, 2U}) manifest[i].specimens = {"grains.h5", "packing.h5"};
  for (const std::size_t i : {3U, 4U}) manifest[i].specimens = {"other.h5"};
  manifest[3].seconds = manifest[4].seconds = 100;
  const auto packs = cluster::packs(manifest, all_lines(manifest), {}, all_missing);
  REQUIRE(packs.size() == 5);
  CHECK(packs[0].specimens_only);
  CHECK(packs[0].lines == std::vector<std::size_t>{1});
  for (std::size_t p = 1; p < packs.size(); ++p) CHECK_FALSE(packs[p].specimens_only);
  CHECK(cluster::arrays(packs, 1001) == std::vector<cluster::Array>{{0, 1}, {1, 4}});
  CHECK(packs.back().lines == std::vector<std::size_t>{3, 4, 5});  // small ones with the last of the long ones
  CHECK(cluster::packs(manifest, all_lines(manifest), {}, none_missing).size() == 4);
}

TEST_CASE("packs and manifests come back from their text as they were; broken lines are told") {
  cluster::Manifest manifest = lines_of(2, 12.345);
  manifest[1] = {.source = {.folder = "/home/a b/$(touch x)",
                            .scenario = "it's \"quoted\" `id`\n.toml",
                            .scale = "draft",
                            .overrides = {"title=\"a; rm -rf $HOME\"", "seed=2"}},
                 .study = "it's.draft",
                 .case_id = "compression_ar_1",
                 .content = "00ff",
                 .seconds = 1.5,
                 .seconds_from = "this case",
                 .memory = std::uint64_t{3} << 30,
                 .threads = 2,
                 .specimens = {"a.h5"}};
  const std::string text = cluster::to_text(manifest);
  CHECK(std::ranges::count(text, '\n') == 2);  // a line a case, whatever stands in its names
  const cluster::Manifest back = cluster::manifest_of(text, "m");
  CHECK(cluster::to_text(back) == text);
  CHECK(back[1].source.overrides == manifest[1].source.overrides);
  CHECK(back[1].source.scenario == manifest[1].source.scenario);
  CHECK(back[1].memory == manifest[1].memory);
  CHECK_THROWS_WITH_AS(cluster::manifest_of(text + "{\"study\": 1}\n", "m"),
                       "m:3: this is no line of a manifest; make it again with dem-report plan", dem::InputError);
  manifest[0].source.folder = "/home/caf\xe9";
  CHECK_THROWS_AS(cluster::to_text(manifest), dem::InputError);

  const test::Scratch folder;
  const std::vector<cluster::Pack> packs = {
      {.lines = {1, 3}, .threads = 2, .seconds = 4, .memory = std::uint64_t{1} << 30},
      {.lines = {2}, .specimens_only = true}};
  dem::write_file(folder / "packs.jsonl", cluster::to_text(packs));
  CHECK(cluster::read_packs(folder / "packs.jsonl") == packs);
  CHECK(cluster::read_pack(folder / "packs.jsonl", 1) == packs[1]);
  CHECK_THROWS_AS(cluster::read_pack(folder / "packs.jsonl", 2), dem::InputError);
  CHECK_THROWS_AS(cluster::read_packs(folder / "none.jsonl"), dem::InputError);
}

TEST_CASE("estimates: from the case's own run, from the study's report, from its other cases, from its scale") {
  const test::Scratch folder;
  const dem::Study study =
      dem::read_study(DEM_SOURCE_DIR "/scenarios/quartzite_strength.toml", "smoke", {}, dem::models());
  const auto nothing = cluster::estimates(study, folder.path());
  REQUIRE(nothing.size() == study.cases.size());
  CHECK(nothing[0].from == "its scale");
  CHECK(nothing[0].seconds == 5);
  CHECK(nothing[0].memory == std::uint64_t{2} << 30);

  const fs::path own = dem::case_folder(folder.path(), study, study.cases[0].id);
  dem::write_file(own / "run.json", "{\"seconds\": 12.5, \"threads\": 2, \"memory_bytes\": 1073741824}\n");
  dem::write_file(folder.path() / study.folder() / "run.json",
                  "{\"case_seconds\": {\"" + study.cases[1].id + "\": 7.5, \"" + study.cases[0].id + "\": 1}}\n");
  const auto known = cluster::estimates(study, folder.path());
  CHECK(known[0].seconds == 12.5);
  CHECK(known[0].memory == 1342177280);  // a quarter more
  CHECK(known[0].from == "this case");
  CHECK(known[1].seconds == 7.5);
  CHECK(known[1].from == "this case");
  CHECK(known[2].seconds == test::near(10).epsilon(1e-12));
  CHECK(known[2].from == "this study");
  for (const char* broken : {"", "[]", "{\"seconds\": \"x\"}", "{\"seconds\": -1}", "\xff"}) {
    dem::write_file(own / "run.json", broken);
    CHECK_FALSE(cluster::earlier_run(own));
  }
}
