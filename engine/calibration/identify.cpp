#include "engine/calibration/identify.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace dem::calibration {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

std::vector<Eigen::Index> indices(const std::vector<bool>& free) {
  std::vector<Eigen::Index> found;
  for (std::size_t k = 0; k < free.size(); ++k) {
    if (free[k]) found.push_back(static_cast<Eigen::Index>(k));
  }
  return found;
}

/// The direction that the data see least, and how well.
struct Weakest {
  double deviation = infinite, condition = infinite;
  Eigen::VectorXd direction;
};

Weakest weakest(const Eigen::MatrixXd& part) {
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(part, Eigen::ComputeFullV);
  const Eigen::VectorXd values = svd.singularValues();
  Weakest found{infinite, infinite, svd.matrixV().col(part.cols() - 1)};
  if (values.size() < part.cols()) return found;  // more unknowns than targets
  const double least = values[part.cols() - 1];
  if (least > 1e-12 * std::max(values[0], 1e-300)) {
    found.deviation = 1 / least;
    found.condition = values[0] / least;
  }
  return found;
}

}  // namespace

Identified identify(const Eigen::MatrixXd& weighed, double limit) {
  Identified found;
  const auto n = static_cast<std::size_t>(weighed.cols());
  found.free.assign(n, false);
  for (std::size_t k = 0; k < n; ++k) {
    std::vector<bool> tried = found.free;
    tried[k] = true;
    const std::vector<Eigen::Index> open = indices(tried);
    const Weakest worst = weakest(weighed(Eigen::all, open));
    if (worst.deviation <= limit) {
      found.free = tried;
      found.condition = worst.condition;
      continue;
    }
    Kept kept{k, std::vector<double>(n, 0), worst.deviation};
    for (std::size_t j = 0; j < open.size(); ++j) {
      kept.direction[static_cast<std::size_t>(open[j])] = worst.direction[static_cast<Eigen::Index>(j)];
    }
    // With the sign by which the unknown itself rises.
    if (kept.direction[k] < 0) {
      for (double& part : kept.direction) part = -part;
    }
    found.kept.push_back(std::move(kept));
  }
  if (n > 0) found.condition_of_all = weakest(weighed).condition;
  return found;
}

Eigen::MatrixXd covariance(const Eigen::MatrixXd& weighed, const std::vector<bool>& free) {
  const std::vector<Eigen::Index> open = indices(free);
  Eigen::MatrixXd all = Eigen::MatrixXd::Zero(weighed.cols(), weighed.cols());
  if (open.empty()) return all;
  const Eigen::MatrixXd part = weighed(Eigen::all, open);
  const Eigen::MatrixXd inverse = (part.transpose() * part).completeOrthogonalDecomposition().pseudoInverse();
  all(open, open) = inverse;
  return all;
}

std::vector<double> deviations_with(const Eigen::MatrixXd& weighed, const Eigen::RowVectorXd& row,
                                    const std::vector<bool>& free) {
  Eigen::MatrixXd more(weighed.rows() + 1, weighed.cols());
  more << weighed, row;
  const Eigen::MatrixXd all = covariance(more, free);
  std::vector<double> deviations;
  for (Eigen::Index k = 0; k < all.rows(); ++k) deviations.push_back(std::sqrt(std::max(all(k, k), 0.0)));
  return deviations;
}

}  // namespace dem::calibration
