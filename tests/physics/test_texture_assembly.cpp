// The solver: conservation, the energy account, the same bits for any thread count and instruction set, failure loads.
#include <doctest/doctest.h>

#include <cmath>
#include <cstring>

#include "engine/core/archive.h"
#include "engine/texture/solver/assembly.h"
#include "tests/support/granite.h"
#include "tests/support/near.h"

using namespace dem::texture;

namespace {

bool same_bits(const std::vector<Row8>& a, const std::vector<Row8>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(Row8)) == 0;
}

void shake(Assembly& assembly, double speed) {
  dem::RandomStream random(11, dem::Purpose::test_data);
  for (Row8& row : assembly.velocities()) {
    for (int k : {0, 1, 2}) row.v[k] = random.uniform(-speed, speed);
    for (int k : {4, 5, 6}) row.v[k] = random.uniform(-speed, speed) / 1e-3;
  }
}

struct Momenta {
  double linear[3] = {0, 0, 0}, angular[3] = {0, 0, 0}, linear_size = 0, angular_size = 0;
};

// With half-step velocities the angular momentum is that of x at the end of the drift and v before the next kick: forces
// are central in the sum, so it is kept all the same.
Momenta momenta(Assembly& assembly) {
  Momenta m;
  for (std::size_t i = 0; i < assembly.particles(); ++i) {
    const double *x = assembly.poses()[i].v, *v = assembly.velocities()[i].v;
    const double mass = assembly.mass(i), inertia = 0.4 * mass * x[3] * x[3];
    for (int a = 0; a < 3; ++a) {
      const int b = (a + 1) % 3, c = (a + 2) % 3;
      m.linear[a] += mass * v[a];
      m.angular[a] += mass * (x[b] * v[c] - x[c] * v[b]) + inertia * v[4 + a];
      m.linear_size += std::abs(mass * v[a]);
      m.angular_size += std::abs(mass * x[b] * v[c]) + std::abs(inertia * v[4 + a]);
    }
  }
  return m;
}

}  // namespace

TEST_CASE("an isolated, undamped specimen keeps momentum and angular momentum to rounding, and its energy") {
  AssemblyInput input = dem_test::block(6, 6, 14);
  input.damping = 0;
  Assembly assembly(input, 2);
  SUBCASE("intact") { shake(assembly, 0.1); }
  SUBCASE("breaking, sliding, new contacts") { shake(assembly, 4.0); }
  const Momenta before = momenta(assembly);
  const double start = assembly.advance(1).ledger.kinetic;
  Sample sample;
  double worst = 0;
  for (int k = 0; k < 20; ++k) {
    sample = assembly.advance(100);
    worst = std::max(worst, std::abs(sample.ledger.residual() + start));
  }
  const Momenta after = momenta(assembly);
  for (int a = 0; a < 3; ++a) {
    CHECK(std::abs(after.linear[a] - before.linear[a]) < 1e-12 * before.linear_size);
    CHECK(std::abs(after.angular[a] - before.angular[a]) < 1e-11 * before.angular_size);
  }
  MESSAGE("cracks ", assembly.cracks().size(), ", fresh contacts ", assembly.fresh_contacts(), ", energy error ",
          worst / start);
  CHECK(worst < 1e-2 * start);
}

