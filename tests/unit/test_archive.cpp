#include <doctest/doctest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <csignal>
#include <cstdint>
#include <fstream>
#include <set>

#include "engine/core/archive.h"
#include "engine/core/errors.h"
#include "engine/core/files.h"
#include "tests/support/scratch.h"

namespace {

struct Crack {
  double time = 0;
  std::int32_t mode = 0;
};

struct Sample {
  std::string name;
  std::vector<double> values;
  template <class Archive>
  void archive(Archive& a) {
    a(name, values);
  }
};

struct State {
  std::int64_t step = 0;
  std::array<double, 3> strain{};
  std::vector<Crack> cracks;
  std::vector<Sample> samples;
  std::vector<std::vector<std::int32_t>> neighbours;
  template <class Archive>
  void archive(Archive& a) {
    a(step, strain, cracks, samples, neighbours);
  }
};

State example() {
  State state;
  state.step = 41;
  state.strain = {0.1, -0.25, 1e-300};
  state.cracks = {{1.5, 1}, {2.5, 0}};
  state.samples = {{"stress", {1, 2, 3}}, {"", {}}};
  state.neighbours = {{}, {3, 4}};
  return state;
}

void flip_byte(const std::filesystem::path& path, std::size_t at) {
  std::string bytes = dem::read_file(path);
  bytes.at(at) = static_cast<char>(bytes.at(at) ^ 0x10);
  std::ofstream(path, std::ios::binary) << bytes;
}

}  // namespace

TEST_CASE("a checkpoint gives back the state that was saved") {
  const test::Scratch folder;
  dem::save_checkpoint(folder / "checkpoint", "seed = 1", example());
  State state;
  const dem::CheckpointLoad load = dem::load_checkpoint(folder / "checkpoint", "seed = 1", state);
  CHECK(load.loaded);
  CHECK(load.note.empty());
  CHECK(state.step == 41);
  CHECK(state.strain == example().strain);
  REQUIRE(state.cracks.size() == 2);
  CHECK(state.cracks[0].time == 1.5);
  CHECK(state.cracks[0].mode == 1);
  REQUIRE(state.samples.size() == 2);
  CHECK(state.samples[0].name == "stress");
  CHECK(state.samples[0].values == std::vector<double>{1, 2, 3});
  CHECK(state.neighbours == example().neighbours);
}

TEST_CASE("a checkpoint that cannot be trusted is left alone, and said why") {
  const test::Scratch folder;
  const std::filesystem::path path = folder / "checkpoint";
  State state;
  SUBCASE("none") {
    const auto load = dem::load_checkpoint(path, "a", state);
    CHECK_FALSE(load.loaded);
    CHECK(load.note.empty());
  }
  dem::save_checkpoint(path, "a", example());
  SUBCASE("another input") {
    const auto load = dem::load_checkpoint(path, "b", state);
    CHECK_FALSE(load.loaded);
    CHECK(load.note.find("belongs to another input") != std::string::npos);
  }
  SUBCASE("cut short anywhere") {
    const std::string whole = dem::read_file(path);
    for (const std::size_t size : {std::size_t{0}, std::size_t{10}, std::size_t{100}, whole.size() - 1}) {
      std::ofstream(path, std::ios::binary) << whole.substr(0, size);
      const auto load = dem::load_checkpoint(path, "a", state);
      CHECK_FALSE(load.loaded);
      CHECK(load.note.find("is damaged") != std::string::npos);
    }
  }
  SUBCASE("a flipped bit") {
    flip_byte(path, dem::read_file(path).size() - 3);
    const auto load = dem::load_checkpoint(path, "a", state);
    CHECK_FALSE(load.loaded);
    CHECK(load.note.find("is damaged") != std::string::npos);
  }
  SUBCASE("another layout of the state") {
    dem::save_checkpoint(path, "a", Sample{"x", {1}});
    const auto load = dem::load_checkpoint(path, "a", state);
    CHECK_FALSE(load.loaded);
    CHECK(load.note.find("another version of the program") != std::string::npos);
  }
  CHECK(state.step == 0);
}

