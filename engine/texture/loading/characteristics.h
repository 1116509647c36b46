#pragma once
// What is read off the history of a test: moduli, characteristic stresses.
#include <cstddef>
#include <optional>
#include <vector>

#include "engine/texture/loading/history.h"

namespace dem::texture {

/// Characteristic values of a curve; stresses in Pa. Absent where the curve does not have them.
struct Characteristics {
  std::size_t peak = 0;                 ///< row of the largest stress
  std::optional<double> young_modulus;  ///< least squares between 10 and 30 % of the peak
  double gauge_share = 1;               ///< strain of the gauge over that of the ends there
  double strain_rate = 0;               ///< of the ends, forth and back, from 10 to 50 % of the peak, 1/s
  double elastic_energy = 0;            ///< mean of the samples there, J
  // Stages of cracking, for tests that have them (Test::crack_stages).
  std::optional<double> poisson_ratio;              ///< secant at half the peak
  std::optional<std::size_t> initiation_stiffness;  ///< row: axial stiffness leaves its early plateau
  std::optional<double> stress_at_strain;           ///< at 0.1 % axial strain
  std::optional<std::size_t> initiation_cracks;     ///< row: 1 % of the cracks present at the peak
  std::optional<std::size_t> initiation_volume;     ///< row: reversal of the crack volumetric strain
  std::optional<std::size_t> damage;                ///< row: largest volumetric strain before the peak
};

/// `departure`: share by which the axial stiffness must leave its plateau (mean over 10 to 25 % of the peak). Shares of
/// the peak are counted from the confining pressure (Pa), where the test starts.
Characteristics characterise(const std::vector<HistoryRow>& history, double departure, bool crack_stages,
                             double confining_pressure = 0);

/// Kinetic energy that the motion of the ends alone gives a body of that length (m) and mass (kg), as it is strained
/// evenly, over its elastic energy. The measured one is about as large in tension and compression, and follows the rate;
/// where cracks shake the body, or a chip flies off a disc, it does not.
double kinetic_share(const Characteristics& c, double length, double mass);

/// Share by which a test is loaded too fast: about so much are its strength too large and its modulus too small.
/// `sensitivity` is that of the strength (Test::rate_sensitivity). Calibrated in docs/notes/loading-rate.md.
double rate_bias(double kinetic_share, double sensitivity, bool of_modulus = true);

/// Lateral over axial strain where the stress first reaches half of that at `peak`; none before it has one.
std::optional<double> secant_poisson_ratio(const std::vector<HistoryRow>& history, std::size_t peak);

/// Axial stiffness of Eq. 9: (sigma - sigma_0) / (epsilon - epsilon_0), from the first row; NaN below a strain of 5e-5.
double axial_stiffness(const std::vector<HistoryRow>& history, std::size_t row);

}  // namespace dem::texture
