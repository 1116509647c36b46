#pragma once
// The inner loop's data, as plain pointers: one kernel source (kernel.cpp) is compiled for several vector widths and
// must not share inline code with the rest of the program. Elements stand in rows along y; slot = row * pitch + column.
//
// The law of a bond, Liu et al. 2017, sections 2 and 4 (SI units, tension positive):
//   normal    Fn = Kn Xn                              Xn = |r| - d
//   shear     Fs = Ks Xs, at the centres              Xs <- rotated onto the new contact plane, + tangential increment
//   breaks    Xn > Xb (opening)  or  |Fs| > Fs0 - mu_p Fn (sliding), Eq. 1
//   broken    Fn = Kn min(Xn, 0),  |Fs| <= -mu_p Fn;  what is cut off in a step is frictional heat, Eqs. 22, 23
// As coded: Xn = (2 R.D + D.D) / (|r| + d) from displacements D, free of cancellation; the shear room Fs0 - mu_p Fn is
// taken as zero where it would be negative. Breaking heat is the elastic energy lost (Eqs. 16, 21) less the work that
// the lost part of the force would have done in the half step on the way, which the published rule leaves out.

namespace dem::lattice {

inline constexpr int directions = 6;  // bonds owned by an element: +y, two to the next row, three to the layer above

/// A number as often as the widest vector has lanes, so that it is an operand in memory.
struct alignas(64) Wide {
  double lane[8];
};

/// Everything that is the same for all bonds.
struct Constants {
  long pitch;                   // of motion and shear
  long force_pitch;             // of forces: with a vector of zeros between components, for reads one column aside
  Wide kn, ks, ks2, half_ks;    // N/m, N/m, (N/m)^2, N/m
  Wide xb, fs0, mu;             // m, N, 1; xb and fs0 are infinite for unbreakable bonds
  Wide d, d2;                   // element diameter, m; its square
  Wide bond[2][directions][3];  // reference vectors, by kind of layer (A, B)
  Wide keep, push;              // w+ = keep w- + push F: (1-a)/(1+a), dt^2/(m (1+a)), a = eta dt / 2m
  int axis;                     // of loading: 0, 1, 2
};

/// The bonds of one vector of elements: a byte a direction, in it a bit a lane.
struct Bits {
  unsigned char intact[8], broken[8];  // the last two of each are zero
};

struct Event {
  long long step;
  int row, column, direction;
  int mode;                        // 0 opening, 1 sliding
  double heat_normal, heat_shear;  // J
};

/// One row: its own arrays and those of the rows around, shifted so that index c means the neighbour of column c.
/// Motion is six components of `pitch` values: ux uy uz (m) and wx wy wz (displacement of the last step, m).
struct Row {
  int index;
  int layer_kind;
  double* self;
  const double* other[directions];
  double* shear;                     // Xs of owned bonds, vector by vector of columns: 6 x 3 x lanes
  double* force;                     // 5 x 3 x force_pitch: force of owned bonds in directions 1..5
  const double* source[directions];  // 1..5: force of the bond that ends here
  double* sum;                       // 3 x pitch: own bonds and the one from the left
  Bits* bits;                        // by vector of columns
  double* viscous;                   // sum of |w- + w+|^2
  double* friction;                  // J
  double* sample;                    // 4 x pitch: elastic normal, shear (J); w-.w+, (w- + w+).w- (m^2)
  const double* push;                // 3 x pitch: constant force, N, or null without gravity and pressure
  // Only in rows with elements at a plane:
  const double* plane_stiffness;  // null in other rows
  double* plane_position;
  const double* held;   // 1 where the plane prescribes the motion along the axis
  double* plane_force;  // out: spring force, or for held elements the force that the bonds exert
};

/// Events of one thread in one step; never overflows: sized for all its bonds.
struct Events {
  Event* items;
  int count;
  long long step;
};

struct Kernel {
  int lanes;
  /// Forces of the row's own bonds at the present displacements; breaks bonds; leaves row.sum and row.force.
  void (*forces)(const Constants&, const Row&, bool sample, Events&);
  /// Gathers the forces on the row's elements in a fixed order and moves them by one leapfrog step.
  void (*advance)(const Constants&, const Row&, bool sample);
};

const Kernel& kernel_sse2();
const Kernel& kernel_avx2();
const Kernel& kernel_avx512();

}  // namespace dem::lattice
