#include "engine/texture/genesis/relax.h"

#include <omp.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace dem::texture {
namespace {

constexpr double pi = std::numbers::pi;
constexpr std::size_t block_size = 512;
constexpr int watch_interval = 20;

/// Mass of a sphere, in proportion to its stiffness: the stable step is then near 0.6 whatever the radius.
double mass(double r) { return pi * r; }

}  // namespace

CellGrid cells_of(const std::vector<Sphere>& spheres, double edge) {
  return {spheres.size(), edge, [&](std::size_t i) { return std::array{spheres[i].x, spheres[i].y, spheres[i].z}; }};
}

void Pile::Sums::add(const Sums& other) {
  power += other.power;
  force2 += other.force2;
  speed2 += other.speed2;
  unbalanced += other.unbalanced;
  contact_force += other.contact_force;
  wall_force += other.wall_force;
  contacts += other.contacts;
}

Pile::Pile(double diameter, double height, std::vector<Sphere> spheres, double force_floor, int threads)
    : radius_(diameter / 2),
      height_(height),
      force_floor_(force_floor),
      threads_(std::max(threads, 1)),
      spheres_(std::move(spheres)),
      velocity_(spheres_.size()),
      force_(spheres_.size()) {}

double Pile::unbalance() const { return state_.mean_unbalanced / std::max(state_.mean_contact_force, force_floor_); }

std::size_t Pile::blocks() const { return (spheres_.size() + block_size - 1) / block_size; }

// A thread earns its keep from some eight thousand spheres on; fewer wait at barriers, the more so on a busy machine.
int Pile::workers() const { return std::clamp(static_cast<int>(blocks() / 16), 1, threads_); }

void Pile::scale_radii(double factor) {
  for (Sphere& s : spheres_) s.r *= factor;
}

void Pile::keep_only(const std::vector<bool>& keep) {
  std::vector<Sphere> kept;
  kept.reserve(spheres_.size());
  for (std::size_t i = 0; i < spheres_.size(); ++i)
    if (keep[i]) kept.push_back(spheres_[i]);
  spheres_ = std::move(kept);
  velocity_.resize(spheres_.size());
  force_.resize(spheres_.size());
}

void Pile::find_neighbours(double skin) {
  double largest = 0;
  for (const Sphere& s : spheres_) largest = std::max(largest, s.r);
  const CellGrid grid = cells_of(spheres_, 2 * largest + skin);
  const auto count = static_cast<std::int64_t>(blocks());
  std::vector<std::vector<std::int32_t>> found(blocks());
  first_.assign(spheres_.size() + 1, 0);
#pragma omp parallel for num_threads(workers()) schedule(static)
  for (std::int64_t b = 0; b < count; ++b) {
    const std::size_t begin = b * block_size;
    const std::size_t end = std::min(begin + block_size, spheres_.size());
    std::vector<std::int32_t>& list = found[b];
    list.reserve((end - begin) * 14);
    for (std::size_t i = begin; i < end; ++i) {
      const Sphere s = spheres_[i];
      const std::size_t before = list.size();
      grid.around({s.x, s.y, s.z}, [&](std::int32_t j) {
        const Sphere& t = spheres_[j];
        const double dx = s.x - t.x, dy = s.y - t.y, dz = s.z - t.z;
        const double reach = s.r + t.r + skin;
        if (dx * dx + dy * dy + dz * dz < reach * reach && j != static_cast<std::int32_t>(i)) list.push_back(j);
      });
      first_[i + 1] = static_cast<std::int32_t>(list.size() - before);
    }
  }
  for (std::size_t i = 1; i < first_.size(); ++i) first_[i] += first_[i - 1];
  neighbour_.resize(first_.back());
  for (std::size_t b = 0; b < found.size(); ++b)
    std::copy(found[b].begin(), found[b].end(), neighbour_.begin() + first_[b * block_size]);
  searched_ = spheres_;
}

Pile::Sums Pile::evaluate_block(std::size_t begin, std::size_t end) {
  Sums sums;
  for (std::size_t i = begin; i < end; ++i) {
    const Sphere s = spheres_[i];
    Vector f;
    for (std::int32_t n = first_[i]; n < first_[i + 1]; ++n) {
      const Sphere& t = spheres_[neighbour_[n]];
      const double dx = s.x - t.x, dy = s.y - t.y, dz = s.z - t.z;
      const double reach = s.r + t.r;
      const double d2 = dx * dx + dy * dy + dz * dz;
      if (d2 >= reach * reach || d2 == 0) continue;
      const double d = std::sqrt(d2);
      const double r = std::min(s.r, t.r);
      const double along = pi * r * r * (reach - d) / (reach * d);  // F / d
      f.x += along * dx;
      f.y += along * dy;
      f.z += along * dz;
      sums.contact_force += along * d;
      ++sums.contacts;
    }
    // Walls: kn = pi R.
    const double below = std::max(s.r - s.z, 0.0);
    const double above = std::max(s.z + s.r - height_, 0.0);
    const double axis = std::sqrt(s.x * s.x + s.y * s.y);
    const double side = std::max(axis + s.r - radius_, 0.0);
    const double kn = pi * s.r;
    f.z += kn * (below - above);
    if (side > 0) {
      f.x -= kn * side * s.x / axis;
      f.y -= kn * side * s.y / axis;
    }
    sums.wall_force += kn * (below + above + side);
    const Vector& v = velocity_[i];
    const double f2 = f.x * f.x + f.y * f.y + f.z * f.z;
    sums.power += f.x * v.x + f.y * v.y + f.z * v.z;
    sums.force2 += f2 / mass(s.r);
    sums.speed2 += (v.x * v.x + v.y * v.y + v.z * v.z) * mass(s.r);
    sums.unbalanced += std::sqrt(f2);
    force_[i] = f;
  }
  return sums;
}

