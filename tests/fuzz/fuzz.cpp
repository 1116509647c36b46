#include "tests/fuzz/fuzz.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sanitizer/common_interface_defs.h>
#include <sys/time.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iterator>

#include "engine/core/errors.h"
#include "engine/core/random.h"

// Deep histories of each block and a quarter of a gigabyte kept from reuse cost more than reading does. An input that is kept
// tells more when it is read again with ASAN_OPTIONS of one's own.
// NOLINTNEXTLINE(bugprone-reserved-identifier): the name that the sanitizer asks for
extern "C" const char* __asan_default_options() { return "malloc_context_size=2:quarantine_size_mb=4"; }

namespace dem_fuzz {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t longest = 1 << 15;
constexpr int patience = 20;  // s of computing: other programs may keep the machine busy

// For handlers, which may not ask for memory: the input at hand and where it goes.
const std::string* at_hand = nullptr;
char keep_at[256] = "";

extern "C" void keep_input() {
  const int file = open(keep_at, O_WRONLY | O_CREAT | O_TRUNC, 0644);
  if (file < 0 || at_hand == nullptr) return;
  if (write(file, at_hand->data(), at_hand->size()) >= 0)
    (void)!write(STDERR_FILENO, keep_at, std::char_traits<char>::length(keep_at));
  (void)!write(STDERR_FILENO, "\n", 1);
  close(file);
}

void wait_for(int seconds) {
  const itimerval time{{0, 0}, {seconds, 0}};
  setitimer(ITIMER_PROF, &time, nullptr);
}

extern "C" void on_alarm(int) {
  constexpr char words[] = "computes longer than 20 s: ";
  (void)!write(STDERR_FILENO, words, sizeof words - 1);
  keep_input();
  _exit(1);
}

std::string content(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

const std::vector<std::string> numbers = {"0",
                                          "-1",
                                          "1",
                                          "2",
                                          "3",
                                          "1e308",
                                          "-1e308",
                                          "1e-320",
                                          "nan",
                                          "inf",
                                          "-inf",
                                          "0.5",
                                          "1e9",
                                          "65536",
                                          "2147483648",
                                          "-9223372036854775808",
                                          "9223372036854775807",
                                          "18446744073709551616",
                                          "0x7f",
                                          "007",
                                          "1_000",
                                          "1e",
                                          ".5",
                                          "- 1",
                                          "99999999999999999999"};

class Mutator {
 public:
  Mutator(const Harness& harness, std::uint64_t seed, std::uint64_t index)
      : harness_(harness),
        random_(seed + (index >> 32), dem::Purpose::test_data, static_cast<std::uint32_t>(index)),
        text_(pick(harness.corpus)) {}

  std::string input() {
    const bool mildly = random_.below(2) == 0;
    for (auto changes = 1 + random_.below(mildly ? 3 : 6); changes > 0; --changes) mildly ? change_mildly() : change();
    if (text_.size() > longest) text_.resize(longest);
    return std::move(text_);
  }

 private:
  std::size_t below(std::size_t n) { return static_cast<std::size_t>(random_.below(n)); }
  const std::string& pick(const std::vector<std::string>& from) { return from[below(from.size())]; }
  std::size_t place() { return below(text_.size() + 1); }
  std::size_t some(std::size_t from) { return std::min(text_.size() - from, 1 + below(1 + below(64))); }

  // The beginning and length of a line.
  std::pair<std::size_t, std::size_t> line() {
    const std::size_t at = place();
    const std::size_t before = at == 0 ? std::string::npos : text_.rfind('\n', at - 1);
    const std::size_t begin = before == std::string::npos ? 0 : before + 1;
    const std::size_t end = std::min(text_.find('\n', begin), text_.size());
    return {begin, std::min(end + 1, text_.size()) - begin};
  }

  // The beginning and length of a number; length 0: there is none.
  std::pair<std::size_t, std::size_t> number() {
    const std::size_t digit = text_.find_first_of("0123456789", place());
    if (digit == std::string::npos) return {0, 0};
    const std::size_t begin = text_.find_last_not_of("0123456789.eE+-", digit);
    const std::size_t from = begin == std::string::npos ? 0 : begin + 1;
    return {from, std::min(text_.find_first_not_of("0123456789.eE+-", digit), text_.size()) - from};
  }

  void replace_number(const std::string& by) {
    const auto [from, length] = number();
    if (length > 0) text_.replace(from, length, by);
  }

  // From half of it to twice as much; a whole number stays whole.
  void scale_number() {
    const auto [from, length] = number();
    if (length == 0) return;
    const std::string word = text_.substr(from, length);
    const double scaled = std::strtod(word.c_str(), nullptr) * random_.uniform(0.5, 2);
    const bool whole = word.find_first_of(".eE") == std::string::npos;
    text_.replace(from, length, whole ? fmt::format("{:.0f}", scaled) : fmt::format("{:.6g}", scaled));
  }

  void change_mildly() {
    const std::size_t kind = below(12);
    if (kind == 0) {
      const auto [begin, length] = line();
      text_.erase(begin, length);
    } else if (kind < 9 && !harness_.lines.empty()) {
      text_ += pick(harness_.lines);
    } else {
      scale_number();
    }
  }

  void change() {
    if (text_.empty()) text_ = pick(harness_.corpus);
    const std::size_t at = place();
    switch (random_.below(12)) {
      case 0:
        if (at < text_.size()) text_[at] = static_cast<char>(text_[at] ^ (1 << below(8)));
        break;
      case 1:
        if (at < text_.size()) text_[at] = static_cast<char>(below(256));
        break;
      case 2:
        text_.erase(at, some(at));
        break;
      case 3:
        text_.insert(place(), text_.substr(at, some(at)));
        break;
      case 4:
        text_.insert(at, harness_.words.empty() ? " " : pick(harness_.words));
        break;
      case 5:
      case 6:
        replace_number(pick(numbers));
        break;
      case 7: {
        const auto [begin, length] = line();
        text_.erase(begin, length);
        break;
      }
      case 8: {
        const auto [begin, length] = line();
        const std::string moved = text_.substr(begin, length);
        if (random_.below(2) == 0) text_.erase(begin, length);
        text_.insert(line().first, moved);
        break;
      }
      case 9: {
        const std::string& other = pick(harness_.corpus);
        const std::size_t from = below(other.size() + 1);
        text_.replace(at, some(at), other.substr(from, 1 + below(200)));
        break;
      }
      case 10:
        text_.resize(at);
        break;
      default:
        text_.insert(at, 1 + below(8), static_cast<char>(below(256)));
    }
  }

  const Harness& harness_;
  dem::RandomStream random_;
  std::string text_;
};

// Whether the reader took it; what was no refusal goes on.
bool read(const Harness& harness, const std::string& input) {
  at_hand = &input;
  wait_for(patience);
  bool taken = false;
  try {
    harness.read(input);
    taken = true;
  } catch (const dem::InputError&) {
  } catch (const dem::EnvironmentError&) {
  }
  wait_for(0);
  return taken;
}

}  // namespace

std::vector<std::string> corpus(const std::string& folder) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(fs::path(DEM_SOURCE_DIR) / "tests/fuzz/corpus" / folder)) {
    files.push_back(entry.path());
  }
  std::ranges::sort(files);
  std::vector<std::string> texts;
  for (const fs::path& file : files) texts.push_back(content(file));
  return texts;
}

