#pragma once
// Text: where its font is, how wide it runs, and the small markup for indices and exponents.
#include <string>
#include <vector>

namespace render {

/// A stretch of text of one size: "σ_{ci}" is "σ" and "ci", set lower and smaller.
struct Piece {
  std::string text;
  double scale = 1;  ///< of the text's size
  double shift = 0;  ///< upwards, as a share of the text's size
};
std::vector<Piece> pieces_of(const std::string& text);

/// Width (px) of text without markup, DejaVu Sans.
double run_width(const std::string& text, double size, bool bold);

/// Path of DejaVu Sans. Throws dem::EnvironmentError naming the package when it is not installed.
const std::string& font_file(bool bold);

}  // namespace render
