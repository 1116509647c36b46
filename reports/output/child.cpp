#include "reports/output/child.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <thread>

#include "engine/core/errors.h"
#include "engine/model/model.h"

namespace reports {
namespace {

std::vector<char*> pointers(std::vector<std::string>& texts) {
  std::vector<char*> all;
  for (std::string& text : texts) all.push_back(text.data());
  all.push_back(nullptr);
  return all;
}

/// What a forked process needs, all of it made before the fork: other threads may hold the locks of the memory.
struct Prepared {
  const char* path;
  char* const* words;
  char* const* environment;
  const char* folder;
  const char* log;
};

void say(const char* text) {
  if (::write(STDERR_FILENO, text, std::strlen(text)) < 0) return;
}

[[noreturn]] void become(const Prepared& program) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  for (const int number : {SIGPIPE, SIGXFSZ, SIGINT, SIGTERM, SIGHUP}) ::signal(number, SIG_DFL);
  ::execve(program.path, program.words, program.environment);
  say(program.path);
  say(" cannot be started: ");
  say(::strerrordesc_np(errno));
  say("\n");
  ::_exit(127);
}

/// Stands between: starts the program, ends as it ends, and ends the whole group when nobody holds the other end of
/// `alive` any more.
[[noreturn]] void guard(const Prepared& program, int alive) {
  ::setpgid(0, 0);
  const int null = ::open("/dev/null", O_RDONLY);
  const int log = ::open(program.log, O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0600);
  if (null < 0 || log < 0 || ::dup2(null, STDIN_FILENO) < 0 || ::dup2(log, STDOUT_FILENO) < 0 ||
      ::dup2(log, STDERR_FILENO) < 0 || ::chdir(program.folder) != 0) {
    ::_exit(127);
  }
  const pid_t worker = ::fork();
  if (worker < 0) {
    say("no process can be made: ");
    say(::strerrordesc_np(errno));
    say("\n");
    ::_exit(127);
  }
  if (worker == 0) become(program);
  while (true) {
    int status = 0;
    if (::waitpid(worker, &status, WNOHANG) == worker) {
      if (WIFEXITED(status)) ::_exit(WEXITSTATUS(status));
      ::signal(WTERMSIG(status), SIG_DFL);
      ::raise(WTERMSIG(status));
      ::_exit(128 + WTERMSIG(status));
    }
    pollfd end{alive, POLLIN, 0};
    if (::poll(&end, 1, 20) > 0) ::kill(0, SIGKILL);
  }
}

class Pipe {
 public:
  Pipe() {
    if (::pipe2(ends_.data(), O_CLOEXEC) != 0) {
      throw dem::EnvironmentError(std::string("no pipe can be made: ") + std::strerror(errno));
    }
  }
  Pipe(const Pipe&) = delete;
  Pipe& operator=(const Pipe&) = delete;
  ~Pipe() {
    for (const int end : ends_) ::close(end);
  }
  [[nodiscard]] int read_end() const { return ends_[0]; }
  [[nodiscard]] int write_end() const { return ends_[1]; }

 private:
  std::array<int, 2> ends_{-1, -1};
};

/// The group, until this goes.
class Group {
 public:
  explicit Group(pid_t leader) : leader_(leader) {}
  Group(const Group&) = delete;
  Group& operator=(const Group&) = delete;
  ~Group() {
    ::kill(-leader_, SIGKILL);
    if (ended_) return;
    while (::waitpid(leader_, &status_, 0) < 0 && errno == EINTR) {
    }
  }
  [[nodiscard]] bool ended() {
    const pid_t found = ended_ ? leader_ : ::waitpid(leader_, &status_, WNOHANG);
    if (found < 0 && errno != EINTR) {
      throw dem::EnvironmentError(std::string("a process is lost: ") + std::strerror(errno));
    }
    ended_ = found == leader_;
    return ended_;
  }
  [[nodiscard]] int status() const { return status_; }

 private:
  pid_t leader_;
  bool ended_ = false;
  int status_ = 0;
};

}  // namespace

int fork_for_work() {
  sigset_t asking, before;
  sigemptyset(&asking);
  for (const int number : {SIGINT, SIGTERM, SIGHUP}) sigaddset(&asking, number);
  pthread_sigmask(SIG_BLOCK, &asking, &before);
  const pid_t child = ::fork();
  const int failed = errno;
  if (child == 0) {
    for (const int number : {SIGINT, SIGTERM, SIGHUP}) ::signal(number, SIG_DFL);
  }
  pthread_sigmask(SIG_SETMASK, &before, nullptr);
  errno = failed;
  return child;
}

void throw_if_asked_to_end(int signal) {
  if (signal == SIGTERM || signal == SIGINT || signal == SIGHUP) throw dem::Interrupted{.signal = signal};
}

ChildEnd run_child(const ChildProgram& program, double seconds, const std::function<bool()>& stopped) {
  std::vector<std::string> words = {program.path}, variables = program.environment;
  words.insert(words.end(), program.words.begin(), program.words.end());
  const std::vector<char*> word_pointers = pointers(words), variable_pointers = pointers(variables);
  const Prepared prepared{program.path.c_str(), word_pointers.data(), variable_pointers.data(), program.folder.c_str(),
                          program.log.c_str()};
  const Pipe alive;
  const pid_t leader = fork_for_work();
  if (leader < 0) throw dem::EnvironmentError(std::string("no process can be made: ") + std::strerror(errno));
  if (leader == 0) {
    ::close(alive.write_end());
    guard(prepared, alive.read_end());
  }
  ::setpgid(leader, leader);  // whoever is first
  Group group(leader);
  using Clock = std::chrono::steady_clock;
  const auto begin = Clock::now();
  while (!group.ended()) {
    if (stopped()) throw dem::Interrupted{};
    if (std::chrono::duration<double>(Clock::now() - begin).count() > seconds) return {.late = true};
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  if (stopped()) throw dem::Interrupted{};
  if (!WIFSIGNALED(group.status())) return {.code = WEXITSTATUS(group.status())};
  throw_if_asked_to_end(WTERMSIG(group.status()));
  return {.signal = WTERMSIG(group.status())};
}

}  // namespace reports
