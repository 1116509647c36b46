#include "engine/core/random.h"

#include <Random123/philox.h>

#include <bit>
#include <cmath>
#include <numbers>

namespace dem {

std::array<std::uint32_t, 4> philox(std::array<std::uint32_t, 4> counter, std::array<std::uint32_t, 2> key) {
  return std::bit_cast<std::array<std::uint32_t, 4>>(
      philox4x32_R(10, std::bit_cast<philox4x32_ctr_t>(counter), std::bit_cast<philox4x32_key_t>(key)));
}

RandomStream::RandomStream(std::uint64_t seed, Purpose purpose, std::uint32_t substream)
    : seed_(seed), purpose_(static_cast<std::uint32_t>(purpose)), substream_(substream) {}

std::uint64_t RandomStream::bits() {
  // Two 64-bit numbers come out of one block; index / 2 is the block, index % 2 the half.
  const std::uint64_t block = index_ / 2;
  const auto words =
      philox({static_cast<std::uint32_t>(block), static_cast<std::uint32_t>(block >> 32), purpose_, substream_},
             {static_cast<std::uint32_t>(seed_), static_cast<std::uint32_t>(seed_ >> 32)});
  const bool second = index_++ % 2 == 1;
  return second ? (std::uint64_t{words[3]} << 32 | words[2]) : (std::uint64_t{words[1]} << 32 | words[0]);
}

double RandomStream::uniform() { return static_cast<double>(bits() >> 11) * 0x1.0p-53; }

double RandomStream::uniform(double low, double high) { return low + (high - low) * uniform(); }

double RandomStream::normal() {
  const double u = 1.0 - uniform();  // (0, 1]: the logarithm is finite
  const double v = uniform();
  return std::sqrt(-2.0 * std::log(u)) * std::cos(2.0 * std::numbers::pi * v);
}

std::uint64_t RandomStream::below(std::uint64_t n) {
  const std::uint64_t limit = ~std::uint64_t{0} - ~std::uint64_t{0} % n;
  std::uint64_t x = bits();
  while (x >= limit) x = bits();
  return x % n;
}

}  // namespace dem
