#pragma once
// Counter-based random numbers: Philox 4x32-10 (Salmon et al. 2011, "Parallel random numbers: as easy as 1, 2, 3"), by the
// authors' own Random123.
// A number depends on (seed, purpose, substream, index) only, never on how many were drawn elsewhere.
#include <array>
#include <cstdint>

namespace dem {

/// Every random stream of the program, in one list. Values are part of the results: never reuse one.
enum class Purpose : std::uint32_t {
  packing_radii = 1,
  packing_positions = 2,
  grain_seed_sizes = 3,
  grain_seed_positions = 4,
  sheet_grain_centres = 20,
  sheet_grain_stiffness = 21,
  sheet_spring_thresholds = 22,
  random_cracks = 40,
  law_draws = 41,
  test_data = 100,
};

/// A sequential view of one stream.
class RandomStream {
 public:
  RandomStream(std::uint64_t seed, Purpose purpose, std::uint32_t substream = 0);
  std::uint64_t bits();                     ///< 64 random bits
  double uniform();                         ///< [0, 1), 53 bits
  double uniform(double low, double high);  ///< [low, high)
  double normal();                          ///< mean 0, standard deviation 1 (Box-Muller, no caching)
  std::uint64_t below(std::uint64_t n);     ///< 0 ... n-1, unbiased

 private:
  std::uint64_t seed_;
  std::uint32_t purpose_;
  std::uint32_t substream_;
  std::uint64_t index_ = 0;
};

/// The raw block cipher: four words from a 128-bit counter and a 64-bit key.
std::array<std::uint32_t, 4> philox(std::array<std::uint32_t, 4> counter, std::array<std::uint32_t, 2> key);

}  // namespace dem