int run(int argc, char** argv, const Harness& harness) {
  __sanitizer_set_death_callback(keep_input);
  std::signal(SIGPROF, on_alarm);
  if (argc > 1 && fs::exists(argv[1])) {
    const std::string input = content(argv[1]);
    std::snprintf(keep_at, sizeof keep_at, "/dev/null");
    fmt::print("{}\n", read(harness, input) ? "read" : "refused");
    return 0;
  }
  const std::uint64_t inputs = argc > 1 ? std::stoull(argv[1]) : 10000, seed = argc > 2 ? std::stoull(argv[2]) : 1;
  std::uint64_t taken = 0, defects = 0;
  for (std::uint64_t i = 0; i < inputs; ++i) {
    const std::string input = Mutator(harness, seed, i).input();
    std::snprintf(keep_at, sizeof keep_at, "fuzz_%s_%llu_%llu", harness.name.c_str(),
                  static_cast<unsigned long long>(seed), static_cast<unsigned long long>(i));
    try {
      taken += read(harness, input) ? 1 : 0;
    } catch (const std::exception& error) {
      ++defects;
      fmt::print("input {} of seed {}: {}: ", i, seed, error.what());
      std::fflush(stdout);
      keep_input();
    }
  }
  fmt::print("{}: {} inputs of seed {}, {} read, {} refused, {} defects\n", harness.name, inputs, seed, taken,
             inputs - taken - defects, defects);
  return defects == 0 ? 0 : 1;
}

}  // namespace dem_fuzz
