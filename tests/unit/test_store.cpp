#include <doctest/doctest.h>

#include <array>

#include <cmath>
#include <fstream>
#include <limits>

#include "engine/core/errors.h"
#include "engine/core/files.h"
#include "engine/store/store.h"
#include "tests/support/scratch.h"

namespace {

dem::Record example() {
  dem::Record record;
  record.model = "rock";
  record.scenario = "study";
  record.case_id = "compression_ar_2";
  record.content = "seed = 1\nspecimen.diameter = 0.025\n";
  record.physics_version = "3";
  record.seed = 18446744073709551615ULL;
  record.parameters = {{"test", std::string("compression")}, {"aspect_ratio", 2.0}, {"empty", std::string()}};
  static constexpr std::array declared{dem::Quantity{.id = "strength", .name = "Strength", .unit = "MPa"},
                                       dem::Quantity{.id = "cracks.*", .name = "Cracks"},
                                       dem::Quantity{.id = "a_first", .name = "A"}};
  record.quantities = declared;
  record.put(declared[0], 206.8);
  record.put(declared[1], "intra_tension", 12);
  record.put(declared[2], std::numeric_limits<double>::quiet_NaN());
  record.checks = {{"servo", 0.004, 0.01, true, "The wall keeps its pressure."}, {"energy", 0.02, 0.01, false, "α"}};
  record.notes = {"The curve had flattened.", "Größe 0.35 mm"};
  dem::Table history{"history", {{"sign", "compression positive"}}, {}};
  history.add("time", "s", std::vector<double>{0, 0.5, 1});
  history.add("step", "", std::vector<std::int32_t>{0, 10, -20});
  history.add("force", "N", std::vector<double>{1, 2, 3, 4, 5, 6, 7, 8, 9}, 3);
  record.tables.push_back(history);
  dem::Table later{"snapshots/0001", {}, {}};
  later.add("u", "m", std::vector<double>{1.25});
  record.tables.push_back(later);
  dem::Table first{"snapshots/0000", {{"moment", "peak"}}, {}};
  first.add("u", "m", std::vector<double>{-0.5});
  record.tables.push_back(first);
  dem::Table none{"cracks", {{"mode", "0 tension, 1 shear"}}, {}};
  none.add("time", "s", std::vector<double>{});
  none.add("pair", "", std::vector<std::int32_t>{}, 2);
  record.tables.push_back(none);
  return record;
}

std::string error_of(const std::filesystem::path& path) {
  try {
    (void)dem::read_record(path);
  } catch (const dem::EnvironmentError& error) {
    return error.what();
  }
  return {};
}

bool equal(const dem::Table& a, const dem::Table& b) {
  if (a.name != b.name || a.attributes != b.attributes || a.columns.size() != b.columns.size()) return false;
  for (std::size_t i = 0; i < a.columns.size(); ++i) {
    const dem::Column& x = a.columns[i];
    const dem::Column& y = b.columns[i];
    if (x.name != y.name || x.unit != y.unit || x.width != y.width || x.values != y.values) return false;
  }
  return true;
}

}  // namespace

TEST_CASE("a record comes back as it was written, order included") {
  const test::Scratch folder;
  const auto path = folder / "cases/x/results.h5";
  const dem::Record out = example();
  dem::write_record(out, path);
  const dem::Record in = dem::read_record(path);
  CHECK(in.model == out.model);
  CHECK(in.scenario == out.scenario);
  CHECK(in.case_id == out.case_id);
  CHECK(in.content == out.content);
  CHECK(in.physics_version == out.physics_version);
  CHECK(in.seed == out.seed);
  CHECK(in.parameters == out.parameters);
  REQUIRE(in.results.size() == 3);
  CHECK(in.results[0] == out.results[0]);
  CHECK(in.results[1] == out.results[1]);
  CHECK(in.results[2].first == "a_first");
  CHECK(std::isnan(in.results[2].second));
  REQUIRE(in.checks.size() == 2);
  CHECK(in.checks[0].id == "servo");
  CHECK(in.checks[0].value == 0.004);
  CHECK(in.checks[0].held);
  CHECK_FALSE(in.checks[1].held);
  CHECK(in.checks[1].meaning == "α");
  CHECK(in.notes == out.notes);
  REQUIRE(in.tables.size() == out.tables.size());
  for (std::size_t i = 0; i < in.tables.size(); ++i) CHECK(equal(in.tables[i], out.tables[i]));
  CHECK(dem::read_content(path) == out.content);
}

