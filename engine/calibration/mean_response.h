#pragma once
// What tests give in the mean over specimens, near a point of the search, by all specimens that were tested: at this point and
// at others. One seed is one specimen, and its results stand apart from the mean; a round of a few fresh seeds at every step
// adds up, where the same seeds at every step would not.
//
// Of each target: a linear function of the unknowns, by Bayesian linear regression (Gelman et al., Bayesian Data Analysis, 3rd
// ed., section 14.8). The level is not known beforehand; the derivatives are, with an error. What lies farther away counts
// less, because the function is not straight.
#include <Eigen/Dense>

#include <vector>

namespace dem::calibration {

/// Specimens that were tested at one point.
struct Sample {
  std::vector<double> point;
  std::vector<std::vector<double>> values;  ///< [target][specimen]; none of those that gave no value
};

/// What is known beforehand.
struct Prior {
  Eigen::MatrixXd jacobian;     ///< targets x unknowns
  std::vector<double> scale;    ///< of each target's derivatives
  std::vector<double> scatter;  ///< of each target between specimens, a standard deviation
  double jacobian_error = 0.3;  ///< standard deviation of a derivative, in `scale`
  double curvature = 0.5;       ///< departure from the straight line at a distance of 1, in `scale`
  double freedom = 4;           ///< degrees of freedom that `scatter` counts for beside the scatter of the samples
};

/// At one point; a value for each target.
struct Expected {
  std::vector<double> mean;       ///< NaN where no specimen gave a value
  std::vector<double> deviation;  ///< standard deviation of the mean
  std::vector<double> scatter;    ///< between specimens
  std::vector<double> freedom;    ///< degrees of freedom of the scatter
  std::vector<int> specimens;     ///< that gave a value, at any point
  Eigen::MatrixXd jacobian;       ///< as learnt
};

Expected expected_at(const std::vector<double>& point, const std::vector<Sample>& samples, const Prior& prior);

}  // namespace dem::calibration
