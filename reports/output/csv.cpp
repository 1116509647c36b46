#include "reports/output/csv.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <string_view>

#include "reports/output/csv_cells.h"

namespace reports {
namespace {

std::string field(std::string text) {
  // A spreadsheet would compute what begins so; with an apostrophe it is text.
  const bool formula = !text.empty() && std::string_view("=+-@\t\r").find(text.front()) != std::string_view::npos;
  if (formula && !cell_numbers(text)) text.insert(0, 1, '\'');
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

std::string plain(double value) { return std::isfinite(value) ? fmt::format("{:.9g}", value) : ""; }

/// Without the marks of indices and exponents: "σ_{ci}" is "σ_ci".
std::string without_marks(std::string_view text) {
  std::string kept;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const bool opens = text[i] == '{' && i > 0 && (text[i - 1] == '_' || text[i - 1] == '^');
    const std::size_t close = opens ? text.find('}', i) : std::string_view::npos;
    if (close == std::string_view::npos) {
      kept += text[i];
    } else {
      kept += text.substr(i + 1, close - i - 1);
      i = close;
    }
  }
  return kept;
}

std::string title_of(const render::Axis& axis, std::string_view otherwise) {
  return axis.title.empty() ? std::string(otherwise) : without_marks(axis.title);
}

/// "(MPa)" of "Strength (MPa)"; "" when there is none.
std::string unit_of(const std::string& title) {
  const std::size_t open = title.rfind(" (");
  return open != std::string::npos && title.ends_with(')') ? title.substr(open) : "";
}

/// Heads that are told apart.
std::vector<std::string> unlike(std::vector<std::string> heads) {
  std::map<std::string, int> seen;
  for (std::string& head : heads) {
    const int n = ++seen[head];
    if (n > 1) head += " " + std::to_string(n);
  }
  return heads;
}

bool is_published(const std::string& label) { return label.find("ublished") != std::string::npos; }

std::string bars_text(const render::Chart& chart) {
  const render::Bars& bars = *chart.bars;
  const std::string unit = unit_of(title_of(bars.side == render::Side::left ? chart.left : chart.right, ""));
  const auto ours = [&](std::size_t i) { return i < bars.errors.size() && !bars.errors[i].empty(); };
  std::vector<std::string> head{title_of(chart.x, "category")};
  for (std::size_t i = 0; i < bars.values.size(); ++i) {
    const std::string label = i < bars.labels.size() ? without_marks(bars.labels[i]) : "";
    head.push_back(label + (unit_of(label).empty() ? unit : ""));
    if (ours(i)) head.push_back("± of " + head.back());
  }
  std::string text = row(unlike(head));
  for (std::size_t c = 0; c < bars.categories.size(); ++c) {
    std::vector<std::string> cells{without_marks(bars.categories[c])};
    for (std::size_t i = 0; i < bars.values.size(); ++i) {
      cells.push_back(c < bars.values[i].size() ? plain(bars.values[i][c]) : "");
      if (ours(i)) cells.push_back(c < bars.errors[i].size() ? plain(bars.errors[i][c]) : "");
    }
    text += row(cells);
  }
  return text;
}

const std::string& name_of(const render::Series& series) { return series.name.empty() ? series.label : series.name; }

/// The columns of curves on one value axis.
struct SideColumns {
  render::Side side;
  std::string title;
  bool ours = false, published = false, errors = false;
};

std::string curves_text(const render::Chart& chart) {
  std::vector<SideColumns> sides{{render::Side::left, title_of(chart.left, "value")},
                                 {render::Side::right, title_of(chart.right, "value on the right")}};
  for (SideColumns& side : sides) {
    for (const render::Series& s : chart.series) {
      if (s.side != side.side) continue;
      (is_published(name_of(s)) ? side.published : side.ours) = true;
      side.errors = side.errors || !s.y_error.empty();
    }
  }
  std::vector<std::string> head{"series", title_of(chart.x, "x")};
  for (const SideColumns& side : sides) {
    if (side.ours) head.push_back(side.title);
    if (side.published) head.push_back("Published: " + side.title);
    if (side.errors) head.push_back("± of " + side.title);
  }
  std::string text = row(unlike(head));
  for (std::size_t i = 0; i < chart.series.size(); ++i) {
    const render::Series& s = chart.series[i];
    const std::string name = name_of(s).empty() ? "series " + std::to_string(i + 1) : without_marks(name_of(s));
    for (std::size_t k = 0; k < std::min(s.x.size(), s.y.size()); ++k) {
      std::vector<std::string> cells{name, plain(s.x[k])};
      for (const SideColumns& side : sides) {
        const bool here = s.side == side.side, published = is_published(name_of(s));
        if (side.ours) cells.push_back(here && !published ? plain(s.y[k]) : "");
        if (side.published) cells.push_back(here && published ? plain(s.y[k]) : "");
        if (side.errors) cells.push_back(here && k < s.y_error.size() ? plain(s.y_error[k]) : "");
      }
      text += row(cells);
    }
  }
  return text;
}

std::string bands_text(const render::Chart& chart) {
  const std::string y = title_of(chart.left, "value");
  std::string text = row({"band", title_of(chart.x, "x"), "low: " + y, "high: " + y});
  for (const render::Band& band : chart.bands) {
    for (std::size_t k = 0; k < band.x.size(); ++k) {
      text += row({without_marks(band.label), plain(band.x[k]), plain(band.low[k]), plain(band.high[k])});
    }
  }
  return text;
}

std::string marks_text(const render::Chart& chart) {
  using Kind = render::Mark::Kind;
  std::string text =
      row({"mark", title_of(chart.x, "x"), title_of(chart.left, "y"), title_of(chart.right, "y on the right")});
  for (const render::Mark& mark : chart.marks) {
    const std::string y = mark.kind == Kind::vertical ? "" : plain(mark.y);
    const bool left = mark.side == render::Side::left;
    text += row(
        {without_marks(mark.label), mark.kind == Kind::horizontal ? "" : plain(mark.x), left ? y : "", left ? "" : y});
  }
  return text;
}

void add_tables(const render::Chart& chart, const std::string& prefix, std::vector<CsvTable>& tables) {
  bool first = true;
  const auto add = [&](const char* name, std::string (*text)(const render::Chart&)) {
    const std::string part = first ? "" : name;
    const std::string between = prefix.empty() || part.empty() ? "" : "_";
    tables.push_back({prefix + between + part, [&chart, text] { return text(chart); }});
    first = false;
  };
  if (chart.bars) add("bars", bars_text);
  if (!chart.series.empty()) add("curves", curves_text);
  if (!chart.bands.empty()) add("bands", bands_text);
  if (!chart.marks.empty()) add("marks", marks_text);
  int number = 0;
  for (const render::Inset& inset : chart.insets) {
    ++number;
    for (const render::Chart& inner : inset.chart)
      add_tables(inner, "inset" + (number > 1 ? std::to_string(number) : std::string()), tables);
  }
}

/// A column of a table of texts, read as numbers.
class Column {
 public:
  Column(const TextTable& table, std::size_t at) : head_(without_marks(table.head[at])) {
    for (const auto& cells : table.rows) {
      const std::string text = at < cells.size() ? without_marks(cells[at]) : "";
      const bool empty = text.empty() || text == "–" || text == "-";
      texts_.push_back(empty ? "" : text);
      cells_.push_back(empty ? std::nullopt : cell_numbers(text));
      if (empty) continue;
      ++filled_;
      if (!cells_.back()) continue;
      ++numbers_;
      units_.insert(cells_.back()->unit);
      parts_ = std::max(parts_, cells_.back()->numbers.size());
      if (cells_.back()->numbers.size() > 1) form_ = cells_.back()->form;
    }
    if (at == 0 && filled_ < texts_.size()) fill_down();
    const std::size_t cut = head_.find(" (95 % interval)");
    if (cut != std::string::npos) head_.erase(cut);
  }

