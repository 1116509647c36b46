#include "reports/output/workers.h"

#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <new>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <string>
#include <system_error>
#include <thread>

#include "engine/core/errors.h"
#include "engine/core/limits.h"
#include "engine/model/model.h"
#include "reports/output/child.h"

namespace reports {
namespace {

// Pieces compute from their first moment to their last. Mesa waits for ever for threads that it could not begin: a
// process that only waits for 20 looks, a second or more apart, is given up.
constexpr int turns_a_look = 200;  // of 5 ms
constexpr int patience = 20;
constexpr const char* stood_still =
    "a process that drew pictures has stood still for 20 s, as graphics libraries do that get no more threads: try "
    "fewer --threads, or raise the limits (ulimit -u, ulimit -v)";

enum class Ending { none, environment, ended, other };

/// What parent and children share beside the results.
struct Board {
  std::atomic<std::size_t> next{0};  // piece to take
  std::atomic<bool> failed{false};   // taken by the first child that fails: the message is its own
  Ending ending = Ending::none;
  std::array<char, 2048> message{};
};
static_assert(std::atomic<std::size_t>::is_always_lock_free && std::atomic<bool>::is_always_lock_free);

/// Memory that stays one between this process and those forked from it.
class SharedMemory {
 public:
  explicit SharedMemory(std::size_t size) : size_(size) {
    void* at = mmap(nullptr, size, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    if (at == MAP_FAILED) throw dem::EnvironmentError(std::string("no memory to draw in: ") + std::strerror(errno));
    at_ = static_cast<std::byte*>(at);
  }
  ~SharedMemory() { munmap(at_, size_); }
  SharedMemory(const SharedMemory&) = delete;
  SharedMemory& operator=(const SharedMemory&) = delete;
  [[nodiscard]] std::byte* at(std::size_t offset) const { return at_ + offset; }

 private:
  std::byte* at_ = nullptr;
  std::size_t size_ = 0;
};

void leave(Board& board, Ending ending, const char* message) {
  if (board.failed.exchange(true)) return;
  board.ending = ending;
  std::strncpy(board.message.data(), message, board.message.size() - 1);
}

/// A child's life: it never returns, and ends without the parent's destructors and exit handlers.
[[noreturn]] void serve(Board& board, std::size_t count, const std::function<void(std::size_t)>& work, pid_t parent) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);  // nobody would fetch the results
  if (getppid() != parent) _exit(0);
  try {
    for (std::size_t piece = board.next++; piece < count && !board.failed; piece = board.next++) work(piece);
  } catch (const dem::EnvironmentError& error) {
    leave(board, Ending::environment, error.what());
  } catch (const std::bad_alloc&) {
    leave(board, Ending::environment, "out of memory while drawing; try a smaller --scale or --threads 1");
  } catch (const std::exception& error) {
    // VTK's threads (TBB) throw a bare runtime_error that names the function.
    const std::string what = error.what();
    const auto* refused = dynamic_cast<const std::system_error*>(&error);
    const bool few = (refused != nullptr && refused->code() == std::errc::resource_unavailable_try_again) ||
                     what.starts_with("pthread_create");
    const std::string words = few ? "the machine has no more threads or memory to draw with (" + what + "): try " +
                                        "--threads 1, or raise the limits (ulimit -u, ulimit -v)"
                                  : what;
    leave(board, few ? Ending::environment : Ending::other, words.c_str());
  }
  _exit(0);
}

/// Ticks of computing of a process that only waits, as its first thread does; nothing for one that works or is stopped.
std::optional<std::uint64_t> waits_after(pid_t process) {
  std::ifstream file("/proc/" + std::to_string(process) + "/stat");
  std::string line;
  std::getline(file, line);
  const std::size_t name_end = line.rfind(')');  // the name may hold anything
  if (name_end == std::string::npos) return {};
  std::istringstream fields(line.substr(name_end + 1));
  std::string state, skipped;
  fields >> state;
  for (int field = 4; field < 14; ++field) fields >> skipped;
  std::uint64_t user = 0, system = 0;
  if (!(fields >> user >> system) || state != "S") return {};
  return user + system;
}

/// The processes that are left; they end with this.
class Children {
 public:
  Children() = default;
  Children(const Children&) = delete;
  Children& operator=(const Children&) = delete;
  ~Children() {
    for (const Child& child : left_) ::kill(child.process, SIGKILL);
    for (const Child& child : left_) {
      while (waitpid(child.process, nullptr, 0) < 0 && errno == EINTR) {
      }
    }
  }
  void add(pid_t child) { left_.push_back({child}); }
  [[nodiscard]] std::size_t size() const { return left_.size(); }
  /// Calls `ended` with the status of each that has ended since the last call.
  void look(const std::function<void(int status)>& ended) {
    std::erase_if(left_, [&](const Child& child) {
      int status = 0;
      const pid_t found = waitpid(child.process, &status, WNOHANG);
      if (found == 0 || (found < 0 && errno == EINTR)) return false;
      ended(found == child.process ? status : -1);
      return true;
    });
  }
  /// Whether one has only waited since so many calls. Calls are counted and no time, which also goes on while all of
  /// these processes are stopped.
  bool stands_still(int calls) {
    for (Child& child : left_) {
      const auto after = waits_after(child.process);
      child.still = after && after == child.after ? child.still + 1 : 0;
      child.after = after;
      if (child.still >= calls) return true;
    }
    return false;
  }

