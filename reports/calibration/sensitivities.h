#pragma once
// How results of the grain texture model follow its parameters, as measured once (docs/use/your-rock.md): what a search
// knows before it has run anything.
#include <string_view>

namespace calibrate {

/// Change of the logarithm of a result (of Poisson's ratio: of itself) with the logarithm of a parameter. `parameter` is a
/// property of minerals ("cohesion") or a coefficient ("interaction.cohesion"), `key` a key of [measured]. A peak is at a
/// confining pressure in MPa. `of_rock`: of a rock with boundaries between minerals, not of a mineral alone.
double sensitivity(std::string_view parameter, std::string_view key, double pressure, bool of_rock);

/// Standard deviation between seeds of a result: relative, of Poisson's ratio absolute.
double scatter(std::string_view key);

}  // namespace calibrate
