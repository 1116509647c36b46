// The close-packed lattice against the closed forms of Liu et al. 2017: conversions, the single unit, elastic
// constants.
#include <doctest/doctest.h>

#include <cmath>
#include <functional>

#include "engine/core/errors.h"
#include "engine/lattice/loading.h"
#include "engine/lattice/moduli.h"
#include "tests/support/near.h"

using namespace dem::lattice;

namespace {

const Rock quartzite{90e9, 0.16, 25e6, 252e6, 1, 2650};

Micro micro() { return micro_of(quartzite, 1e-3); }

Setup setup_for(const Block& block, PlaneKind planes) {
  Setup s;
  s.micro = micro();
  s.planes = planes;
  s.viscosity = viscosity(s.micro, static_cast<long>(block.site.size()));
  return s;
}

std::string message_of(const std::function<void()>& act) {
  try {
    act();
  } catch (const dem::InputError& e) {
    return e.what();
  }
  return "no error";
}

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

}  // namespace

TEST_CASE("the conversion gives the published element parameters of quartzite (Table 1)") {
  const Micro m = micro();
  CHECK(m.kn == test::near(46.794e6).epsilon(1e-5));
  CHECK(m.ks == test::near(8.068e6).epsilon(1e-4));
  CHECK(m.xb == test::near(1.704e-7).epsilon(3e-4));
  CHECK(m.fs0 == test::near(18.452).epsilon(3e-5));
  CHECK(std::abs(m.mu - 0.3964) <= 0.00005);  // as many digits as are published
  CHECK(m.mass == test::near(1.874e-6).epsilon(1e-4));
  CHECK(opening_stress(m) == test::near(95.9e6).epsilon(1e-3));
}

TEST_CASE("the conversion is undone by its inverse over the whole range") {
  for (const double nu : {0.0, 0.05, 0.16, 0.2}) {
    for (const double mu_i : {0.3536, 0.7, 1.0, 2.5}) {
      const Rock rock{37e9, nu, 4e6, 90e6, mu_i, 2400};
      const Rock back = rock_of(micro_of(rock, 0.7e-3));
      CHECK(back.young_modulus == test::near(rock.young_modulus).epsilon(1e-12));
      CHECK(std::abs(back.poisson_ratio - nu) <= 1e-12);
      CHECK(back.tensile_strength == test::near(rock.tensile_strength).epsilon(1e-12));
      CHECK(back.compressive_strength == test::near(rock.compressive_strength).epsilon(1e-12));
      CHECK(back.internal_friction == test::near(mu_i).epsilon(1e-4));
      CHECK(back.density == test::near(rock.density).epsilon(1e-12));
    }
  }
}

TEST_CASE("rock and elements that the lattice cannot be are refused with the reason") {
  const auto with = [](auto change) {
    Rock rock = quartzite;
    change(rock);
    return message_of([&] { (void)micro_of(rock, 1e-3); });
  };
  CHECK(has(with([](Rock& r) { r.poisson_ratio = 0.25; }), "0 ... 0.2"));
  CHECK(has(with([](Rock& r) { r.poisson_ratio = -0.01; }), "0 ... 0.2"));
  CHECK(has(with([](Rock& r) { r.tensile_strength = -25e6; }), "tensile strength"));
  CHECK(has(with([](Rock& r) { r.compressive_strength = 0; }), "compressive strength"));
  CHECK(has(with([](Rock& r) { r.internal_friction = 0.2; }), "negative"));
  Micro slippery = micro();
  slippery.mu = 0.71;
  CHECK(has(message_of([&] { (void)rock_of(slippery); }), "0.7071"));
  Micro stiff = micro();
  stiff.ks = 2 * stiff.kn;
  CHECK(has(message_of([&] { (void)rock_of(stiff); }), "between 0 and the normal stiffness"));
  CHECK(has(message_of([] { (void)block_shape(12, 12); }), "odd"));
  CHECK(has(message_of([] { (void)block_shape(1); }), "2 or more"));
  const Block block = make_block(block_shape(4), 1e-3);
  Setup fast = setup_for(block, PlaneKind::elastic);
  fast.time_step = 2e-7;
  CHECK(has(message_of([&] { Solver(block, fast); }), "stable limit"));
}

