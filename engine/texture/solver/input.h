#pragma once
// What an assembly is made of.
#include <array>
#include <cstdint>
#include <vector>

#include "engine/texture/laws/properties.h"

namespace dem::texture {

using Vec3 = std::array<double, 3>;

/// One contact as installed: free of stress at the present distance.
struct BondSpec {
  std::int32_t first = 0, second = 0;
  bool boundary = false;    ///< true: parallel bond (between grains), false: flat joint (inside)
  bool frictional = false;  ///< true: no bond at all, only the linear part
  ContactGroup group;
};

/// One face of a rigid end that bears on the specimen: a plane, a strip of it along y, or a hollow jaw with its axis along
/// y. The place of the end is that of the plane, or of the line where the jaw is lowest (of the lower end) or highest.
struct Face {
  double x = 0;      ///< m: middle of the strip, or that line
  double jaw = 0;    ///< m: radius of a hollow jaw; 0: a plane
  double strip = 0;  ///< m: half the width of a strip, bedded on the rough surface that it lies on; 0: the whole plane
};

struct AssemblyInput {
  std::vector<Vec3> position;         ///< m, ordered in slabs along z (order_in_slabs)
  std::vector<double> radius;         ///< m
  std::vector<double> density;        ///< kg/m^3
  std::vector<std::int32_t> mineral;  ///< index into `fresh` and wall_modulus
  std::vector<BondSpec> bonds;
  std::vector<std::vector<ContactGroup>> fresh;  ///< [mineral][mineral]: linear parts of contacts that form later
  std::vector<double> wall_modulus;              ///< E_c of each mineral, Pa, for contacts with walls
  bool slides = false;  ///< the grips move along x, the upper is free along z; z_low and z_high are then places along x
  std::vector<std::int8_t> grip;           ///< 0 free, 1 held by the lower grip, 2 by the upper; empty: none
  bool platens = false;                    ///< frictionless rigid ends at z_low and z_high
  std::array<std::vector<Face>, 2> faces;  ///< of the lower and the upper one; empty: a plane each
  double z_low = 0, z_high = 0;            ///< m; lower and upper platen (or grip face)
  double jacket_radius = 0;       ///< m; frictionless cylindrical wall round the z axis, for confine(); 0: none
  bool membrane = false;          ///< its pressure is carried by a flexible membrane, not by a rigid cylinder
  double damping = 0.7;           ///< alpha
  double time_step_factor = 0.8;  ///< of the critical step from the stiffness sums
  int slabs = 0;                  ///< 0: chosen
};

}  // namespace dem::texture
