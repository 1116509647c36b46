#pragma once
// Values as laboratories write them, with their uncertainty: "210 MPa +- 8", "210 ± 8 MPa", "210 MPa +- 4 %",
// "200-228 MPa", "200 to 228 MPa", and in lists with where they were measured: "320 MPa +- 10 at 20 MPa".
// What stands after +- is a standard deviation. Of a range any value is as likely as another: its standard deviation is the
// half width over root 3 (JCGM 100:2008, 4.3.7).
#include <string>
#include <string_view>
#include <vector>

#include "engine/scenario/scenario.h"

namespace dem {

struct Measured {
  double value = 0;          ///< SI; of a range its middle
  double low = 0, high = 0;  ///< the band as it is written
  double deviation = 0;      ///< standard deviation; 0: no uncertainty is written
  double at = 0;             ///< SI: where it was measured, of entries that say so
  [[nodiscard]] bool is_certain() const { return deviation == 0; }
};

/// `unit` "": without one. `at_unit` "": "at ..." is refused; else it must be there.
/// Throws InputError (no location).
Measured read_measured(std::string_view text, std::string_view unit, std::string_view at_unit = {});

/// The value of a key of type measured, none or one entry, or measured_at, any number of them.
std::vector<Measured> measured(const Scenario& scenario, std::string_view path);

/// How a Scenario keeps them: five numbers a value.
std::vector<double> flat(const Measured& value);

}  // namespace dem