TEST_CASE("a file that fails half-way leaves the old one and no rubbish") {
  const test::Scratch folder;
  const std::filesystem::path path = folder / "data.txt";
  dem::write_file(path, "old");
  CHECK_THROWS_AS(dem::write_aside(path,
                                   [](const std::filesystem::path& part) {
                                     std::ofstream(part) << "half";
                                     throw dem::EnvironmentError("disk full");
                                   }),
                  dem::EnvironmentError);
  CHECK(dem::read_file(path) == "old");
  CHECK(std::distance(std::filesystem::directory_iterator(folder.path()), {}) == 1);
}

TEST_CASE("a path that cannot be written is named") {
  const test::Scratch folder;
  dem::write_file(folder / "file", "x");
  try {
    dem::write_file(folder.path() / "file" / "below", "y");
    FAIL("no error");
  } catch (const dem::EnvironmentError& error) {
    CHECK(std::string(error.what()).find((folder / "file").string()) != std::string::npos);
  }
}

TEST_CASE("a disk that is full is heard, and the old file stays") {
  const test::Scratch folder;
  const std::filesystem::path path = folder / "data.bin";
  dem::write_file(path, "old");
  rlimit before{};
  ::getrlimit(RLIMIT_FSIZE, &before);
  const rlimit small = {4096, before.rlim_max};  // stands in for a full disk
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  ::setrlimit(RLIMIT_FSIZE, &small);
  CHECK_THROWS_WITH_AS(dem::write_file(path, std::string(100000, 'x')), doctest::Contains(path.c_str()),
                       dem::EnvironmentError);
  ::setrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, handler);
  CHECK(dem::read_file(path) == "old");
}

TEST_CASE("leftovers of a dead process are removed, those of a living one and of other machines stay") {
  const test::Scratch folder;
  const auto names = [&] {
    std::set<std::string> all;
    for (const auto& entry : std::filesystem::directory_iterator(folder.path()))
      all.insert(entry.path().filename().string());
    return all;
  };
  dem::write_file(folder / "results.h5", "x");
  // A process that is killed while it writes, with a page and a log beside the file.
  const pid_t child = ::fork();
  REQUIRE(child >= 0);
  if (child == 0) {
    dem::write_aside(folder / "report.pdf", [](const std::filesystem::path& part) {
      std::ofstream(part.string() + ".html") << "page";
      std::ofstream(part.string() + ".log") << "words";
      ::raise(SIGKILL);
    });
  }
  int status = 0;
  REQUIRE(::waitpid(child, &status, 0) == child);
  REQUIRE(names().size() == 4);
  dem::write_aside(folder / "data.txt", [&](const std::filesystem::path& own) {
    std::ofstream(own.string() + ".html") << "page";
    const std::string name = own.filename().string();  // ".data.txt.MACHINE-BOOT-PROCESS-BEGINNING-0.part"
    const std::string owner = name.substr(10);
    std::string later = owner;  // the number of a living process, given before to another
    later.insert(later.rfind('-'), "1");
    std::ofstream(folder / (".data.txt." + later)) << "half";
    std::string elsewhere = owner, before = owner;
    elsewhere.replace(0, 8, "00000000");
    before.replace(9, 8, "00000000");
    std::ofstream(folder / (".data.txt." + elsewhere)) << "half";
    std::ofstream(folder / (".old.txt." + before)) << "half";
    std::ofstream(folder / (".new.txt." + before)) << "half";
    std::filesystem::last_write_time(folder / (".old.txt." + before),
                                     std::filesystem::file_time_type::clock::now() - std::chrono::hours(25));
    std::ofstream(folder / ".data.txt.part") << "of somebody else";
    dem::remove_leftovers(folder.path());
    const std::set<std::string> stay = {
        "results.h5", name, name + ".html", ".data.txt." + elsewhere, ".new.txt." + before, ".data.txt.part"};
    CHECK(names() == stay);
  });
}

TEST_CASE("what a process left goes although nobody has asked yet how it ended") {
  const test::Scratch folder;
  const pid_t child = ::fork();
  REQUIRE(child >= 0);
  if (child == 0) dem::write_aside(folder / "results.h5", [](const auto&) { ::raise(SIGKILL); });
  siginfo_t end{};
  REQUIRE(::waitid(P_PID, static_cast<id_t>(child), &end, WEXITED | WNOWAIT) == 0);
  REQUIRE_FALSE(std::filesystem::is_empty(folder.path()));
  dem::remove_leftovers(folder.path());
  CHECK(std::filesystem::is_empty(folder.path()));
  CHECK(::waitpid(child, nullptr, 0) == child);
}
