#pragma once
// "Did you mean": the nearest of some known words.
#include <cstddef>
#include <span>
#include <string>
#include <string_view>

namespace dem {

/// Number of letters to insert, drop, change or swap with a neighbour to get from `a` to `b` (optimal string
/// alignment).
std::size_t edit_distance(std::string_view a, std::string_view b);

/// The candidate nearest to `word`; "" when none is near (more than a third of the letters differ).
std::string closest(std::string_view word, std::span<const std::string> candidates);

/// "a, b, c"
std::string joined(std::span<const std::string> words);

/// What to say of an unknown word: "did you mean 'x'? " when one is near, then "known: a, b, c".
std::string advice(std::string_view word, std::span<const std::string> candidates, std::string_view known = "known");

}  // namespace dem