TEST_CASE("the account closes in a driven, damped, breaking specimen") {
  AssemblyInput input = dem_test::block(6, 6, 14);
  input.platens = true;
  Assembly assembly(input, 2);
  const double speed = 5e-7 * input.z_high / assembly.time_step();
  assembly.drive(speed / 2, -speed / 2, 200);
  double peak_work = 0, worst = 0;
  Sample last;
  for (int k = 0; k < 300; ++k) {
    last = assembly.advance(100);
    peak_work = std::max(peak_work, last.ledger.work);
    worst = std::max(worst, std::abs(last.ledger.residual()) / std::max(last.ledger.work, 1e-2 * peak_work));
  }
  MESSAGE("cracks ", assembly.cracks().size(), ", residual ", worst);
  CHECK(assembly.cracks().size() > 50);
  CHECK(worst < 1e-2);
  // What cracks say they released is what the ledger counts; bonds that part in tension pulled their second particle back.
  double released = 0;
  std::size_t pulled = 0, tension = 0;
  for (const Crack& c : assembly.cracks()) {
    released += c.released;
    if (c.shear != 0) continue;
    ++tension;
    pulled += c.force[0] * c.normal[0] + c.force[1] * c.normal[1] + c.force[2] * c.normal[2] < 0;
  }
  CHECK(released == doctest::Approx(last.ledger.bond_tension + last.ledger.bond_shear).epsilon(1e-9));
  CHECK(tension > 0);
  CHECK(pulled == tension);
}

TEST_CASE("the same bits for one and two threads, for a number that changes, and for every instruction set") {
  AssemblyInput input = dem_test::block(6, 6, 14);
  input.platens = true;
  const auto run = [&](std::vector<int> threads, const char* name) {
    Assembly assembly(input, threads.front());
    assembly.set_kernels(*kernels(name));
    const double speed = 8e-6 * input.z_high / assembly.time_step();
    assembly.drive(speed / 2, -speed / 2, 50);
    for (std::size_t k = 0; k < 30; ++k) {
      assembly.set_threads(threads[k % threads.size()]);
      assembly.advance(100);
    }
    CHECK(assembly.cracks().size() > 10);
    return assembly.poses();
  };
  const std::vector<Row8> reference = run({1}, "sse2");
  for (const char* name : {"sse2", "wide", "avx2", "avx512"}) {
    if (kernels(name) == nullptr) continue;
    CAPTURE(name);
    CHECK(same_bits(reference, run({2}, name)));
    CHECK(same_bits(reference, run({1, 3, 2}, name)));
  }
}

TEST_CASE("a specimen that is saved and loaded goes on to the same bits") {
  AssemblyInput input = dem_test::block(5, 5, 10);
  input.platens = true;
  Assembly whole(input, 1);
  const double speed = 8e-6 * input.z_high / whole.time_step();
  whole.drive(speed / 2, -speed / 2, 50);
  whole.advance(1500);
  dem::ArchiveWriter writer;
  writer(whole);
  Assembly resumed(input, 2);
  dem::ArchiveReader reader(writer.bytes());
  reader(resumed);
  const Sample a = whole.advance(1500), b = resumed.advance(1500);
  CHECK(same_bits(whole.poses(), resumed.poses()));
  CHECK(a.ledger.residual() == b.ledger.residual());
  CHECK(whole.cracks().size() == resumed.cracks().size());
}

TEST_CASE("two gripped particles fail at the strength of their bond") {
  const Settings s = dem_test::granite(10, 20);
  for (const bool boundary : {false, true}) {
    CAPTURE(boundary);
    AssemblyInput input;
    input.position = {{0, 0, 0.4e-3}, {0, 0, 1.25e-3}};
    input.radius = {0.4e-3, 0.5e-3};
    input.density = {2600, 2600};
    input.mineral = {1, 1};
    input.grip = {1, 2};
    BondSpec spec;
    spec.second = 1;
    spec.boundary = boundary;
    spec.group =
        boundary ? between(s.minerals[1], s.minerals[1], s.interaction) : inside(s.minerals[1], JointModulus::sum);
    input.bonds = {spec};
    for (const Mineral& a : s.minerals) {
      input.fresh.emplace_back();
      for (const Mineral& b : s.minerals) input.fresh.back().push_back(between(a, b, s.interaction));
      input.wall_modulus.push_back(a.modulus);
    }
    Assembly assembly(input, 1);
    const double kn = spec.group.bond_modulus / 0.9e-3, opening = spec.group.tensile_strength / kn;
    const double speed =
        2e-7 * opening / assembly.time_step();  // some five million steps would be exact; sample finely
    assembly.drive(-10000 * speed / 2, 10000 * speed / 2, 1);
    double peak = 0, work = 0;
    while (assembly.cracks().empty() && assembly.step() < 2000) {
      const Sample sample = assembly.advance(1);
      if (assembly.cracks().empty()) peak = std::max(peak, sample.force[1]);
      work = sample.ledger.work;
    }
    REQUIRE_FALSE(assembly.cracks().empty());
    const double strength = spec.group.tensile_strength * 3.141592653589793 * 0.16e-6;
    CHECK(peak == test::near(strength).epsilon(3e-3));  // one step is 0.2 % of the way
    CHECK(peak <= strength * (1 + 1e-9));
    CHECK(work == test::near(0.5 * strength * opening).epsilon(1e-2));
  }
}