  /// Heads and cells, under one another, of what it becomes. `halves`: what "a / b" stands for.
  [[nodiscard]] std::vector<std::vector<std::string>> columns(const std::pair<std::string, std::string>& halves) const {
    if (2 * numbers_ <= filled_ || numbers_ == 0) return {joined_to(head_, texts_)};
    std::vector<std::vector<std::string>> all;
    const bool one_unit = units_.size() == 1;
    const std::string unit = one_unit && !units_.begin()->empty() ? " (" + *units_.begin() + ")" : "";
    for (std::size_t part = 0; part < parts_; ++part) {
      std::vector<std::string> column{part_name(part, halves) + unit};
      for (const auto& cell : cells_) column.push_back(cell && part < cell->numbers.size() ? cell->numbers[part] : "");
      all.push_back(std::move(column));
    }
    if (!one_unit) {
      std::vector<std::string> column{head_ + ", unit"};
      for (const auto& cell : cells_) column.push_back(cell ? cell->unit : "");
      all.push_back(std::move(column));
    }
    if (numbers_ < filled_) {
      std::vector<std::string> column{head_ + ", in words"};
      for (std::size_t i = 0; i < cells_.size(); ++i) column.push_back(cells_[i] ? "" : texts_[i]);
      all.push_back(std::move(column));
    }
    return all;
  }

