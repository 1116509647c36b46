#pragma once
// Figures as the page and summary.json see them: drawn, with the files that show them.
#include <optional>
#include <string>
#include <vector>

#include "reports/figure.h"

namespace reports {

/// How high a picture is printed at most, mm, where as many stand beside each other: with what stands below it, a row leaves
/// no page a third empty.
constexpr double highest_picture(int per_row) { return per_row <= 2 ? 54 : 64; }

/// A bar below a picture that tells its scale.
struct ScaleBar {
  std::string text;    ///< "5 mm"
  double percent = 0;  ///< of the picture's width; 0: none
};

/// A panel with what the page needs to show it.
struct DrawnPanel {
  std::string letter{};  ///< "a"; "" when the figure has one panel only
  std::string caption{}, alt{}, label{};
  std::string image{};  ///< file to show, relative to the output folder: "figures/x.svg"; "" for tables
  std::vector<LegendEntry> legend{};
  ScaleBar bar{};
  TextTable table{};  ///< when the panel is a table
  int per_row = 1;
  bool whole_width = false;          ///< see Panel
  std::string note{};                ///< "Drawn from 10 000 of 48 211 points; data/energy.csv has all."
  std::vector<std::string> files{};  ///< relative to the output folder
  int width = 0, height = 0;         ///< of the image, px
};

struct DrawnFigure {
  const Figure* figure = nullptr;
  int number = 0;         ///< from 1, in report order
  std::string mirrors{};  ///< the published figure; "" for another rock than the paper's
  std::string statement{}, finding{}, headline{};
  std::vector<std::string> rows{};       ///< see FigureContent
  std::optional<Agreement> agreement{};  ///< of ours with the statement
  std::string standing{};                ///< the same in words: "Disagrees (2 of 5 missed)."
  bool expected = false;                 ///< see FigureContent
  std::string problem{};                 ///< why it could not be made: "" when it could
  std::vector<DrawnPanel> panels{};
  std::vector<std::string> files{};
};

}  // namespace reports