Pile::Sums Pile::evaluate() {
  block_sums_.resize(blocks());
  const auto count = static_cast<std::int64_t>(blocks());
#pragma omp parallel for num_threads(workers()) schedule(static)
  for (std::int64_t b = 0; b < count; ++b)
    block_sums_[b] = evaluate_block(b * block_size, std::min((b + 1) * block_size, spheres_.size()));
  Sums total;
  for (const Sums& sums : block_sums_) total.add(sums);
  const double area = 2 * pi * radius_ * radius_ + 2 * pi * radius_ * height_;
  state_.contacts = total.contacts / 2;
  state_.mean_contact_force = total.contacts > 0 ? total.contact_force / static_cast<double>(total.contacts) : 0;
  state_.mean_unbalanced = total.unbalanced / static_cast<double>(spheres_.size());
  state_.wall_pressure = total.wall_force / area;
  return total;
}

double Pile::advance(double keep, double push, double dt) {
  const auto count = static_cast<std::int64_t>(blocks());
  double farthest = 0;
#pragma omp parallel for num_threads(workers()) schedule(static) reduction(max : farthest)
  for (std::int64_t b = 0; b < count; ++b) {
    const std::size_t end = std::min((b + 1) * block_size, spheres_.size());
    for (std::size_t i = b * block_size; i < end; ++i) {
      Sphere& s = spheres_[i];
      Vector& v = velocity_[i];
      // A sphere that touches nothing waits: flying through its cage it would only ask for neighbour searches.
      const bool free = force_[i].x == 0 && force_[i].y == 0 && force_[i].z == 0;
      const double a = push / mass(s.r);
      if (free) v = {};
      v.x = keep * v.x + a * force_[i].x;
      v.y = keep * v.y + a * force_[i].y;
      v.z = keep * v.z + a * force_[i].z;
      s.x += dt * v.x;
      s.y += dt * v.y;
      s.z += dt * v.z;
      const double dx = s.x - searched_[i].x, dy = s.y - searched_[i].y, dz = s.z - searched_[i].z;
      farthest = std::max(farthest, dx * dx + dy * dy + dz * dz);
    }
  }
  return farthest;
}

void Pile::step_back(double dt) {
  for (std::size_t i = 0; i < spheres_.size(); ++i) {
    spheres_[i].x -= dt * velocity_[i].x;
    spheres_[i].y -= dt * velocity_[i].y;
    spheres_[i].z -= dt * velocity_[i].z;
    velocity_[i] = {};
  }
}

bool Pile::relax(double tolerance, double skin, int max_steps, const Watch& watch) {
  if (spheres_.empty()) return true;
  // The step is in units of sqrt(mass / stiffness): dense packings are stable to about 0.9. Smallest number of steps
  // over alpha 0.02 ... 0.25, delay 5 and 20, dt_max 0.5 ... 1.1, five packings of 2,300 spheres each.
  constexpr double alpha_start = 0.1, alpha_shrink = 0.99, grow = 1.1, shrink = 0.5, dt_start = 0.1, dt_max = 0.7;
  constexpr int delay = 5;
  double alpha = alpha_start;
  double dt = dt_start;
  int downhill = 0;
  std::fill(velocity_.begin(), velocity_.end(), Vector{});
  find_neighbours(skin);
  for (int step = 0; step < max_steps; ++step, ++steps_) {
    Sums sums = evaluate();
    if (step % watch_interval == 0) watch(state_);
    if (unbalance() <= tolerance) return true;
    if (sums.power > 0) {
      if (++downhill > delay) {
        dt = std::min(dt * grow, dt_max);
        alpha *= alpha_shrink;
      }
    } else {
      if (step > 0) {
        // The forces stay those of the place before the half step back: they only steer the next step.
        step_back(dt / 2);
        dt = std::max(dt * shrink, 0.02 * dt_start);
      }
      downhill = 0;
      alpha = alpha_start;
      sums.power = sums.speed2 = 0;
    }
    // Speed after the push, then the mix of velocity and force direction.
    const double speed2 = sums.speed2 + 2 * dt * sums.power + dt * dt * sums.force2;
    const double mix = sums.force2 > 0 ? alpha * std::sqrt(speed2 / sums.force2) : 0;
    const double farthest = advance(1 - alpha, (1 - alpha) * dt + mix, dt);
    if (4 * farthest > skin * skin) find_neighbours(skin);
  }
  evaluate();
  return unbalance() <= tolerance;
}

std::vector<int> Pile::contact_counts() const {
  std::vector<int> count(spheres_.size(), 0);
  for (std::size_t i = 0; i < spheres_.size(); ++i) {
    const Sphere& s = spheres_[i];
    for (std::int32_t n = first_[i]; n < first_[i + 1]; ++n) {
      const Sphere& t = spheres_[neighbour_[n]];
      const double dx = s.x - t.x, dy = s.y - t.y, dz = s.z - t.z;
      const double reach = s.r + t.r;
      if (dx * dx + dy * dy + dz * dz < reach * reach) ++count[i];
    }
    count[i] += s.z < s.r;
    count[i] += s.z + s.r > height_;
    count[i] += std::sqrt(s.x * s.x + s.y * s.y) + s.r > radius_;
  }
  return count;
}

}  // namespace dem::texture