TEST_CASE("a single unit moves as Eqs. 2a-2d say") {
  const Block block = make_block(block_shape(2), 1e-3);
  REQUIRE(block.site.size() == 4);
  REQUIRE(block.bonds.size() == 6);
  Setup s = setup_for(block, PlaneKind::rigid);
  s.unbreakable = true;
  Solver solver(block, s);
  const double d = 1e-3;
  solver.run(1, 0, 1e-6 * std::sqrt(2.0 / 3) * d);
  solver.run(20000);
  const Sample at_rest = solver.sampled_step();
  REQUIRE(at_rest.kinetic < 1e-20 * at_rest.elastic());
  const UnitDisplacements u = unit_displacements(s.micro, at_rest.force[1]);
  const auto moved = solver.displacement();
  const auto shear = solver.bond_shear();
  CHECK(at_rest.force[0] == test::near(at_rest.force[1]).epsilon(1e-9));
  CHECK(moved[3][2] == test::near(u.dz).epsilon(2e-6));
  CHECK(moved[1][1] - moved[0][1] == test::near(u.xn2).epsilon(2e-6));
  for (std::size_t b = 0; b < block.bonds.size(); ++b) {
    const auto [i, j, direction] = block.bonds[b];
    double r2 = 0, rest2 = 0, s2 = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const double r0 = block.position[static_cast<std::size_t>(j)][k] - block.position[static_cast<std::size_t>(i)][k];
      const double du = moved[static_cast<std::size_t>(j)][k] - moved[static_cast<std::size_t>(i)][k];
      r2 += (r0 + du) * (r0 + du);
      rest2 += r0 * r0;
      s2 += shear[b][k] * shear[b][k];
    }
    const double xn = (r2 - rest2) / (std::sqrt(r2) + std::sqrt(rest2));
    const bool inclined = direction >= 3;
    CHECK(xn == test::near(inclined ? u.xn1 : u.xn2).epsilon(1e-5));
    if (inclined) CHECK(std::sqrt(s2) == test::near(u.xs1).epsilon(1e-5));
  }
}

TEST_CASE("a single unit has the rock's E and nu at strain 1e-6, and leaves them as strain grows") {
  const Block block = make_block(block_shape(2), 1e-3);
  const auto points = elastic_at_rest(block, setup_for(block, PlaneKind::rigid), {1e-6, 1e-4, 1e-3});
  CHECK(points[0].young_modulus == test::near(90e9).epsilon(1e-6));
  CHECK(points[0].poisson[0] == test::near(0.16).epsilon(1e-6));
  CHECK(points[0].poisson[1] == test::near(0.16).epsilon(1e-6));
  const auto error = [&](std::size_t i) { return std::abs(points[i].young_modulus / 90e9 - 1); };
  CHECK(error(1) > 10 * error(0));
  CHECK(error(2) > 5 * error(1));
}

TEST_CASE("strains at rest are those that were asked for, however much the springs at the planes take") {
  const std::vector<double> strains = {1e-6, 1e-4};
  for (const int elements : {2, 4}) {
    const Block block = make_block(block_shape(elements), 1e-3);
    const auto points = elastic_at_rest(block, setup_for(block, PlaneKind::elastic), strains);
    for (std::size_t i = 0; i < strains.size(); ++i) {
      CAPTURE(elements);
      CHECK(-points[i].strain == test::near(strains[i]).epsilon(0.01));
      CHECK(-points[i].between_planes > 1.1 * strains[i]);
    }
  }
}

TEST_CASE("a single unit fails at Tu, opens at C_open and slides near Cu") {
  const Block block = make_block(block_shape(2), 1e-3);
  Loading loading;
  loading.after = 200;
  loading.largest_strain = 0.02;
  loading.motion = 1.7e-11;  // a tenth of the paper's: its steps are 0.15 % of Tu for so small a block
  StrengthTest tension(block, setup_for(block, PlaneKind::rigid), loading);
  while (tension.advance()) {
  }
  CHECK(tension.stress(tension.peak()) / 25e6 - 1 == doctest::Approx(-0.00011).epsilon(0.0002));  // published: -0.011 %
  CHECK(tension.history().back().opening == 3);
  CHECK(tension.history().back().sliding == 0);

  loading.kind = TestKind::compression;
  loading.motion = 1.7e-10;
  StrengthTest compression(block, setup_for(block, PlaneKind::rigid), loading);
  while (compression.advance()) {
  }
  const double error = compression.stress(compression.peak()) / 252e6 - 1;
  CHECK(error < -0.0150);  // published: -1.73 %; an independent program: -1.76 and -2.0 %
  CHECK(error > -0.0210);
  double opened_at = 0;
  for (const Sample& s : compression.history()) {
    if (s.opening == 0) opened_at = compression.stress(s);
  }
  CHECK(opened_at == test::near(opening_stress(micro())).epsilon(0.005));
}

