#pragma once
// The data of a panel as CSV (RFC 4180, UTF-8): a table a file, one row of heads with their units, numbers as numbers.
// Always complete, whatever the picture shows.
#include <functional>
#include <string>
#include <vector>

#include "reports/figure.h"

namespace reports {

/// A file of a chart. Bars, curves, bands, marks and insets have a table each.
struct CsvTable {
  std::string suffix;                 ///< of the file's name: "" for the first, "marks", "inset"
  std::function<std::string()> text;  ///< its text; the chart must live
};

/// The tables of a chart:
///   bars    a row a category, a column a label
///   curves  a row a point: series, x, a column for each value axis and for each of these what is published and the half
///           lengths of error bars, where there are any
///   bands   a row a point: band, x, low, high
///   marks   a row a mark: its label, x and y
std::vector<CsvTable> csv_tables(const render::Chart& chart);

/// A table of texts: a cell of one number is that number, its unit goes to the head; "a ± b", "a (b to c)", "a to b" and
/// "a / b" have a column for each. Units that differ from row to row, and texts among numbers, have columns of their own.
std::string csv(const TextTable& table);

}  // namespace reports
