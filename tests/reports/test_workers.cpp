// Drawing in several processes: order, errors, and the same bytes as in one. Its own program: nothing may have been drawn
// before the first fork.
#include <doctest/doctest.h>

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <map>
#include <stdexcept>
#include <system_error>

#include "engine/core/errors.h"
#include "engine/core/files.h"
#include "engine/model/model.h"
#include "reports/output/report.h"
#include "reports/output/workers.h"
#include "tests/reports/synthetic.h"
#include "tests/support/scratch.h"

namespace {

std::map<std::string, std::string> files_in(const std::filesystem::path& folder) {
  std::map<std::string, std::string> files;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    if (entry.is_regular_file() && entry.path().filename() != "run.json") {
      files[entry.path().lexically_relative(folder).string()] = dem::read_file(entry.path());
    }
  }
  return files;
}

reports::ReportOutcome report(const synthetic::Study& study, const std::filesystem::path& folder, const char* figure,
                              int workers) {
  reports::ReportOptions options;
  options.folder = folder;
  options.assets = std::filesystem::path(DEM_SOURCE_DIR) / "assets";
  options.engine_version = "0.1.0";
  options.pdf = false;
  options.only = figure;
  options.workers = workers;
  const auto canvas = []() -> render::Canvas& {
    static render::Canvas one;
    return one;
  };
  return reports::make_report(study.result(), options, canvas, {});
}

}  // namespace

TEST_CASE("results stand in the order of the pieces, whoever did them") {
  for (const int workers : {1, 2, 5}) {
    const auto squares =
        reports::in_processes<double>(37, workers, [](std::size_t i) { return static_cast<double>(i * i); });
    REQUIRE(squares.size() == 37);
    for (std::size_t i = 0; i < squares.size(); ++i) CHECK(squares[i] == static_cast<double>(i * i));
  }
  CHECK(reports::in_processes<int>(0, 2, [](std::size_t) { return 1; }).empty());
}

TEST_CASE("what a process throws, or a signal that ends it, reaches the caller") {
  const auto run = [](const auto& fail) {
    reports::in_processes<int>(8, 2, [&](std::size_t i) {
      if (i == 3) fail();
      return 0;
    });
  };
  CHECK_THROWS_WITH_AS(run([] { throw dem::EnvironmentError("no font"); }), "no font", dem::EnvironmentError);
  CHECK_THROWS_WITH_AS(run([] { throw std::invalid_argument("columns differ"); }), "columns differ",
                       std::runtime_error);
  CHECK_THROWS_WITH_AS(run([] { std::raise(SIGKILL); }), doctest::Contains("ended by signal 9 (Killed)"),
                       reports::ProcessEnded);
  CHECK_THROWS_WITH_AS(run([] { std::raise(SIGSEGV); }), doctest::Contains("signal 11 (Segmentation fault)"),
                       reports::ProcessEnded);
  CHECK_THROWS_WITH_AS(run([] { throw std::system_error(EAGAIN, std::generic_category(), "a thread"); }),
                       doctest::Contains("no more threads or memory"), dem::EnvironmentError);
  CHECK_THROWS_WITH_AS(run([] { throw std::runtime_error("pthread_create has failed: no"); }),
                       doctest::Contains("try --threads 1"), dem::EnvironmentError);
  CHECK_THROWS_WITH_AS(run([] { _exit(1); }), doctest::Contains("ended by an error"), reports::ProcessEnded);
  for (const int signal : {SIGTERM, SIGINT, SIGHUP}) {
    try {
      run([signal] { std::raise(signal); });
      FAIL_CHECK("nothing was thrown");
    } catch (const dem::Interrupted& interrupted) {
      CHECK(interrupted.signal == signal);
    }
  }
}

TEST_CASE("a process that only waits is given up") {
  const auto wait = [](std::size_t) { return static_cast<int>(::sleep(600)); };
  CHECK_THROWS_WITH_AS(reports::in_processes<int>(2, 2, wait), doctest::Contains("has stood still for 20 s"),
                       dem::EnvironmentError);
}

TEST_CASE("a library that crashes where memory is limited: the limit is named") {
  rlimit before{};
  REQUIRE(::getrlimit(RLIMIT_AS, &before) == 0);
  const rlimit limited{std::min<rlim_t>(rlim_t{1} << 40, before.rlim_max), before.rlim_max};
  REQUIRE(::setrlimit(RLIMIT_AS, &limited) == 0);
  CHECK_THROWS_WITH_AS(reports::in_processes<int>(1, 1, [](std::size_t) { return std::raise(SIGSEGV); }),
                       doctest::Contains("1048576 MiB are allowed here (ulimit -v)"), reports::ProcessEnded);
  CHECK(::setrlimit(RLIMIT_AS, &before) == 0);
}

TEST_CASE("processes are ended at once when the caller is asked to stop") {
  const auto begin = std::chrono::steady_clock::now();
  const auto since = [begin] { return std::chrono::steady_clock::now() - begin; };
  const auto sleep = [](std::size_t) { return static_cast<int>(::sleep(60)); };
  CHECK_THROWS_AS(reports::in_processes<int>(4, 2, sleep, [&] { return since() > std::chrono::milliseconds(100); }),
                  dem::Interrupted);
  CHECK(since() < std::chrono::seconds(2));
}

TEST_CASE("pictures drawn in two processes have the same bytes as in one") {
  const test::Scratch scratch;
  const synthetic::Study study(scratch.path(), {.diameter = 3e-3, .height = 6e-3, .samples = 20});
  for (const char* figure : {"grain_cluster", "stress_strain"}) report(study, scratch / "two" / figure, figure, 2);
  REQUIRE_FALSE(render::Canvas::any_made());
  for (const char* figure : {"grain_cluster", "stress_strain"}) report(study, scratch / "one" / figure, figure, 1);
  const auto two = files_in(scratch / "two");
  const auto one = files_in(scratch / "one");
  CHECK(two.size() > 10);
  REQUIRE(two.size() == one.size());
  for (const auto& [name, bytes] : one) {
    CAPTURE(name);
    CHECK(two.at(name) == bytes);
  }
}

TEST_CASE("once this process has drawn, all is drawn in it") {
  const test::Scratch scratch;
  const synthetic::Study study(scratch.path(), {.diameter = 3e-3, .height = 6e-3, .samples = 20});
  const render::Canvas first;
  REQUIRE(render::Canvas::any_made());
  CHECK_NOTHROW(report(study, scratch / "out", "grain_cluster", 2));
}
