#pragma once
// Which vector instructions the hot loops use: the one place where that is chosen. Every kernel gives the same bits with
// every set, so that the choice is one of speed alone.
#include <functional>
#include <optional>
#include <string_view>
#include <vector>

namespace dem {

/// A processor that has one of them has those before it.
enum class InstructionSet {
  sse2,    ///< every x86-64 processor: two doubles at a time
  avx2,    ///< four
  avx512,  ///< F, DQ and VL: eight, and twice the registers
};

/// "sse2", "avx2", "avx512", and back; nothing for another name.
std::string_view name_of(InstructionSet set);
std::optional<InstructionSet> set_of(std::string_view name);

bool processor_has(InstructionSet set);

/// What may be used, narrowest first: all that this processor has. The environment variable DEM_SIMD, for tests and
/// benchmarks, leaves but the set that it names; throws InputError where that is not there.
std::vector<InstructionSet> instruction_sets();
inline InstructionSet widest_set() { return instruction_sets().back(); }

/// The one of instruction_sets() with which work(set) takes least time of this thread: its own time on a processor, and the
/// shortest of `rounds` in which all take turns, so that a busy machine does not decide. Work of some tens of microseconds
/// is enough. Of equals the widest; one set alone is not timed.
InstructionSet fastest_set(const std::function<void(InstructionSet)>& work, int rounds = 7);

/// A function built for each set from one body, which must be `inline __attribute__((always_inline))`. The rest of a source
/// stays in the plainest instructions, and so does whatever the linker keeps of the templates and inline functions in it:
/// flags for a whole source would not give that.
template <auto body>
struct Built;
template <class Result, class... Arguments, Result (*body)(Arguments...)>
struct Built<body> {
  static Result sse2(Arguments... a) { return body(a...); }
  __attribute__((target("avx2"))) static Result avx2(Arguments... a) { return body(a...); }
  __attribute__((target("avx512f"))) static Result avx512(Arguments... a) { return body(a...); }
};

}  // namespace dem
