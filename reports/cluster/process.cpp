#include "reports/cluster/process.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <memory>
#include <thread>

#include "engine/core/errors.h"

namespace cluster {
namespace {

/// A file without a name: as large as the answer, no reader needed while the program runs.
class Answer {
 public:
  Answer() : file_(std::tmpfile()) {
    if (!file_) throw dem::EnvironmentError(std::string("no temporary file can be made: ") + std::strerror(errno));
  }
  [[nodiscard]] int descriptor() const { return ::fileno(file_.get()); }
  [[nodiscard]] std::string text() const {
    std::string all;
    std::array<char, 4096> part{};
    std::rewind(file_.get());
    while (const std::size_t got = std::fread(part.data(), 1, part.size(), file_.get())) all.append(part.data(), got);
    return all;
  }

 private:
  struct Close {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };
  std::unique_ptr<std::FILE, Close> file_;
};

struct Actions {
  posix_spawn_file_actions_t files{};
  posix_spawnattr_t how{};
  Actions() {
    posix_spawn_file_actions_init(&files);
    posix_spawnattr_init(&how);
  }
  Actions(const Actions&) = delete;
  Actions& operator=(const Actions&) = delete;
  ~Actions() {
    posix_spawn_file_actions_destroy(&files);
    posix_spawnattr_destroy(&how);
  }
};

}  // namespace

Said run_words(const std::vector<std::string>& words, const std::function<bool()>& stopped) {
  std::vector<std::string> copies = words;
  std::vector<char*> argv;
  for (std::string& word : copies) argv.push_back(word.data());
  argv.push_back(nullptr);

  const Answer out, err;
  Actions actions;
  posix_spawn_file_actions_addopen(&actions.files, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_adddup2(&actions.files, out.descriptor(), STDOUT_FILENO);
  posix_spawn_file_actions_adddup2(&actions.files, err.descriptor(), STDERR_FILENO);
  sigset_t own;
  sigemptyset(&own);
  for (const int number : {SIGPIPE, SIGXFSZ, SIGINT, SIGTERM, SIGHUP}) sigaddset(&own, number);
  posix_spawnattr_setsigdefault(&actions.how, &own);
  posix_spawnattr_setpgroup(&actions.how, 0);
  posix_spawnattr_setflags(&actions.how, POSIX_SPAWN_SETPGROUP | POSIX_SPAWN_SETSIGDEF);

  pid_t child = 0;
  const int failed = ::posix_spawnp(&child, argv[0], &actions.files, &actions.how, argv.data(), environ);
  if (failed == ENOENT || failed == EACCES) return {127, {}, words.front() + ": " + std::strerror(failed)};
  if (failed != 0) throw dem::EnvironmentError("cannot start " + words.front() + ": " + std::strerror(failed));
  int status = 0;
  bool ended_here = false;
  while (true) {
    const pid_t found = ::waitpid(child, &status, WNOHANG);
    if (found == child) break;
    if (found < 0 && errno != EINTR) {
      throw dem::EnvironmentError("lost " + words.front() + ": " + std::strerror(errno));
    }
    if (!ended_here && stopped()) {
      ::kill(-child, SIGKILL);
      ended_here = true;
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  return {WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status), out.text(), err.text()};
}

std::vector<std::string> split_words(std::string_view text, const std::string& option) {
  std::vector<std::string> words;
  std::string word;
  bool inside = false;  // of a word
  char quote = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (quote != 0 && c == quote) {
      quote = 0;
    } else if (c == '\\' && quote != '\'' && i + 1 < text.size()) {
      word += text[++i];
      inside = true;
    } else if (quote == 0 && (c == '\'' || c == '"')) {
      quote = c;
      inside = true;
    } else if (quote == 0 && (c == ' ' || c == '\t' || c == '\n')) {
      if (inside) words.push_back(word);
      word.clear();
      inside = false;
    } else {
      word += c;
      inside = true;
    }
  }
  if (quote != 0) {
    throw dem::InputError({}, option, std::string("the quote ") + quote + " is not closed", "close it");
  }
  if (inside) words.push_back(word);
  return words;
}

}  // namespace cluster
