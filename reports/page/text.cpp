#include "reports/page/text.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace reports {
namespace {

constexpr std::string_view minus_sign = "\u2212";
constexpr std::string_view thin_space = "\u202f";

// "-12345.6" -> "−12 345.6"
std::string dressed(const std::string& plain) {
  std::string text;
  std::size_t start = 0;
  if (!plain.empty() && plain[0] == '-') {
    start = 1;
    if (plain.find_first_not_of("0.", 1) != std::string::npos) text += minus_sign;
  }
  const std::size_t end = std::min(plain.find('.', start), plain.size());
  const bool grouped = end - start > 4;
  for (std::size_t i = start; i < end; ++i) {
    text += plain[i];
    if (grouped && i + 1 < end && (end - i - 1) % 3 == 0) text += thin_space;
  }
  return text + plain.substr(end);
}

std::string superscript(int exponent) {
  constexpr std::array<std::string_view, 10> digits{"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
  std::string text = exponent < 0 ? "⁻" : "";
  for (const char c : std::to_string(std::abs(exponent))) text += digits[static_cast<std::size_t>(c - '0')];
  return text;
}

struct Named {
  std::string_view key, name, unit;
};

constexpr std::array named{
    Named{"young_modulus_GPa", "Young’s modulus", "GPa"},
    Named{"poisson_ratio", "Poisson’s ratio", ""},
    Named{"ucs_MPa", "Uniaxial compressive strength", "MPa"},
    Named{"tensile_strength_MPa", "Tensile strength", "MPa"},
    Named{"peak_strain", "Strain at the peak", ""},
    Named{"crack_initiation_MPa.axial_stiffness", "Crack initiation stress, by axial stiffness", "MPa"},
    Named{"crack_initiation_MPa.strain_0_1_percent", "Stress at 0.1 % axial strain", "MPa"},
    Named{"crack_initiation_MPa.one_percent_of_cracks", "Crack initiation stress, 1 % of cracks at the peak", "MPa"},
    Named{"crack_initiation_MPa.crack_volumetric_strain", "Crack initiation stress, by crack volumetric strain", "MPa"},
    Named{"crack_damage_MPa", "Crack damage stress", "MPa"},
    Named{"crack_damage_strain", "Strain at crack damage", ""},
    Named{"inter_grain_share", "Inter-grain share of contacts", ""},
    Named{"inter_grain_crack_share", "Inter-grain share of cracks", ""},
    Named{"hoek_brown_m", "Hoek-Brown m", ""},
    Named{"coordination", "Coordination number", ""},
    Named{"porosity", "Porosity", ""},
    Named{"cracks.intra_tension", "Cracks within grains, tension", ""},
    Named{"cracks.intra_shear", "Cracks within grains, shear", ""},
    Named{"cracks.inter_tension", "Cracks between grains, tension", ""},
    Named{"cracks.inter_shear", "Cracks between grains, shear", ""},
    Named{"energy_residual", "Energy residual", ""},
    Named{"onset_strain", "Strain at the first break", ""},
    Named{"peak_differential_stress_dimensionless", "Peak differential stress, in k", ""},
    Named{"worst_step_share", "Share of the breaks in the worst step", ""},
    Named{"radial_share", "Trends within 30° of the radius, share", ""},
    Named{"along_compression_share", "Trends within 30° of the compression, share", ""},
    Named{"across_extension_share", "Trends within 30° of across the extension, share", ""},
    Named{"spacing_over_thickness", "Spacing of fractures over the thickness of the layer", ""},
    Named{"spacing_scatter", "Scatter of the spacing, over its mean", ""},
    Named{"spacing_scatter_chance", "The same of fractures at random", ""},
    Named{"unbalanced_force_dimensionless", "Largest unbalanced over largest spring force", ""},
    Named{"jumps", "Jumps from one equilibrium to another", ""},
    Named{"jumped_share", "Share of the work released by jumps", ""},
    Named{"solver.settled", "Solver, settlings by damped dynamics", ""},
};

constexpr std::array units{std::string_view{"GPa"}, std::string_view{"MPa"}, std::string_view{"kPa"},
                           std::string_view{"Pa"},  std::string_view{"mm"},  std::string_view{"J"},
                           std::string_view{"s"},   std::string_view{"m"}};

}  // namespace

std::string number(double value, int digits) {
  if (!std::isfinite(value)) return "not a number";
  if (value == 0) return "0";
  const double size = std::abs(value);
  if (size >= 1e-4 && size < 1e7) {
    const int before = static_cast<int>(std::floor(std::log10(size))) + 1;
    return dressed(fmt::format("{:.{}f}", value, std::max(0, digits - before)));
  }
  const std::string text = fmt::format("{:.{}e}", value, std::max(0, digits - 1));
  const std::size_t e = text.find('e');
  return dressed(text.substr(0, e)) + " × 10" + superscript(std::stoi(text.substr(e + 1)));
}

std::string fixed(double value, int places) {
  return std::isfinite(value) ? dressed(fmt::format("{:.{}f}", value, places)) : "not a number";
}

std::string percent(double fraction, int places) { return fixed(100 * fraction, places) + " %"; }

std::string with_sign(std::string text) { return text.starts_with(minus_sign) ? text : "+" + text; }

std::string shortest(double value) { return dressed(fmt::format("{:.9g}", value)); }

std::string count(double value) { return fixed(value, 0); }

std::string listed(const std::vector<std::string>& items) {
  std::string text;
  for (std::size_t i = 0; i < items.size(); ++i) {
    if (i > 0) text += i + 1 == items.size() ? " and " : ", ";
    text += items[i];
  }
  return text;
}

std::string joined(const std::vector<std::string>& items, std::string_view between) {
  return fmt::format("{}", fmt::join(items, between));
}

std::string words(std::string_view id) {
  std::string text(id);
  std::ranges::replace(text, '_', ' ');
  return text;
}

std::pair<std::string, std::string> result_name(std::string_view key) {
  const auto found = std::ranges::find(named, key, &Named::key);
  if (found != named.end()) return {std::string(found->name), std::string(found->unit)};
  std::string text(key);
  std::string unit;
  const std::size_t last = text.rfind('_');
  if (last != std::string::npos && std::ranges::find(units, std::string_view(text).substr(last + 1)) != units.end()) {
    unit = text.substr(last + 1);
    text.resize(last);
  }
  for (std::size_t dot = text.find('.'); dot != std::string::npos; dot = text.find('.', dot))
    text.replace(dot, 1, ", ");
  text = words(text);
  if (!text.empty() && text[0] >= 'a' && text[0] <= 'z') text[0] = static_cast<char>(text[0] - 'a' + 'A');
  return {text, unit};
}

std::string parameter_text(const std::variant<double, std::string>& value) {
  if (const auto* text = std::get_if<std::string>(&value)) return words(*text);
  return fmt::format("{:.6g}", std::get<double>(value));
}

std::pair<double, std::string> energy_unit(double largest) {
  const double size = std::abs(largest);
  if (size >= 1e3) return {1e-3, "kJ"};
  if (size >= 1) return {1, "J"};
  if (size >= 1e-3) return {1e3, "mJ"};
  return {1e6, "µJ"};
}

}  // namespace reports