 private:
  struct Child {
    pid_t process = 0;
    std::optional<std::uint64_t> after = {};  // ticks of computing at the last call
    int still = 0;                            // calls since it only waits
  };
  std::vector<Child> left_;
};

// Graphics libraries do not ask whether they were given the memory that they wanted.
std::string hint_at_memory(int number) {
  const std::string limit = dem::memory_limit();
  if (limit.empty() || (number != SIGSEGV && number != SIGBUS && number != SIGABRT)) return {};
  return ", as graphics libraries are that run out of memory: " + limit;
}

std::string ending_of(int status) {
  if (!WIFSIGNALED(status)) return "an error";
  const int number = WTERMSIG(status);
  return "signal " + std::to_string(number) + " (" + strsignal(number) + ")" +
         (number == SIGKILL ? ", as a machine does that is out of memory" : "") + hint_at_memory(number);
}

}  // namespace

std::vector<std::byte> in_processes(std::size_t count, std::size_t size, int workers,
                                    const std::function<void(std::size_t piece, std::byte* result)>& work,
                                    const std::function<bool()>& stopped,
                                    const std::function<void(std::size_t)>& taken) {
  constexpr std::size_t results_from = (sizeof(Board) + 63) / 64 * 64;
  const SharedMemory memory(results_from + count * size);
  Board& board = *new (memory.at(0)) Board;
  const auto one = [&](std::size_t piece) { work(piece, memory.at(results_from + piece * size)); };

  Children children;
  const pid_t parent = getpid();
  while (children.size() < std::min(static_cast<std::size_t>(std::max(1, workers)), count)) {
    const pid_t child = fork_for_work();
    if (child == 0) serve(board, count, one, parent);
    if (child < 0) break;  // fewer will do
    children.add(child);
  }
  if (children.size() == 0 && count > 0) {
    throw dem::EnvironmentError(std::string("no process can be made to draw in: ") + std::strerror(errno));
  }
  int signal = 0;
  const auto look_at = [&](int status) {
    if (status == 0) return;
    if (WIFSIGNALED(status) && signal == 0) signal = WTERMSIG(status);
    leave(board, Ending::ended, ("a process that drew pictures was ended by " + ending_of(status)).c_str());
  };
  for (int turn = 1; children.size() > 0; ++turn) {
    if (stopped()) throw dem::Interrupted{};
    children.look(look_at);
    throw_if_asked_to_end(signal);
    if (taken) taken(std::min(board.next.load(), count));
    if (turn % turns_a_look == 0 && children.stands_still(patience)) throw dem::EnvironmentError(stood_still);
    if (children.size() > 0) std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  if (stopped()) throw dem::Interrupted{};
  if (board.ending == Ending::environment) throw dem::EnvironmentError(board.message.data());
  if (board.ending == Ending::ended) throw ProcessEnded(board.message.data());
  if (board.ending == Ending::other) throw std::runtime_error(board.message.data());
  const std::byte* results = memory.at(results_from);
  return {results, results + count * size};
}

}  // namespace reports
