#pragma once
// Which unknowns data can determine: by the singular values of the weighed matrix of derivatives. A direction whose standard
// deviation is too large is one that no target sees; an unknown that opens such a direction is kept at its start.
#include <Eigen/Dense>

#include <vector>

namespace dem::calibration {

struct Kept {
  std::size_t unknown = 0;
  std::vector<double> direction;  ///< that nothing sees, over all unknowns; unit length
  double deviation = 0;           ///< standard deviation along it; infinite: nothing moves at all
};

struct Identified {
  std::vector<bool> free;       ///< of each unknown
  std::vector<Kept> kept;       ///< the others, with the reason
  double condition = 0;         ///< of those that are free; 0 without any
  double condition_of_all = 0;  ///< of all; infinite when a direction does nothing
};

/// Takes unknowns in their order, first the ones that matter most, as long as no direction among those taken has a
/// standard deviation above `limit`. `weighed`: derivatives of answers over their standard deviations.
Identified identify(const Eigen::MatrixXd& weighed, double limit);

/// Covariance of the free unknowns by the answers' deviations (Laplace); rows and columns of others are 0.
Eigen::MatrixXd covariance(const Eigen::MatrixXd& weighed, const std::vector<bool>& free);

/// Standard deviations of the free unknowns if one more quantity were known: `row` its weighed derivatives.
std::vector<double> deviations_with(const Eigen::MatrixXd& weighed, const Eigen::RowVectorXd& row,
                                    const std::vector<bool>& free);

}  // namespace dem::calibration
