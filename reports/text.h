#pragma once
// Numbers and words as a reader sees them. Plain data (CSV, JSON) is written elsewhere.
#include <initializer_list>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "engine/core/quantity.h"

namespace reports {

/// `value` with `digits` significant digits, a real minus sign and thin spaces between thousands: "−1 234", "0.183",
/// "3.2 × 10⁻⁵" outside 1e-4 ... 1e7. "not a number" for NaN.
std::string number(double value, int digits = 3);
/// The same in powers of ten, whatever the size: for numbers beside one that needs them. 0 stays "0".
std::string scientific(double value, int digits = 3);
/// "10⁻⁵".
std::string power_of_ten(int exponent);
/// Whether number() writes the value in powers of ten.
bool needs_powers(double value);
/// `value` with `places` decimals, a real minus sign and thin spaces.
std::string fixed(double value, int places);
/// A fraction as percent: percent(0.123, 1) is "12.3 %".
std::string percent(double fraction, int places = 1);
/// With a sign in front, also for positive values; zero has none.
std::string with_sign(std::string text);
/// As short as it can be without loss: "206.8", "55".
std::string shortest(double value);
/// "p = 0.02", "p < 0.005": by `draws` samples.
std::string p_text(double p, int draws);
/// The same in a column of p: "0.02", "< 0.005".
std::string p_cell(double p, int draws);
/// A count with thin spaces: "36 528".
std::string count(double value);

/// "one seed", "3 seeds".
std::string seeds_text(std::size_t seeds);
/// "one seed cannot show a trend", "2 seeds cannot show a trend": there are too few for an interval of the slope.
std::string no_trend_text(std::size_t seeds);

/// "a, b and c".
std::string listed(const std::vector<std::string>& items);
std::string joined(const std::vector<std::string>& items, std::string_view between);
/// "inter_quartz_biotite" -> "inter quartz biotite".
std::string words(std::string_view id);

/// Begins with a capital, where it begins with a letter of the alphabet.
std::string capital(std::string text);

/// A parameter of a record as text: numbers short, words as they are.
std::string parameter_text(const std::variant<double, std::string>& value);

/// "Confining pressure σ₃ (MPa)", "Young’s modulus E (GPa)": titles of axes and heads of columns.
std::string axis_title(const dem::Parameter& parameter);
/// `name`: what it is called there, where that is not its name.
std::string axis_title(const dem::Quantity& quantity, std::string_view name = {});
/// "AR 2", "dip 45°", "σ₃ 10 MPa", "quartz"; "" where there is nothing to say.
std::string parameter_words(const dem::Parameter& parameter, const dem::ParameterValue& value);

/// An energy with the prefix that suits `largest`: {1e3, "mJ"}: factor from joules, unit.
std::pair<double, std::string> energy_unit(double largest);

}  // namespace reports
