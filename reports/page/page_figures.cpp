// The figures of the page: panels in rows, with what they have in common said once.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>

#include "reports/page/downloads.h"
#include "reports/page/page.h"
#include "reports/page/page_parts.h"
#include "reports/page/page_tables.h"
#include "reports/text.h"

namespace reports {
namespace {

std::string colour_code(const render::Colour& colour) {
  const auto part = [](double value) { return static_cast<int>(std::lround(255 * std::clamp(value, 0.0, 1.0))); };
  return fmt::format("#{:02x}{:02x}{:02x}", part(colour.red), part(colour.green), part(colour.blue));
}

PageData legend_data(const std::vector<LegendEntry>& entries) {
  PageData legend = new_list();
  for (const LegendEntry& entry : entries) {
    PageData item;
    item.set("colour", colour_code(entry.colour));
    item.set("text", entry.text.empty() || entry.count.empty() ? entry.text + entry.count
                                                               : entry.text + ":\u00a0" + entry.count);
    legend.push_back(item);
  }
  return legend;
}

/// What the pictures of a row have in common: it is said once, below the row; and whether all are slim.
struct Shared {
  bool caption = false, legend = false;
  bool slim = false;
};

bool same_key(const std::vector<LegendEntry>& a, const std::vector<LegendEntry>& b) {
  return std::ranges::equal(a, b, [](const LegendEntry& x, const LegendEntry& y) {
    return x.text == y.text && colour_code(x.colour) == colour_code(y.colour);
  });
}

/// In mm. Charts are drawn for their width in print, so that their text has its size there; a scene is as wide as its place,
/// up to that height.
double print_width(const DrawnPanel& panel) {
  if (!panel.image.ends_with(".png")) return panel.width * render::column_mm / render::column_width;
  return panel.height > 0 ? highest_picture(panel.per_row) * panel.width / panel.height : 0;
}

bool is_tall(const DrawnPanel& panel) { return panel.height > panel.width * 3 / 2; }

Shared shared_by(std::span<const DrawnPanel> row) {
  Shared shared;
  // Beside a slim picture there is room for its caption and its key in print.
  constexpr double slim = 36;  // mm
  shared.slim = std::ranges::all_of(row, [](const auto& p) { return is_tall(p) && print_width(p) <= slim; });
  if (row.size() < 2) return shared;
  const DrawnPanel& first = row.front();
  shared.caption = !first.caption.empty() && std::ranges::all_of(row, [&](const auto& p) {
    return p.caption == first.caption && !p.label.empty();
  });
  shared.legend = !first.legend.empty() &&
                  std::ranges::all_of(row, [&](const auto& p) { return same_key(p.legend, first.legend); });
  return shared;
}

// What differs from picture to picture, once the row says the rest: the entries with counts, by their names.
std::vector<LegendEntry> counts_of(std::vector<LegendEntry> legend) {
  std::erase_if(legend, [](const LegendEntry& entry) { return entry.count.empty(); });
  return legend;
}

/// A download of a panel. A picture that is on the page already is not there twice.
struct Download {
  std::string file, kind;
};

std::vector<Download> downloads_of(const DrawnPanel& panel, const std::filesystem::path& folder) {
  constexpr std::uintmax_t largest = 1'000'000;  // browsers follow links of 2 MB, base64 makes it a third more
  std::vector<Download> all;
  std::string first;  // table of a chart; the others have longer names
  for (const std::string& file : panel.files) {
    const std::filesystem::path path(file);
    const bool table = path.extension() == ".csv";
    if (table && first.empty()) first = path.stem().string();
    const bool shown_as_pixels = path.extension() == ".svg" && file != panel.image;  // megabytes: they lie in figures/
    if (path.extension() == ".png" || shown_as_pixels || std::filesystem::file_size(folder / path) > largest) continue;
    const std::string part = table ? path.stem().string().substr(first.size()) : "";
    all.push_back({file, table ? "CSV" + (part.empty() ? "" : " (" + words(part.substr(1)) + ")") : "SVG"});
  }
  return all;
}

// "12.5", "−3", "≥ 3770", "0.7 ± 0.1", "0.61 (0.4 to 0.8)", "−8 to 10", "134 / 0"; not "AR 1" or "0.1 % strain".
bool is_number(std::string_view text) {
  for (const std::string_view before : {"≥ ", "≤ ", "< ", "−", "+"}) {
    if (text.starts_with(before)) text.remove_prefix(before.size());
  }
  std::string rest(text.substr(0, text.find('(')));
  if (const std::size_t to = rest.find(" to "); to != std::string::npos) rest.erase(to, 4);
  return !text.empty() && text[0] >= '0' && text[0] <= '9' &&
         std::ranges::none_of(rest, [](char c) { return c >= 'a' && c <= 'z'; });
}

// Columns of numbers: their figures stand below each other.
std::vector<bool> number_columns(const TextTable& table) {
  std::vector<bool> numbers(table.head.size(), false);
  for (std::size_t column = 1; column < numbers.size(); ++column) {
    std::size_t some = 0, others = 0;
    for (const auto& row : table.rows) {
      if (column >= row.size() || row[column].empty() || row[column] == "–") continue;
      (is_number(row[column]) ? some : others) += 1;
    }
    numbers[column] = some > others || others == 0;  // where none has a number, too
  }
  return numbers;
}

// A few cases with many results read better as columns: a page is not wide enough for both their heads.
TextTable turned(const TextTable& table) {
  constexpr std::size_t many = 7, few = 4;
  if (table.head.size() <= many || table.rows.size() > few) return table;
  TextTable upright{{""}, {}};
  for (const auto& row : table.rows) upright.head.push_back(row.front());
  for (std::size_t column = 1; column < table.head.size(); ++column) {
    std::vector<std::string> line{table.head[column]};
    for (const auto& row : table.rows) line.push_back(column < row.size() ? row[column] : "");
    upright.rows.push_back(std::move(line));
  }
  return upright;
}

void set_table(PageData& data, const TextTable& as_declared) {
  const TextTable table = turned(as_declared);
  // Bytes of a name that stays in one line.
  const std::size_t brief = table.head.size() > 9 ? 16 : 26;
  const std::vector<bool> numbers = number_columns(table);
  PageData head = new_list();
  for (std::size_t i = 0; i < table.head.size(); ++i) {
    PageData item{"cell", table.head[i]};
    item.set("named", !table.head[i].empty());
    item.set("number", static_cast<bool>(numbers[i]));
    head.push_back(item);
  }
  PageData rows = new_list();
  for (const auto& row : table.rows) {
    if (row.empty()) continue;
    PageData values = new_list();
    for (std::size_t i = 1; i < row.size(); ++i) {
      PageData item{"cell", row[i].empty() ? "–" : row[i]};
      item.set("number", i < numbers.size() && numbers[i]);
      values.push_back(item);
    }
    PageData one;
    one.set("name", row.front());
    one.set("named", !row.front().empty());
    one.set("brief", row.front().size() <= brief);
    one.set("cells", values);
    rows.push_back(one);
  }
  data.set("short", is_short(table.rows.size(), true));
  data.set("table_head", head);
  data.set("table_rows", rows);
}

/// `figure`: "Figure 5".
PageData panel_data(const DrawnPanel& panel, const std::string& figure, const std::filesystem::path& folder,
                    const Shared& shared) {
  PageData data;
  const std::string whose = figure + panel.letter;
  data.set("whose", whose);
  data.set("letter", panel.letter);
  data.set("has_letter", !panel.letter.empty());
  data.set("caption", shared.caption ? "" : panel.caption);
  data.set("alt", whose + ": " + panel.alt);
  data.set("label", capital(panel.label));
  data.set("has_label", !panel.label.empty());
  data.set("note", panel.note);
  data.set("has_note", !panel.note.empty());
  data.set("has_image", !panel.image.empty());
  constexpr double apart = 2;  // mm
  data.set("slim", shared.slim);
  data.set("beside", fmt::format("{:.1f}", print_width(panel) + apart));
  const bool drawn = !panel.image.ends_with(".png");
  const bool broad = !panel.image.empty() && (panel.whole_width || (drawn && panel.width > render::column_width));
  data.set("broad", broad);
  data.set("shape", broad ? "wide-shape broad" : !is_tall(panel) ? "wide-shape" : shared.slim ? "tall slim" : "tall");
  if (!panel.image.empty()) {
    data.set("image", folder.empty() ? panel.image : data_uri(folder / panel.image));
    data.set("has_print_width", panel.width > 0 && panel.height > 0);
    data.set("print_width", fmt::format("{:.1f}", print_width(panel)));
    data.set("has_size", panel.width > 0);
    data.set("width", std::to_string(panel.width));
    data.set("height", std::to_string(panel.height));
  }
  data.set("has_bar", panel.bar.percent > 0);
  data.set("bar_text", panel.bar.text);
  data.set("bar_percent", fmt::format("{:.2f}", panel.bar.percent));
  const std::vector<LegendEntry> legend = shared.legend ? counts_of(panel.legend) : panel.legend;
  data.set("has_legend", !legend.empty());
  data.set("counted", std::ranges::any_of(legend, [](const LegendEntry& one) { return !one.count.empty(); }));
  data.set("legend", legend_data(legend));
  data.set("has_table", !panel.table.head.empty());
  set_table(data, panel.table);
  PageData files = new_list();
  for (const Download& download : folder.empty() ? std::vector<Download>{} : downloads_of(panel, folder)) {
    PageData item;
    item.set("name", std::filesystem::path(download.file).filename().string());
    item.set("href", data_uri(folder / download.file));
    item.set("kind", download.kind);
    files.push_back(item);
  }
  data.set("has_files", !files.is_empty_list());
  data.set("files", files);
  return data;
}

// Where a series (cases told apart by a label, under one caption) that fills a row follows another such series: it begins
// a row, so that each row says once what it shows.
std::vector<bool> row_starts(const std::vector<DrawnPanel>& panels) {
  std::vector<bool> starts(panels.size(), false);
  bool after_series = false;
  for (std::size_t i = 0; i < panels.size();) {
    std::size_t end = i + 1;
    while (end < panels.size() && !panels[end].label.empty() && panels[end].caption == panels[i].caption) ++end;
    const bool series = !panels[i].label.empty() && end - i >= static_cast<std::size_t>(std::max(2, panels[i].per_row));
    starts[i] = series && after_series;
    after_series = series;
    i = end;
  }
  return starts;
}

/// Members of a row.
struct Row {
  std::size_t begin = 0, end = 0;
};

// Neighbours that go beside each other share rows as even as can be: no panel stands alone beside an empty half.
std::vector<Row> rows_of(const std::vector<DrawnPanel>& panels) {
  const std::vector<bool> starts = row_starts(panels);
  std::vector<Row> rows;
  for (std::size_t begin = 0; begin < panels.size();) {
    const int per_row = std::max(1, panels[begin].per_row);
    std::size_t end = begin + 1;
    while (end < panels.size() && std::max(1, panels[end].per_row) == per_row && !starts[end]) ++end;
    const auto most = static_cast<std::size_t>(per_row);
    const std::size_t count = (end - begin + most - 1) / most;
    for (std::size_t left = count; left > 0; --left) {
      const std::size_t share = most == 2 ? std::min(most, end - begin) : (end - begin + left - 1) / left;
      rows.push_back({begin, begin + share});
      begin += share;
    }
  }
  return rows;
}

// Without the classes of a key that no picture of the row has.
std::vector<DrawnPanel> with_used_classes(std::span<const DrawnPanel> row) {
  std::vector<DrawnPanel> members(row.begin(), row.end());
  const auto unused = [&](const LegendEntry& entry) {
    return std::ranges::all_of(row, [&](const DrawnPanel& panel) {
      return std::ranges::all_of(
          panel.legend, [&](const LegendEntry& other) { return other.text != entry.text || other.count == "none"; });
    });
  };
  for (DrawnPanel& panel : members) std::erase_if(panel.legend, unused);
  return members;
}

PageData rows_data(const DrawnFigure& figure, const std::filesystem::path& folder) {
  const std::vector<DrawnPanel>& panels = figure.panels;
  PageData rows = new_list();
  for (const Row& each : rows_of(panels)) {
    const std::vector<DrawnPanel> members = with_used_classes({&panels[each.begin], each.end - each.begin});
    const int per_row = std::max(1, members.front().per_row);
    const Shared shared = shared_by(members);
    PageData list = new_list();
    for (const DrawnPanel& panel : members)
      list.push_back(panel_data(panel, fmt::format("Figure {}", figure.number), folder, shared));
    std::vector<LegendEntry> key = shared.legend ? members.front().legend : std::vector<LegendEntry>{};
    std::erase_if(key, [](const LegendEntry& entry) { return !entry.count.empty(); });
    PageData row;
    // Alone and half a page wide: its caption stands beside it.
    const bool alone = members.size() == 1 && per_row == 2 && members.front().table.head.empty();
    const bool whole = per_row == 1 && members.front().whole_width;
    row.set("per_row", alone ? "lone" : std::to_string(per_row) + (whole ? " whole" : ""));
    row.set("panels", list);
    row.set("tabled", !members.front().table.head.empty());
    row.set("has_shared", shared.caption || !key.empty());
    row.set("has_shared_caption", shared.caption);
    row.set("letters", members.front().letter + "–" + members.back().letter);
    row.set("shared_caption", members.front().caption);
    row.set("has_shared_legend", !key.empty());
    row.set("shared_legend", legend_data(key));
    rows.push_back(row);
  }
  return rows;
}

}  // namespace

PageData figures_data(const std::vector<DrawnFigure>& figures, const std::filesystem::path& folder) {
  PageData list = new_list();
  for (const DrawnFigure& figure : figures) {
    PageData data;
    data.set("later", figure.number > 1);
    data.set("figure_id", std::string(figure.figure->id));
    data.set("figure_number", std::to_string(figure.number));
    data.set("figure_title", std::string(figure.figure->title));
    data.set("source", figure.mirrors);
    data.set("has_source", !figure.mirrors.empty());
    data.set("statement", figure.statement);
    data.set("has_statement", !figure.statement.empty());
    data.set("says_who", figure.expected ? "Expected (by us)." : "Published.");
    const std::string ours =
        figure.standing + (figure.standing.empty() || figure.finding.empty() ? "" : " ") + figure.finding;
    data.set("finding", ours);
    data.set("has_finding", !ours.empty());
    data.set("problem", figure.problem);
    data.set("has_problem", !figure.problem.empty());
    data.set("panel_rows", rows_data(figure, folder));
    list.push_back(data);
  }
  return list;
}

}  // namespace reports
