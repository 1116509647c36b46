#pragma once
// The particles of an assembly: where they are, how they move, what acts on them.
#include <cstddef>
#include <cstdint>
#include <vector>

#include "engine/texture/laws/kinematics.h"
#include "engine/texture/laws/linear_contact.h"
#include "engine/texture/solver/kernels.h"

namespace dem::texture {

/// Eight doubles in one cache line.
struct alignas(64) Row8 {
  double v[8];
};

/// Three of the first (half 0) or of the last four numbers of a row.
inline Triple<double> triple(const Row8& r, int half) { return {r.v[4 * half], r.v[4 * half + 1], r.v[4 * half + 2]}; }

/// Velocities stand half a step before the poses.
struct Particles {
  std::vector<Row8> pose;      ///< x y z radius | w x y z
  std::vector<Row8> velocity;  ///< vx vy vz 0 | wx wy wz 0
  std::vector<Row8> force;     ///< Fx Fy Fz 0 | Mx My Mz 0
  // fixed after installation
  std::vector<Inertia> inertia;
  std::vector<std::int32_t> mineral;
  double step = 0;  ///< of time, s

  [[nodiscard]] std::size_t size() const { return pose.size(); }
  [[nodiscard]] Triple<double> place(std::int32_t particle) const { return triple(row(pose, particle), 0); }
  [[nodiscard]] double radius(std::int32_t particle) const { return row(pose, particle).v[3]; }
  [[nodiscard]] Pose<double> at(std::int32_t particle) const {
    const Row8& p = row(pose, particle);
    return {{p.v[0], p.v[1], p.v[2]}, {p.v[4], p.v[5], p.v[6], p.v[7]}};
  }
  [[nodiscard]] MovingSphere sphere(std::int32_t particle) const {
    const Row8 &p = row(pose, particle), &v = row(velocity, particle);
    return {triple(p, 0), p.v[3], triple(v, 0), triple(v, 1)};
  }

  /// Asks for what a contact of the particle needs, before it is worked on.
  void fetch_ahead(std::int32_t particle) const {
    __builtin_prefetch(row(pose, particle).v);
    __builtin_prefetch(row(velocity, particle).v);
    __builtin_prefetch(row(force, particle).v, 1);
  }
  /// Adds what a contact does to its two particles.
  void add(std::int32_t first, std::int32_t second, const Action<double>& a) {
    const auto put = [](double* to, const Triple<double>& t) { to[0] += t.x, to[1] += t.y, to[2] += t.z; };
    Row8& one = force[static_cast<std::size_t>(first)];
    Row8& two = force[static_cast<std::size_t>(second)];
    put(one.v, -1.0 * a.force);
    put(one.v + 4, a.moment_1);
    put(two.v, a.force);
    put(two.v + 4, a.moment_2);
  }

  /// Work of an action over half of the last drift, J; negative while a bond is stretched. The force that a crack takes
  /// away at the end of a step would have done half of its work over that step; what is taken away with it was never
  /// stored.
  [[nodiscard]] double half_work(std::int32_t first, std::int32_t second, const Action<double>& a) const {
    const Row8 &v1 = row(velocity, first), &v2 = row(velocity, second);
    return 0.5 * step *
           (dot(a.force, triple(v2, 0) - triple(v1, 0)) + dot(a.moment_1, triple(v1, 1)) +
            dot(a.moment_2, triple(v2, 1)));
  }

  template <class Archive>
  void archive(Archive& a) {
    a(pose, velocity, force);
  }

 private:
  static const Row8& row(const std::vector<Row8>& rows, std::int32_t particle) {
    return rows[static_cast<std::size_t>(particle)];
  }
};

}  // namespace dem::texture