TEST_CASE("the same record gives the same bytes") {
  const test::Scratch folder;
  dem::write_record(example(), folder / "a.h5");
  dem::write_record(example(), folder / "b.h5");
  CHECK(dem::read_file(folder / "a.h5") == dem::read_file(folder / "b.h5"));
}

TEST_CASE("a long content key and a large column survive") {
  const test::Scratch folder;
  dem::Record record = example();
  record.content.assign(300000, 'x');
  std::vector<double> values(500001);
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = std::sin(static_cast<double>(i));
  dem::Table big{"particles", {}, {}};
  big.add("position", "m", values, 3);
  record.tables.push_back(big);
  dem::write_record(record, folder / "r.h5");
  const dem::Record in = dem::read_record(folder / "r.h5");
  CHECK(in.content == record.content);
  CHECK(equal(in.table("particles"), big));
}

TEST_CASE("a file that is missing, cut short, damaged or foreign is an error that names it") {
  const test::Scratch folder;
  const auto path = folder / "results.h5";
  CHECK(error_of(path).find("No such file") != std::string::npos);
  dem::write_record(example(), path);
  const std::string whole = dem::read_file(path);
  for (const std::size_t size : {std::size_t{0}, std::size_t{100}, whole.size() / 2, whole.size() - 1}) {
    CAPTURE(size);
    dem::write_file(path, whole.substr(0, size));
    CHECK(error_of(path).find(path.string()) != std::string::npos);
    CHECK_THROWS_AS((void)dem::read_content(path), dem::EnvironmentError);
  }
  dem::write_file(path, "id,value\n1,2\n");
  CHECK(error_of(path).find("cut short, damaged or from another program") != std::string::npos);
  dem::write_tables(path, {{"kind", "specimen"}}, {});
  CHECK(error_of(path).find("holds no record") != std::string::npos);
  CHECK(error_of(folder.path()).find("cannot read") != std::string::npos);
}

TEST_CASE("a flipped bit anywhere is an error, never a wrong record") {
  const test::Scratch folder;
  const auto path = folder / "results.h5";
  dem::write_record(example(), path);
  const std::string whole = dem::read_file(path);
  for (std::size_t at = 0; at < whole.size(); at += whole.size() / 50) {
    CAPTURE(at);
    std::string bytes = whole;
    bytes[at] = static_cast<char>(bytes[at] ^ 0x04);
    dem::write_file(path, bytes);
    CHECK(error_of(path).find("damaged") != std::string::npos);
  }
}

TEST_CASE("tables outside a record") {
  const test::Scratch folder;
  dem::Table particles{"particles", {{"frame", "laboratory"}}, {}};
  particles.add("radius", "m", std::vector<double>{0.1, 0.2});
  dem::write_tables(folder / "key.h5", {{"kind", "specimen"}, {"content", "seed = 1\n"}}, {particles});
  const dem::TableFile in = dem::read_tables(folder / "key.h5");
  CHECK(in.attribute("content") == "seed = 1\n");
  CHECK(in.attribute("nothing").empty());
  CHECK(equal(in.table("particles"), particles));
  CHECK_THROWS_AS((void)in.table("contacts"), std::out_of_range);
  dem::write_record(example(), folder / "record.h5");
  CHECK_THROWS_AS((void)dem::read_tables(folder / "record.h5"), dem::EnvironmentError);
}

TEST_CASE("a column that does not fill its rows is a defect, and leaves no file") {
  const test::Scratch folder;
  dem::Record record = example();
  record.tables[0].add("odd", "m", std::vector<double>{1, 2}, 3);
  CHECK_THROWS_AS(dem::write_record(record, folder / "r.h5"), std::logic_error);
  CHECK(std::filesystem::is_empty(folder.path()));
}
