#include "reports/output/csv.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <string_view>

namespace reports {
namespace {

/// "-3", "+4.68 %": a number as a spreadsheet reads it.
bool is_number(std::string_view text) {
  if (text.ends_with(" %")) text.remove_suffix(2);
  if (text.starts_with('+') || text.starts_with('-')) text.remove_prefix(1);
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc() && end == text.data() + text.size() && !text.starts_with('-');
}

std::string field(std::string text) {
  // A spreadsheet would compute what begins so; with an apostrophe it is text.
  const bool formula = !text.empty() && std::string_view("=+-@\t\r").find(text.front()) != std::string_view::npos;
  if (formula && !is_number(text)) text.insert(0, 1, '\'');
  if (text.find_first_of(",\"\n\r") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) {
    if (c == '"') quoted += '"';
    quoted += c;
  }
  return quoted + '"';
}

std::string row(const std::vector<std::string>& cells) {
  std::string text;
  for (std::size_t i = 0; i < cells.size(); ++i) text += (i > 0 ? "," : "") + field(cells[i]);
  return text + "\r\n";
}

std::string plain(double value) { return fmt::format("{:.9g}", value); }

const std::string& axis_title(const render::Chart& chart, render::Side side) {
  return side == render::Side::left ? chart.left.title : chart.right.title;
}

void write_bars(const render::Chart& chart, std::string& text) {
  const render::Bars& bars = *chart.bars;
  std::vector<std::string> head{chart.x.title.empty() ? "category" : chart.x.title};
  head.insert(head.end(), bars.labels.begin(), bars.labels.end());
  text += row(head);
  for (std::size_t c = 0; c < bars.categories.size(); ++c) {
    std::vector<std::string> cells{bars.categories[c]};
    for (const auto& values : bars.values) cells.push_back(c < values.size() ? plain(values[c]) : "");
    text += row(cells);
  }
}

void write_series(const render::Chart& chart, std::string& text) {
  const bool errors = std::ranges::any_of(chart.series, [](const auto& s) { return !s.y_error.empty(); });
  const bool sides = std::ranges::any_of(chart.series, [&](const auto& s) { return s.side != chart.series[0].side; });
  std::vector<std::string> head{"series", chart.x.title};
  if (sides) head.push_back("axis");
  head.push_back(sides ? "value" : axis_title(chart, chart.series[0].side));
  if (errors) head.push_back("error");
  text += row(head);
  for (std::size_t i = 0; i < chart.series.size(); ++i) {
    const render::Series& s = chart.series[i];
    const std::string name = s.label.empty() ? "series " + std::to_string(i + 1) : s.label;
    for (std::size_t k = 0; k < std::min(s.x.size(), s.y.size()); ++k) {
      std::vector<std::string> cells{name, plain(s.x[k])};
      if (sides) cells.push_back(axis_title(chart, s.side));
      cells.push_back(plain(s.y[k]));
      if (errors) cells.push_back(k < s.y_error.size() ? plain(s.y_error[k]) : "");
      text += row(cells);
    }
  }
}

void write_bands(const render::Chart& chart, std::string& text) {
  text += row({"band", chart.x.title, "low", "high"});
  for (const render::Band& band : chart.bands) {
    for (std::size_t k = 0; k < band.x.size(); ++k) {
      text += row({band.label, plain(band.x[k]), plain(band.low[k]), plain(band.high[k])});
    }
  }
}

}  // namespace

std::string csv(const render::Chart& chart) {
  std::string text;
  if (chart.bars) write_bars(chart, text);
  if (!chart.series.empty()) {
    if (!text.empty()) text += "\r\n";
    write_series(chart, text);
  }
  if (!chart.bands.empty()) {
    if (!text.empty()) text += "\r\n";
    write_bands(chart, text);
  }
  for (const render::Inset& inset : chart.insets) {
    for (const render::Chart& inner : inset.chart) text += "\r\n" + csv(inner);
  }
  return text;
}

std::string csv(const TextTable& table) {
  std::string text = row(table.head);
  for (const auto& cells : table.rows) text += row(cells);
  return text;
}

}  // namespace reports
