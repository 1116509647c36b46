#include "reports/calibration/sensitivities.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

namespace calibrate {
namespace {

constexpr std::array columns{"young_modulus",    "poisson_ratio", "ucs",          "tensile_strength",  "crack_damage",
                             "crack_initiation", "peaks",         "hoek_brown_m", "brazilian_strength"};

struct Row {
  std::string_view parameter;
  std::array<double, columns.size()> percent;  ///< of each result when the parameter is raised by 20 %
};

// docs/use/your-rock.md, first table: alkali feldspar alone (ldb_mineral_sensitivity at draft scale, three seeds). What does
// not stand out of the scatter of seeds is none.
constexpr std::array mineral{
    Row{"modulus", {20, 0, 0, 0, 0, 0, 0, 0, 0}},
    Row{"stiffness_ratio", {-6.2, 24.6, 0, -3.7, -15.2, -4.0, -2.4, 0, -9.8}},
    Row{"tensile_strength", {0, -1.0, 7.6, 19.9, 9.1, 15.5, 0, -9.9, 18.4}},
    Row{"cohesion", {0, 0, 9.5, 0, 4.1, 0, 10.9, 0, 0}},
    Row{"friction_angle", {0, 0, 0, 0, 0, 0, 9.0, 36.6, 0}},
    Row{"friction", {0, 0, 0, 0, 0, 0, 0.5, 0, 0}},
};
constexpr double nu_of_mineral = 0.101;

// Second table: coefficients on the boundaries of Lac du Bonnet granite (ldb_sensitivity, likewise). Cohesion and friction angle
// act under pressure alone: there their means stand, although three seeds do not tell them from none, because a user may name
// them and measure better.
constexpr std::array boundaries{
    Row{"interaction.modulus", {6.6, 0, 3.7, -4.0, 0, -6.9, 0, 0, 0}},
    Row{"interaction.stiffness_ratio", {-2.2, 9.0, 0, -4.0, -6.5, -9.7, 0, 10.8, 0}},
    Row{"interaction.tensile_strength", {0, -4.3, 0, 18.9, 3.8, 18.1, 0, 0, 2.8}},
    Row{"interaction.cohesion", {0, 0, 0, 0, 0, 0, 3.5, 9.4, 0}},
    Row{"interaction.friction", {0.4, -1.3, 0, 0, 0, 0, 0, 0, 0}},
    Row{"interaction.friction_angle", {0, 0, 0, 0, 0, 0, 3.4, 9.1, 0}},
};
constexpr double nu_of_rock = 0.191;
constexpr double peak_pressure = 20;  // MPa, of the column "peaks"

template <class Rows>
const Row* find(const Rows& rows, std::string_view parameter) {
  const auto at = std::ranges::find(rows, parameter, &Row::parameter);
  return at == rows.end() ? nullptr : &*at;
}

double logarithmic(double percent, std::string_view key, double nu) {
  const double relative = std::log1p(0.01 * percent) / std::log(1.2);
  return key == "poisson_ratio" ? nu * relative : relative;
}

double of_row(const Row& row, std::string_view key, double pressure, double nu) {
  const auto value = [&](std::string_view column) {
    const auto at = std::ranges::find(columns, column);
    return at == columns.end() ? 0.0 : row.percent[static_cast<std::size_t>(at - columns.begin())];
  };
  if (key != "peaks") return logarithmic(value(key), key, nu);
  // From what it is without pressure to what was measured at 20 MPa, and on to half as much again.
  const double part = std::min(pressure / peak_pressure, 1.5);
  return logarithmic((1 - part) * value("ucs") + part * value("peaks"), key, nu);
}

}  // namespace

double sensitivity(std::string_view parameter, std::string_view key, double pressure, bool of_rock) {
  if (const Row* row = find(boundaries, parameter)) return of_rock ? of_row(*row, key, pressure, nu_of_rock) : 0;
  const Row* row = find(mineral, parameter);
  if (!row) return 0;
  double found = of_row(*row, key, pressure, of_rock ? nu_of_rock : nu_of_mineral);
  // Boundaries are factors on the minerals: where all of them rise, the boundaries do.
  if (of_rock && parameter == "tensile_strength") {
    if (const Row* there = find(boundaries, "interaction.tensile_strength"); there && key == "crack_initiation")
      found = std::max(found, of_row(*there, key, pressure, nu_of_rock));
  }
  return found;
}

double scatter(std::string_view key) {
  if (key == "young_modulus") return 0.01;
  if (key == "poisson_ratio") return 0.006;
  if (key == "tensile_strength") return 0.045;
  if (key == "brazilian_strength") return 0.06;
  if (key == "crack_initiation" || key == "crack_damage") return 0.05;
  if (key == "peaks") return 0.025;
  if (key == "hoek_brown_m") return 0.15;
  return 0.03;
}

}  // namespace calibrate
