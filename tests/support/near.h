#pragma once
// Comparison relative to the value itself. doctest's own Approx adds 1 to the larger of the two sides before it takes its
// share: a displacement of 1e-9 m would equal anything of its kind.
#include <doctest/doctest.h>

namespace test {

/// Use as near(expected).epsilon(share). Nothing is near zero: compare with a bound instead.
inline doctest::Approx near(double expected) { return doctest::Approx(expected).scale(0); }

}  // namespace test
