#pragma once
// The data of a panel as CSV (RFC 4180, UTF-8, numbers with 9 significant digits). Always complete, whatever the picture shows.
#include <string>

#include "reports/figure.h"

namespace reports {

/// A chart: curves as rows "series,x,y" below a head that carries the axis titles; bars as a table, categories down.
std::string csv(const render::Chart& chart);
std::string csv(const TextTable& table);

}  // namespace reports
