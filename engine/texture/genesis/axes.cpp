#include "engine/texture/genesis/axes.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "engine/texture/genesis/packing.h"

namespace dem::texture {
namespace {

/// Volume, first and second moments of spheres.
struct Moments {
  double volume = 0;
  Eigen::Vector3d first = Eigen::Vector3d::Zero();
  Eigen::Matrix3d second = Eigen::Matrix3d::Zero();

  void add(const Vec3& at, double radius) {
    const double v = sphere_volume(radius);
    const Eigen::Vector3d p(at[0], at[1], at[2]);
    volume += v;
    first += v * p;
    second += v * (p * p.transpose() + radius * radius / 5 * Eigen::Matrix3d::Identity());
  }
};

/// About the centre, for a volume of 1.
Eigen::Matrix3d central(const Moments& m) {
  const Eigen::Vector3d centre = m.first / m.volume;
  return m.second / m.volume - centre * centre.transpose();
}

OwnAxes axes_of(const Moments& m) {
  OwnAxes own;
  if (m.volume <= 0) return own;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solved(central(m));
  // <x^2> of a solid ellipsoid is a^2/5. Eigenvalues rise.
  const auto semi_axis = [&](Eigen::Index k) { return std::sqrt(5 * std::max(0.0, solved.eigenvalues()[k])); };
  own.semi_long = semi_axis(2);
  own.semi_middle = semi_axis(1);
  own.semi_short = semi_axis(0);
  const Eigen::Vector3d along = solved.eigenvectors().col(2);
  const double sign = along[2] < 0 ? -1 : 1;  // an axis has no sense: the one that points up
  own.axis = {sign * along[0], sign * along[1], sign * along[2]};
  return own;
}

std::vector<Moments> moments_of(const Packing& packing, const GrainMap& grains, std::size_t count) {
  std::vector<Moments> moments(count);
  for (std::size_t i = 0; i < packing.radius.size(); ++i)
    moments[static_cast<std::size_t>(grains.grain[i])].add(packing.position[i], packing.radius[i]);
  return moments;
}

}  // namespace

std::vector<OwnAxes> own_axes(const Packing& packing, const GrainMap& grains, std::size_t count) {
  std::vector<OwnAxes> own;
  own.reserve(count);
  for (const Moments& m : moments_of(packing, grains, count)) own.push_back(axes_of(m));
  return own;
}

double realised_aspect_ratio(const Packing& packing, const GrainMap& grains, std::size_t count, const Vec3& axis) {
  Eigen::Matrix3d all = Eigen::Matrix3d::Zero();
  for (const Moments& m : moments_of(packing, grains, count))
    if (m.volume > 0) all += m.volume * central(m);
  const Eigen::Vector3d a(axis[0], axis[1], axis[2]);
  const double along = a.dot(all * a), across = 0.5 * (all.trace() - along);
  return std::sqrt(along / across);
}

}  // namespace dem::texture