TEST_CASE(
    "a particle that spins between two others is stopped by friction as a ball between two plates, its account "
    "closed") {
  const Settings s = dem_test::granite(10, 20);
  for (const bool bonded : {false, true}) {
    CAPTURE(bonded);
    const double r = 0.4e-3;
    AssemblyInput input;
    input.position = {{0, 0, r}, {0, 0, 3 * r}, {0, 0, 5 * r}};
    input.radius = {r, r, r};
    input.density = {2600, 2600, 2600};
    input.mineral = {1, 1, 1};
    input.grip = {1, 0, 2};
    input.damping = 0;
    for (const std::int32_t lower : {0, 1}) {
      BondSpec spec;
      spec.first = lower;
      spec.second = lower + 1;
      spec.boundary = true;
      spec.frictional = !bonded;
      spec.group = between(s.minerals[1], s.minerals[1], s.interaction);
      spec.group.cohesion = 1;  // Pa: it breaks at the first slide
      spec.group.friction_angle = 0;
      input.bonds.push_back(spec);
    }
    for (const Mineral& a : s.minerals) {
      input.fresh.emplace_back();
      for (const Mineral& b : s.minerals) input.fresh.back().push_back(between(a, b, s.interaction));
      input.wall_modulus.push_back(a.modulus);
    }
    Assembly assembly(input, 1);
    const double squeeze = 1e-4 * r, dt = assembly.time_step();
    assembly.drive(squeeze / (1000 * dt), -squeeze / (1000 * dt), 1);
    assembly.advance(1000);
    assembly.drive(0, 0, 1);
    assembly.advance(2);
    const ContactGroup& group = input.bonds[0].group;
    const double load = 3.141592653589793 * r * r * group.modulus / (2 * r) * squeeze;  // N, of the linear part
    const double moment = 2 * group.friction * load * r, inertia = 0.4 * assembly.mass(1) * r * r, spin = 3e5;  // rad/s
    assembly.velocities()[1].v[4] = spin;
    const Sample given = assembly.advance(1);
    const double energy = 0.5 * inertia * spin * spin;
    const auto until = [&](double share) { return static_cast<std::int64_t>(share * inertia * spin / moment / dt); };
    REQUIRE(static_cast<double>(until(1)) * dt * spin / 2 > 0.5);  // it turns by more than half a radian on the way
    double worst = 0;
    for (int k = 0; k < 9; ++k) {
      const Sample sample = assembly.advance(until(0.1));
      worst = std::max(worst, std::abs(sample.ledger.residual() - given.ledger.residual()) / energy);
    }
    MESSAGE("steps ", until(1.0), ", account ", worst);
    const double expected = spin - 9 * static_cast<double>(until(0.1)) * dt * moment / inertia;  // some 0.11 of it
    CHECK(assembly.velocities()[1].v[4] == test::near(expected).epsilon(0.05));
    CHECK(worst < 2e-4);
    CHECK(assembly.cracks().size() == (bonded ? 2U : 0U));
    const Sample rest = assembly.advance(until(1.0));
    CHECK(std::abs(assembly.velocities()[1].v[4]) < 0.05 * spin);
    CHECK(rest.ledger.friction == test::near(energy).epsilon(0.02));
  }
}
