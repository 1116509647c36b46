// Ends that main() does not see: each in a process of its own.
#include <doctest/doctest.h>
#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <functional>
#include <new>
#include <stdexcept>
#include <thread>

#include "engine/core/errors.h"
#include "engine/core/files.h"
#include "reports/commands/last_words.h"
#include "tests/support/scratch.h"

namespace {

struct Ended {
  int status = 0;
  std::string said;
};

Ended ended(const std::function<void()>& life) {
  const test::Scratch folder;
  const std::string log = folder / "log";
  const pid_t child = ::fork();
  REQUIRE(child >= 0);
  if (child == 0) {
    ::dup2(::open(log.c_str(), O_WRONLY | O_CREAT, 0600), STDERR_FILENO);
    cli::prepare_last_words();
    life();
    std::exit(cli::leave_with(0));
  }
  Ended end;
  REQUIRE(::waitpid(child, &end.status, 0) == child);
  end.said = dem::read_file(log);
  return end;
}

}  // namespace

TEST_CASE("an exception that nobody can catch ends the program with 3 and a sentence") {
  struct End {
    std::function<void()> life;
    int code;
    std::string said;
  };
  const auto in_a_thread = [](const auto& fail) { return [fail] { std::thread(fail).join(); }; };
  const std::vector<End> all = {
      {[] {}, 0, ""},
      {in_a_thread([] { throw std::bad_alloc(); }), 3, "dem-report: out of memory"},
      {in_a_thread([] { throw dem::EnvironmentError("no room"); }), 3, "dem-report: no room"},
      {in_a_thread([] { throw std::logic_error("a defect"); }), 3, "internal error: a defect"},
      {[] { std::exit(1); }, 3, "a library ended the program"},
      {[] { std::raise(SIGPIPE); }, 0, ""},
      {[] { std::raise(SIGXFSZ); }, 0, ""},
  };
  for (const End& end : all) {
    CAPTURE(end.said);
    const Ended found = ended(end.life);
    CAPTURE(found.said);
    REQUIRE(WIFEXITED(found.status));
    CHECK(WEXITSTATUS(found.status) == end.code);
    CHECK(found.said.find(end.said) != std::string::npos);
    CHECK(found.said.empty() == end.said.empty());
  }
}