namespace {

// Elastic energy of a block under a homogeneous strain, layers B shifted by s, from the fast loop.
double block_energy(const BlockShape& shape, const double (&e)[3][3], const double (&shift)[3]) {
  const Block block = make_block(shape, 1e-3);
  Setup setup = setup_for(block, PlaneKind::rigid);
  setup.unbreakable = true;
  Solver solver(block, setup);
  std::vector<std::array<double, 3>> u(block.site.size());
  for (std::size_t i = 0; i < u.size(); ++i) {
    for (std::size_t a = 0; a < 3; ++a) {
      u[i][a] = block.site[i].layer % 2 ? shift[a] : 0.0;
      for (std::size_t b = 0; b < 3; ++b) u[i][a] += e[a][b] * block.position[i][b];
    }
  }
  solver.set_motion(u, u);
  const Sample s = solver.sampled_step();
  return s.elastic_normal + s.elastic_shear;
}

// Energy per volume of the infinite lattice: the mixed difference over the three sizes leaves four elements of the
// bulk, as a periodic patch would.
double bulk_energy(const double (&e)[3][3], const double (&shift)[3]) {
  double sum = 0;
  for (int i = 0; i < 8; ++i) {
    const BlockShape shape{5 + (i & 1), 5 + (i & 2), 5 + (i & 4) / 2};
    const int sign = ((i & 1) + (i >> 1 & 1) + (i >> 2 & 1)) % 2 ? 1 : -1;
    sum += sign * block_energy(shape, e, shift);
  }
  return sum / (4 * std::sqrt(2.0) / 2 * 1e-9);
}

// Twice the energy density per strain squared; minimised over the shift along x or y where asked.
double modulus(const double (&unit)[3][3], int relax = -1) {
  constexpr double strain = 1e-10;
  double e[3][3], shift[3] = {0, 0, 0};
  for (int a = 0; a < 3; ++a) {
    for (int b = 0; b < 3; ++b) e[a][b] = strain * unit[a][b];
  }
  const double still = bulk_energy(e, shift);
  if (relax < 0) return 2 * still / (strain * strain);
  const double step = 1e-14;
  shift[relax] = step;
  const double up = bulk_energy(e, shift);
  shift[relax] = -step;
  const double down = bulk_energy(e, shift);
  const double slope = (up - down) / 2, curve = up + down - 2 * still;
  return 2 * (still - slope * slope / (2 * curve)) / (strain * strain);
}

}  // namespace

TEST_CASE("affine and relaxed elastic constants of the bulk are those of the closed forms") {
  const Hexagonal affine = affine_moduli(micro()), relaxed = relaxed_moduli(micro());
  const double xx[3][3] = {{1, 0, 0}, {0, 0, 0}, {0, 0, 0}}, yy[3][3] = {{0, 0, 0}, {0, 1, 0}, {0, 0, 0}};
  const double zz[3][3] = {{0, 0, 0}, {0, 0, 0}, {0, 0, 1}};
  const double xx_yy[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 0}}, xx_zz[3][3] = {{1, 0, 0}, {0, 0, 0}, {0, 0, 1}};
  const double yz[3][3] = {{0, 0, 0}, {0, 0, 0.5}, {0, 0.5, 0}}, xy[3][3] = {{0, 0.5, 0}, {0.5, 0, 0}, {0, 0, 0}};
  const auto near = [](double a, double b) { return std::abs(a / b - 1) < 1e-8; };
  CHECK(near(modulus(xx), affine.c11));
  CHECK(near(modulus(yy), affine.c11));
  CHECK(near(modulus(zz), affine.c33));
  CHECK(near(modulus(xx_yy), 2 * affine.c11 + 2 * affine.c12));
  CHECK(near(modulus(xx_zz), affine.c11 + affine.c33 + 2 * affine.c13));
  CHECK(near(modulus(yz), affine.c44));
  CHECK(near(modulus(xy), affine.c66()));
  CHECK(near(modulus(xx, 0), relaxed.c11));
  CHECK(near(modulus(yy, 0), relaxed.c11));
  CHECK(near(modulus(xy, 1), relaxed.c66()));
  CHECK(near(modulus(zz, 0), relaxed.c33));
  CHECK(near(modulus(yz, 1), relaxed.c44));
  CHECK(near(relaxed.young_modulus(0), 90e9));
  CHECK(near(relaxed.poisson_ratio_z(), 0.16));
}
