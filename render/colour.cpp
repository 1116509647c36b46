#include "render/colour.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace render {
namespace {

double linear(double v) { return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4); }

double encoded(double v) {
  v = std::clamp(v, 0.0, 1.0);
  return v <= 0.0031308 ? 12.92 * v : 1.055 * std::pow(v, 1 / 2.4) - 0.055;
}

using Row = std::array<double, 3>;
using Matrix = std::array<Row, 3>;

Row times(const Matrix& m, const Row& v) {
  Row out{};
  for (std::size_t i = 0; i < 3; ++i) out[i] = m[i][0] * v[0] + m[i][1] * v[1] + m[i][2] * v[2];
  return out;
}

Row linear(const Colour& c) { return {linear(c.red), linear(c.green), linear(c.blue)}; }

double degrees(double radians) { return radians * 180 / std::numbers::pi; }
double cosine(double deg) { return std::cos(deg * std::numbers::pi / 180); }

/// Hue angle, 0 ... 360; 0 for grey.
double hue(double a, double b) {
  if (a == 0 && b == 0) return 0;
  const double h = degrees(std::atan2(b, a));
  return h < 0 ? h + 360 : h;
}

double seventh(double chroma) {
  const double power = std::pow(chroma, 7);
  return std::sqrt(power / (power + std::pow(25.0, 7)));
}

}  // namespace

Colour as_seen(const Colour& colour, Sight sight) {
  // Machado et al. 2009, table 1, for linear RGB.
  static constexpr Matrix no_red{
      {{0.152286, 1.052583, -0.204868}, {0.114503, 0.786281, 0.099216}, {-0.003882, -0.048116, 1.051998}}};
  static constexpr Matrix no_green{
      {{0.367322, 0.860646, -0.227968}, {0.280085, 0.672501, 0.047413}, {-0.011820, 0.042940, 0.968881}}};
  if (sight == Sight::normal) return colour;
  const Row seen = times(sight == Sight::no_red ? no_red : no_green, linear(colour));
  return {encoded(seen[0]), encoded(seen[1]), encoded(seen[2])};
}

Lab lab(const Colour& colour) {
  static constexpr Matrix to_xyz{
      {{0.4124564, 0.3575761, 0.1804375}, {0.2126729, 0.7151522, 0.0721750}, {0.0193339, 0.1191920, 0.9503041}}};
  static constexpr Row white{0.95047, 1, 1.08883};
  const Row xyz = times(to_xyz, linear(colour));
  Row f{};
  for (std::size_t i = 0; i < 3; ++i) {
    const double t = xyz[i] / white[i];
    f[i] = t > 216.0 / 24389 ? std::cbrt(t) : (24389.0 / 27 * t + 16) / 116;
  }
  return {116 * f[1] - 16, 500 * (f[0] - f[1]), 200 * (f[1] - f[2])};
}

double difference(const Lab& one, const Lab& two) {
  const double stretch =
      1 + 0.5 * (1 - seventh((std::hypot(one.a, one.b) + std::hypot(two.a, two.b)) / 2));  // a' of both
  const double a1 = stretch * one.a, a2 = stretch * two.a;
  const double c1 = std::hypot(a1, one.b), c2 = std::hypot(a2, two.b);
  const double h1 = hue(a1, one.b), h2 = hue(a2, two.b);
  double turn = c1 * c2 == 0 ? 0 : h2 - h1;
  if (turn > 180) turn -= 360;
  if (turn < -180) turn += 360;
  const double lightness = two.lightness - one.lightness, chroma = c2 - c1;
  const double across = 2 * std::sqrt(c1 * c2) * std::sin(turn * std::numbers::pi / 360);
  const double mean_l = (one.lightness + two.lightness) / 2, mean_c = (c1 + c2) / 2;
  double mean_h = h1 + h2;
  if (c1 * c2 != 0) mean_h = std::abs(h1 - h2) <= 180 ? mean_h / 2 : (mean_h < 360 ? mean_h + 360 : mean_h - 360) / 2;
  const double t = 1 - 0.17 * cosine(mean_h - 30) + 0.24 * cosine(2 * mean_h) + 0.32 * cosine(3 * mean_h + 6) -
                   0.20 * cosine(4 * mean_h - 63);
  const double off = (mean_l - 50) * (mean_l - 50);
  const double sl = 1 + 0.015 * off / std::sqrt(20 + off), sc = 1 + 0.045 * mean_c, sh = 1 + 0.015 * mean_c * t;
  const double from_blue = (mean_h - 275) / 25;
  const double rotation =
      -std::sin(60 * std::exp(-from_blue * from_blue) * std::numbers::pi / 180) * 2 * seventh(mean_c);
  const double l = lightness / sl, c = chroma / sc, h = across / sh;
  return std::sqrt(l * l + c * c + h * h + rotation * c * h);
}

double difference(const Colour& a, const Colour& b) {
  double least = 1e9;
  for (const Sight sight : sights) least = std::min(least, difference(lab(as_seen(a, sight)), lab(as_seen(b, sight))));
  return least;
}

double luminance(const Colour& colour) {
  const Row c = linear(colour);
  return 0.2126 * c[0] + 0.7152 * c[1] + 0.0722 * c[2];
}

double contrast(const Colour& a, const Colour& b) {
  const double one = luminance(a), two = luminance(b);
  return (std::max(one, two) + 0.05) / (std::min(one, two) + 0.05);
}

}  // namespace render
