// How far apart readers see colours: against published pairs, and the palettes of the figures by it.
#include <doctest/doctest.h>

#include <cmath>

#include "render/colour.h"

using render::Colour;
using render::Lab;

TEST_CASE("CIEDE2000 gives the differences of Sharma, Wu & Dalal 2005, table 1") {
  struct Pair {
    Lab one, two;
    double difference;
  };
  const Pair pairs[] = {{{50, 2.6772, -79.7751}, {50, 0, -82.7485}, 2.0425},
                        {{50, 3.1571, -77.2803}, {50, 0, -82.7485}, 2.8615},
                        {{50, 2.8361, -74.0200}, {50, 0, -82.7485}, 3.4412},
                        {{50, -1.3802, -84.2814}, {50, 0, -82.7485}, 1.0000},
                        {{50, 0, 0}, {50, -1, 2}, 2.3669},
                        {{50, 2.4900, -0.0010}, {50, -2.4900, 0.0009}, 7.1792},
                        {{50, 2.4900, -0.0010}, {50, -2.4900, 0.0011}, 7.2195},
                        {{50, -0.0010, 2.4900}, {50, 0.0009, -2.4900}, 4.8045},
                        {{50, -0.0010, 2.4900}, {50, 0.0011, -2.4900}, 4.7461},
                        {{50, 2.5, 0}, {50, 0, -2.5}, 4.3065},
                        {{50, 2.5, 0}, {73, 25, -18}, 27.1492},
                        {{50, 2.5, 0}, {61, -5, 29}, 22.8977},
                        {{50, 2.5, 0}, {56, -27, -3}, 31.9030},
                        {{50, 2.5, 0}, {58, 24, 15}, 19.4535},
                        {{60.2574, -34.0099, 36.2677}, {60.4626, -34.1751, 39.4387}, 1.2644},
                        {{63.0109, -31.0961, -5.8663}, {62.8187, -29.7946, -4.0864}, 1.2630},
                        {{61.2901, 3.7196, -5.3901}, {61.4292, 2.2480, -4.9620}, 1.8731},
                        {{35.0831, -44.1164, 3.7933}, {35.0232, -40.0716, 1.5901}, 1.8645},
                        {{22.7233, 20.0904, -46.6940}, {23.0331, 14.9730, -42.5619}, 2.0373},
                        {{36.4612, 47.8580, 18.3852}, {36.2715, 50.5065, 21.2231}, 1.4146},
                        {{90.8027, -2.0831, 1.4410}, {91.1528, -1.6435, 0.0447}, 1.4441},
                        {{6.7747, -0.2908, -2.4247}, {5.8714, -0.0985, -2.2286}, 0.6377},
                        {{2.0776, 0.0795, -1.1350}, {0.9033, -0.0636, -0.5514}, 0.9082}};
  for (const Pair& pair : pairs) {
    CHECK(render::difference(pair.one, pair.two) == doctest::Approx(pair.difference).epsilon(1e-4));
    CHECK(render::difference(pair.two, pair.one) == doctest::Approx(render::difference(pair.one, pair.two)));
  }
}

TEST_CASE("sRGB to CIELAB and contrast at known colours") {
  CHECK(render::lab({1, 1, 1}).lightness == doctest::Approx(100).epsilon(1e-4));
  CHECK(render::lab({0, 0, 0}).lightness == doctest::Approx(0));
  const Lab red = render::lab({1, 0, 0});
  CHECK(red.lightness == doctest::Approx(53.24).epsilon(1e-3));
  CHECK(red.a == doctest::Approx(80.09).epsilon(1e-3));
  CHECK(red.b == doctest::Approx(67.20).epsilon(1e-3));
  CHECK(render::contrast({0, 0, 0}, {1, 1, 1}) == doctest::Approx(21));
  const double grey = 119 / 255.0;  // the lightest grey that small text on white may have is #767676
  CHECK(render::contrast({grey, grey, grey}, {1, 1, 1}) < 4.5);
}

TEST_CASE("without red or green cones red and green come near each other, and greys stay") {
  const Colour red{0.80, 0.35, 0.25}, green{0.52, 0.52, 0.24};
  const double normal = render::difference(render::lab(red), render::lab(green));
  for (const render::Sight sight : {render::Sight::no_red, render::Sight::no_green}) {
    const Lab one = render::lab(render::as_seen(red, sight)), two = render::lab(render::as_seen(green, sight));
    CHECK(render::difference(one, two) < 0.6 * normal);
    const Colour grey = render::as_seen({0.5, 0.5, 0.5}, sight);
    CHECK(grey.red == doctest::Approx(0.5).epsilon(0.01));
    CHECK(grey.blue == doctest::Approx(0.5).epsilon(0.01));
  }
}

TEST_CASE("any two colours of the palette are 15 apart for every reader, and thin lines of them show on white") {
  for (std::size_t i = 0; i < 7; ++i) {
    CHECK(render::contrast(render::palette(i), {1, 1, 1}) >= 3);
    for (std::size_t j = 0; j < i; ++j) {
      CAPTURE(i);
      CAPTURE(j);
      CHECK(render::difference(render::palette(i), render::palette(j)) >= 15);
    }
  }
}

TEST_CASE("fills of an ordered series grow darker by steps that grey print shows") {
  for (std::size_t count = 2; count <= 4; ++count)
    for (std::size_t i = 1; i < count; ++i) {
      const Colour one = render::ordered(i - 1, count), two = render::ordered(i, count);
      CHECK(render::difference(one, two) >= 15);
      CHECK(render::lab(one).lightness - render::lab(two).lightness >= 10);
    }
}