 private:
  // What a group of rows is of stands in its first row only.
  void fill_down() {
    for (std::size_t i = 1; i < texts_.size(); ++i) {
      if (texts_[i].empty()) texts_[i] = texts_[i - 1];
    }
  }

  static std::vector<std::string> joined_to(const std::string& head, const std::vector<std::string>& texts) {
    std::vector<std::string> column{head};
    column.insert(column.end(), texts.begin(), texts.end());
    return column;
  }

  [[nodiscard]] std::string part_name(std::size_t part, const std::pair<std::string, std::string>& halves) const {
    using Form = CellNumbers::Form;
    // "UCS (MPa)": what a part is stands before the unit.
    const std::string tail = unit_of(head_);
    const auto with = [&](const std::string& what) {
      return head_.substr(0, head_.size() - tail.size()) + ", " + what + tail;
    };
    if (parts_ == 1) return head_;
    if (form_ == Form::pair) return with(part == 0 ? halves.first : halves.second);
    if (form_ == Form::range) return with(part == 0 ? "from" : "to");
    if (part == 0) return head_;
    if (form_ == Form::deviation) return with("standard deviation");
    return with(part == 1 ? "low" : "high");
  }

  std::string head_;
  std::vector<std::string> texts_;
  std::vector<std::optional<CellNumbers>> cells_;
  std::set<std::string> units_;
  std::size_t filled_ = 0, numbers_ = 0, parts_ = 1;
  CellNumbers::Form form_ = CellNumbers::Form::value;
};

/// What "a / b" in the cells stands for: "..., tension / shear" in the first head.
std::pair<std::string, std::string> halves_of(const std::string& head) {
  const std::size_t slash = head.find(" / "), comma = head.rfind(", ", slash);
  if (slash == std::string::npos) return {"first", "second"};
  const std::size_t from = comma == std::string::npos ? 0 : comma + 2;
  return {head.substr(from, slash - from), head.substr(slash + 3)};
}

}  // namespace

std::vector<CsvTable> csv_tables(const render::Chart& chart) {
  std::vector<CsvTable> tables;
  add_tables(chart, "", tables);
  return tables;
}

std::string csv(const TextTable& table) {
  std::vector<std::vector<std::string>> columns;
  const auto halves = halves_of(table.head.empty() ? "" : table.head.front());
  for (std::size_t at = 0; at < table.head.size(); ++at) {
    for (auto& column : Column(table, at).columns(halves)) columns.push_back(std::move(column));
  }
  std::vector<std::string> heads;
  for (auto& column : columns) heads.push_back(column.front().empty() ? "quantity" : column.front());
  std::string text = row(unlike(heads));
  for (std::size_t i = 0; i < table.rows.size(); ++i) {
    std::vector<std::string> cells;
    for (const auto& column : columns) cells.push_back(column[i + 1]);
    text += row(cells);
  }
  return text;
}

}  // namespace reports
