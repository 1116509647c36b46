#include "engine/calibration/mean_response.h"

#include <cmath>
#include <limits>
#include <numeric>

namespace dem::calibration {
namespace {

double mean_of(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

}  // namespace

Expected expected_at(const std::vector<double>& point, const std::vector<Sample>& samples, const Prior& prior) {
  const auto targets = static_cast<std::size_t>(prior.jacobian.rows());
  const Eigen::Index unknowns = prior.jacobian.cols();
  Expected found;
  found.jacobian = prior.jacobian;
  for (std::size_t i = 0; i < targets; ++i) {
    // Scatter within the samples alone: what differs between points is not scatter.
    double squares = 0, freedom = 0;
    int specimens = 0;
    for (const Sample& sample : samples) {
      const std::vector<double>& values = sample.values[i];
      if (values.empty()) continue;
      const double mean = mean_of(values);
      for (const double value : values) squares += (value - mean) * (value - mean);
      freedom += static_cast<double>(values.size()) - 1;
      specimens += static_cast<int>(values.size());
    }
    const double known = prior.scatter[i];
    double variance = (prior.freedom * known * known + squares) / (prior.freedom + freedom);
    // What is known is of larger specimens: where these scatter more, and enough of them tell, theirs counts alone.
    if (freedom >= prior.freedom) variance = std::max(variance, squares / freedom);
    found.scatter.push_back(std::sqrt(variance));
    found.freedom.push_back(prior.freedom + freedom);
    found.specimens.push_back(specimens);
    if (specimens == 0) {
      found.mean.push_back(std::numeric_limits<double>::quiet_NaN());
      found.deviation.push_back(std::numeric_limits<double>::infinity());
      continue;
    }
    // Level at `point`, then the derivatives.
    const double error = prior.jacobian_error * prior.scale[i];
    const auto row = static_cast<Eigen::Index>(i);
    Eigen::MatrixXd information = Eigen::MatrixXd::Zero(unknowns + 1, unknowns + 1);
    Eigen::VectorXd weighed = Eigen::VectorXd::Zero(unknowns + 1);
    for (Eigen::Index k = 0; k < unknowns; ++k) {
      information(k + 1, k + 1) = 1 / (error * error);
      weighed[k + 1] = prior.jacobian(row, k) / (error * error);
    }
    for (const Sample& sample : samples) {
      const std::vector<double>& values = sample.values[i];
      if (values.empty()) continue;
      Eigen::VectorXd h = Eigen::VectorXd::Ones(unknowns + 1);
      for (Eigen::Index k = 0; k < unknowns; ++k)
        h[k + 1] = sample.point[static_cast<std::size_t>(k)] - point[static_cast<std::size_t>(k)];
      const double bend = prior.curvature * prior.scale[i] * h.tail(unknowns).squaredNorm();
      const double weight = 1 / (variance / static_cast<double>(values.size()) + bend * bend);
      information += weight * h * h.transpose();
      weighed += weight * mean_of(values) * h;
    }
    const Eigen::MatrixXd covariance = information.inverse();
    const Eigen::VectorXd line = covariance * weighed;
    found.mean.push_back(line[0]);
    found.deviation.push_back(std::sqrt(covariance(0, 0)));
    found.jacobian.row(row) = line.tail(unknowns).transpose();
  }
  return found;
}

}  // namespace dem::calibration
