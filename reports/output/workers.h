#pragma once
// Independent pieces of work in processes forked from this one: an off-screen GL context serves one thread, so pictures are
// drawn side by side in processes. They share the parent's memory as it was; what a piece found comes back in shared memory.
#include <algorithm>
#include <cstddef>
#include <functional>
#include <type_traits>
#include <vector>

#include "engine/core/errors.h"

namespace reports {

/// A process of in_processes() was ended by a signal, or by a library.
struct ProcessEnded : dem::EnvironmentError {
  using dem::EnvironmentError::EnvironmentError;
};

/// `work(piece, result)` for every piece in [0, count), `size` bytes of result each, in up to `workers` processes that take
/// the next piece when they are free. Results stand in the order of the pieces, whoever did them.
/// `taken` is told now and then how many pieces have been taken.
/// When `stopped` says so, or somebody ends one of the processes with SIGTERM, SIGINT or SIGHUP, all are ended and
/// dem::Interrupted is thrown.
/// Throws dem::EnvironmentError for the first one that a piece threw, std::runtime_error for the first other error,
/// ProcessEnded when a process is ended by a signal, and dem::EnvironmentError when none can be made, when a piece gets no
/// more threads, or when a process only waits for 20 s: pieces compute. All processes have ended by then.
std::vector<std::byte> in_processes(
    std::size_t count, std::size_t size, int workers,
    const std::function<void(std::size_t piece, std::byte* result)>& work,
    const std::function<bool()>& stopped = [] { return false; }, const std::function<void(std::size_t)>& taken = {});

/// The same with results of a type that is its bytes.
template <class Result, class Work>
std::vector<Result> in_processes(
    std::size_t count, int workers, const Work& work, const std::function<bool()>& stopped = [] { return false; },
    const std::function<void(std::size_t)>& taken = {}) {
  static_assert(std::is_trivially_copyable_v<Result>);
  const auto one = [&](std::size_t piece, std::byte* to) {
    const Result result = work(piece);
    std::copy_n(reinterpret_cast<const std::byte*>(&result), sizeof(Result), to);
  };
  const auto bytes = in_processes(count, sizeof(Result), workers, one, stopped, taken);
  std::vector<Result> results(count);
  std::copy(bytes.begin(), bytes.end(), reinterpret_cast<std::byte*>(results.data()));
  return results;
}

}  // namespace reports
