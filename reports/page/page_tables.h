#pragma once
// Rows of tables as data for the template (assets/page/report.html).
#include <cstddef>
#include <string>
#include <vector>

#include "reports/page/page_parts.h"

namespace reports {

/// Tables of so few rows stay whole in print; those of figures are small, and stay with them.
[[nodiscard]] inline bool is_short(std::size_t rows, bool of_a_figure = false) {
  return rows <= (of_a_figure ? 12 : 8);
}

[[nodiscard]] inline PageData new_list() { return PageData{PageData::type::list}; }

/// {"cell": text} for each text.
[[nodiscard]] inline PageData cells(const std::vector<std::string>& texts) {
  PageData list = new_list();
  for (const std::string& text : texts) list.push_back(PageData{"cell", text});
  return list;
}

[[nodiscard]] inline PageData table_row(const std::string& name, const std::vector<std::string>& values) {
  PageData row;
  row.set("name", name);
  row.set("named", !name.empty());
  row.set("cells", cells(values));
  return row;
}

}  // namespace reports
