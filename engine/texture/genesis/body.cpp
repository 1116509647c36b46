#include "engine/texture/genesis/body.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/texture/genesis/packing.h"

namespace dem::texture {
namespace {

constexpr double pi = std::numbers::pi;

// From the place in the upright vessel to that in the body's box: a rotation and a shift.
Vec3 laid(const Body& body, const Cylinder& vessel, const Vec3& at) {
  const auto& [x, y, z] = at;
  switch (body.shape) {
    case Body::Shape::disc:
      return {x, vessel.height / 2 - z, y + body.size[2] / 2};
    case Body::Shape::half_disc:
      return {x, vessel.height / 2 - z, y};
    case Body::Shape::bar:
      return {z - vessel.height / 2, y, body.size[2] / 2 - x};
    case Body::Shape::cylinder:
      break;
  }
  return at;
}

void keep_only(const std::vector<bool>& keep, Packing& packing) {
  std::vector<std::int32_t> place(keep.size(), -1);
  std::size_t kept = 0;
  for (std::size_t i = 0; i < keep.size(); ++i) {
    if (!keep[i]) continue;
    place[i] = static_cast<std::int32_t>(kept);
    packing.position[kept] = packing.position[i];
    packing.radius[kept] = packing.radius[i];
    ++kept;
  }
  packing.position.resize(kept);
  packing.radius.resize(kept);
  std::erase_if(packing.contacts, [&](const auto& pair) {
    return !keep[static_cast<std::size_t>(pair[0])] || !keep[static_cast<std::size_t>(pair[1])];
  });
  for (auto& [i, j] : packing.contacts) {
    i = place[static_cast<std::size_t>(i)];
    j = place[static_cast<std::size_t>(j)];
  }
}

}  // namespace

bool Body::holds(const Vec3& at) const {
  const auto& [x, y, z] = at;
  switch (shape) {
    case Shape::half_disc:
      return z >= 0;
    case Shape::bar:
      return std::abs(x) <= size[0] / 2 && std::abs(y) <= size[1] / 2 && z >= 0 && z <= size[2];
    case Shape::cylinder:
    case Shape::disc:
      break;
  }
  return true;  // as it was moulded
}

double Body::volume() const {
  const auto& [x, y, z] = size;
  switch (shape) {
    case Shape::disc:
      return pi / 4 * x * x * y;
    case Shape::half_disc:
      return pi / 8 * x * x * y;
    case Shape::bar:
      return x * y * z;
    case Shape::cylinder:
      break;
  }
  return dem::texture::volume({x, z});
}

double Body::smallest() const { return std::ranges::min(size); }

bool Body::notched(const Vec3& one, const Vec3& two) const {
  if (notch <= 0 || (one[0] < 0) == (two[0] < 0)) return false;
  const double share = one[0] / (one[0] - two[0]);
  return one[2] + share * (two[2] - one[2]) < notch;
}

Cylinder vessel_of(const Body& body, double margin) {
  const auto& [x, y, z] = body.size;
  switch (body.shape) {
    case Body::Shape::disc:
    case Body::Shape::half_disc:
      return {x, y};
    case Body::Shape::bar:
      return {std::hypot(y, z) + 2 * margin, x + 2 * margin};
    case Body::Shape::cylinder:
      break;
  }
  return {x, z};
}

void cut_out(const Body& body, const Cylinder& vessel, Genesis& genesis) {
  Packing& packing = genesis.packing;
  for (Vec3& at : packing.position) at = laid(body, vessel, at);
  for (Vec3& at : genesis.seeds.position) at = laid(body, vessel, at);
  std::vector<bool> keep;
  for (const Vec3& at : packing.position) keep.push_back(body.holds(at));
  if (std::ranges::find(keep, false) == keep.end()) return;
  keep_only(keep, packing);
  // What hangs on by one or two contacts is no rock.
  for (bool loose = true; loose;) {
    std::vector<int> contacts(packing.position.size(), 0);
    for (const auto& [i, j] : packing.contacts) {
      ++contacts[static_cast<std::size_t>(i)];
      ++contacts[static_cast<std::size_t>(j)];
    }
    keep.assign(contacts.size(), true);
    for (std::size_t i = 0; i < contacts.size(); ++i) keep[i] = contacts[i] >= 3;
    loose = std::ranges::find(keep, false) != keep.end();
    if (loose) keep_only(keep, packing);
  }
  if (packing.position.empty()) throw CaseError("no particle lies in the body that is cut out of the packing");
  double solid = 0;
  for (const double r : packing.radius) solid += sphere_volume(r);
  packing.coordination =
      2 * static_cast<double>(packing.contacts.size()) / static_cast<double>(packing.position.size());
  packing.porosity = 1 - solid / body.volume();
}

}  // namespace dem::texture
