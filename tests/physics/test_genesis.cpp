// Specimens: packing, grain seeds, masks and growth, and their keeping.
#include <doctest/doctest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <numbers>
#include <set>
#include <thread>

#include "engine/texture/genesis/axes.h"
#include "engine/texture/genesis/packing.h"
#include "tests/support/granite.h"
#include "tests/support/near.h"

using namespace dem;
using namespace dem::texture;

namespace {

constexpr double pi = std::numbers::pi;
constexpr double small_diameter = 7e-3;

double distance(const Vec3& a, const Vec3& b) { return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]); }

const Packing& small_packing() {
  static const Packing packing = [] {
    RunContext context;
    return pack(dem_test::granite_packing(small_diameter), context);
  }();
  return packing;
}

bool same(const Packing& a, const Packing& b) {
  return a.position == b.position && a.radius == b.radius && a.contacts == b.contacts && a.pressure == b.pressure &&
         a.coordination == b.coordination && a.porosity == b.porosity && a.radius_scale == b.radius_scale &&
         a.floaters_removed == b.floaters_removed;
}

/// Points without contacts: growth cannot reach them, so round 0 means "inside an ellipsoid".
Packing points(std::vector<Vec3> at) {
  Packing packing;
  packing.radius.assign(at.size(), 1e-6);
  packing.position = std::move(at);
  return packing;
}

std::filesystem::path fresh_folder(const std::string& name) {
  const std::filesystem::path folder = std::filesystem::temp_directory_path() / ("dem_" + name);
  std::filesystem::remove_all(folder);
  std::filesystem::create_directories(folder);
  return folder;
}

}  // namespace

TEST_CASE("a packing is at rest at its pressure, by forces computed anew") {
  const Packing& p = small_packing();
  const PackingSettings settings = dem_test::granite_packing(small_diameter);
  const double wall = settings.vessel.diameter / 2, top = settings.vessel.height;
  std::vector<Vec3> force(p.radius.size(), Vec3{});
  std::vector<int> touches(p.radius.size(), 0);
  double contact_force = 0, wall_force = 0, deepest = 0;
  for (const auto& [i, j] : p.contacts) {
    const double d = distance(p.position[i], p.position[j]);
    const double reach = p.radius[i] + p.radius[j], r = std::min(p.radius[i], p.radius[j]);
    const double f = settings.modulus * pi * r * r / reach * (reach - d);
    CHECK(f >= 0);
    deepest = std::max(deepest, (reach - d) / reach);
    contact_force += f;
    for (int a = 0; a < 3; ++a) {
      const double n = (p.position[i][a] - p.position[j][a]) / d;
      force[i][a] += f * n;
      force[j][a] -= f * n;
    }
    ++touches[i];
    ++touches[j];
  }
  for (std::size_t i = 0; i < p.radius.size(); ++i) {
    const Vec3& x = p.position[i];
    const double r = p.radius[i], axis = std::hypot(x[0], x[1]), kn = settings.modulus * pi * r;
    const auto push = [&](double overlap, Vec3 inward) {
      if (overlap <= 0) return;
      CHECK(overlap < 0.1 * r);  // inside the vessel but for the compliance of its walls
      wall_force += kn * overlap;
      ++touches[i];
      for (int a = 0; a < 3; ++a) force[i][a] += kn * overlap * inward[a];
    };
    push(r - x[2], {0, 0, 1});
    push(x[2] + r - top, {0, 0, -1});
    push(axis + r - wall, {-x[0] / axis, -x[1] / axis, 0});
  }
  contact_force /= static_cast<double>(p.contacts.size());
  double unbalanced = 0;
  for (const Vec3& f : force) unbalanced += std::hypot(f[0], f[1], f[2]);
  CHECK(unbalanced / static_cast<double>(force.size()) <= 1.01e-4 * contact_force);
  const double area = 2 * pi * wall * wall + 2 * pi * wall * top;
  CHECK(wall_force / area == test::near(settings.pressure).epsilon(0.01));
  CHECK(p.pressure == test::near(wall_force / area).epsilon(1e-6));
  CHECK(*std::min_element(touches.begin(), touches.end()) >= 3);
  CHECK(deepest < 0.06);  // mean near 0.01 at this pressure
}

TEST_CASE("a packing says what it is") {
  const Packing& p = small_packing();
  const PackingSettings settings = dem_test::granite_packing(small_diameter);
  // Contacts: exactly the touching pairs, in order.
  std::vector<std::array<std::int32_t, 2>> pairs;
  double solid = 0;
  for (std::size_t i = 0; i < p.radius.size(); ++i) {
    solid += sphere_volume(p.radius[i]);
    for (std::size_t j = i + 1; j < p.radius.size(); ++j)
      if (distance(p.position[i], p.position[j]) <= p.radius[i] + p.radius[j])
        pairs.push_back({static_cast<std::int32_t>(i), static_cast<std::int32_t>(j)});
  }
  CHECK(pairs == p.contacts);
  const auto count = static_cast<double>(p.radius.size());
  CHECK(p.coordination == test::near(2 * static_cast<double>(pairs.size()) / count));
  CHECK(p.porosity == test::near(1 - solid / volume(settings.vessel)));
  // As many as the drawn porosity asks for: mean sphere of diameters uniform in [2 R_min, 2 ratio R_min].
  const double low = settings.radius_min, high = settings.radius_ratio * settings.radius_min;
  const double mean = sphere_volume(1) * (high + low) * (high * high + low * low) / 4;
  const double drawn = (1 - settings.porosity) * volume(settings.vessel) / mean;
  CHECK(count + p.floaters_removed == test::near(drawn).epsilon(0.05));
  const auto [least, most] = std::minmax_element(p.radius.begin(), p.radius.end());
  CHECK(*least >= low * p.radius_scale * (1 - 1e-12));
  CHECK(*most <= high * p.radius_scale * (1 + 1e-12));
}

TEST_CASE("more pressure gives a denser packing with more contacts") {
  RunContext context;
  PackingSettings loose = dem_test::granite_packing(small_diameter);
  loose.pressure = 0.005 * loose.modulus;
  PackingSettings tight = loose;
  tight.pressure = 0.02 * tight.modulus;
  const Packing a = pack(loose, context), b = pack(tight, context);
  CHECK(a.coordination < small_packing().coordination);
  CHECK(small_packing().coordination < b.coordination);
  CHECK(a.porosity > b.porosity);
}

TEST_CASE("the same bits for one and two threads") {
  // So many that two threads are used; lengths in mean radii, the first steps of the cloud.
  std::vector<Sphere> cloud;
  for (std::uint32_t i = 0; i < 20'000; ++i) {
    const double r = 0.75 + 0.5 * (i % 100) / 100.0;
    const Vec3 at = random_place({40, 100}, r, 3, Purpose::test_data, i);
    cloud.push_back({at[0], at[1], at[2], r});
  }
  Pile one(40, 100, cloud, 1e-4, 1), two(40, 100, cloud, 1e-4, 2);
  const auto ignore = [](const PileState&) {};
  CHECK_FALSE(one.relax(0, 0.4, 60, ignore));
  CHECK_FALSE(two.relax(0, 0.4, 60, ignore));
  const auto equal = [](const Sphere& s, const Sphere& t) {
    return s.x == t.x && s.y == t.y && s.z == t.z && s.r == t.r;
  };
  const auto& a = one.spheres();
  const auto& b = two.spheres();
  CHECK(std::equal(a.begin(), a.end(), b.begin(), b.end(), equal));
  CHECK_FALSE(std::equal(a.begin(), a.end(), cloud.begin(), cloud.end(), equal));
  CHECK(one.state().wall_pressure == two.state().wall_pressure);
  CHECK(one.unbalance() == two.unbalance());
}

TEST_CASE("the seed decides, and it alone") {
  RunContext context, other;
  other.threads = 2;
  const Packing first = pack(dem_test::granite_packing(5e-3, 1), context);
  CHECK(same(first, pack(dem_test::granite_packing(5e-3, 1), other)));
  CHECK_FALSE(same(first, pack(dem_test::granite_packing(5e-3, 2), context)));
}

TEST_CASE("a packing that is asked to stop stops") {
  RunContext context;
  context.stopped = [] { return true; };
  CHECK_THROWS_AS(pack(dem_test::granite_packing(small_diameter), context), Interrupted);
}

TEST_CASE("grain seeds keep the shares and the ranges of their minerals") {
  RunContext context;
  const auto minerals = dem_test::granite_minerals();
  const Cylinder vessel{12.5e-3, 25e-3};
  for (const double scale : {1.0, 0.675}) {
    CAPTURE(scale);
    const GrainSeeds seeds = seed_grains(vessel, minerals, scale, 1, context);
    std::vector<double> filled(minerals.size(), 0);
    for (std::size_t g = 0; g < seeds.radius.size(); ++g) {
      const MineralGrains& m = minerals[seeds.mineral[g]];
      filled[seeds.mineral[g]] += sphere_volume(seeds.radius[g]);
      const double d = 2 * seeds.radius[g];
      // Scaled to meet volume and pressure: with 25 to 60 grains a mineral by less than 2 %.
      CHECK(d > 0.98 * scale * m.diameter_min);
      CHECK(d < 1.02 * scale * m.diameter_max);
      const Vec3& x = seeds.position[g];
      CHECK(std::hypot(x[0], x[1]) + seeds.radius[g] < vessel.diameter / 2 * 1.01);
      CHECK(x[2] - seeds.radius[g] > -0.01 * vessel.height);
      CHECK(x[2] + seeds.radius[g] < 1.01 * vessel.height);
      for (std::size_t h = 0; h < g; ++h) {
        const double reach = seeds.radius[g] + seeds.radius[h];
        CHECK(distance(x, seeds.position[h]) > 0.96 * reach);
      }
    }
    const double total = filled[0] + filled[1] + filled[2] + filled[3];
    for (std::size_t m = 0; m < minerals.size(); ++m)
      CHECK(filled[m] / total == test::near(minerals[m].share).epsilon(1e-6));
    CHECK(total / volume(vessel) > 0.5);
  }
}

TEST_CASE("grain seeds of a mineral are spread over the whole specimen") {
  RunContext context;
  const Cylinder vessel{12.5e-3, 25e-3};
  const GrainSeeds seeds = seed_grains(vessel, dem_test::granite_minerals(), 0.5, 2, context);
  std::map<std::int32_t, std::pair<double, int>> height;
  for (std::size_t g = 0; g < seeds.radius.size(); ++g) {
    height[seeds.mineral[g]].first += seeds.position[g][2];
    ++height[seeds.mineral[g]].second;
  }
  for (const auto& [mineral, sum] : height) {
    CAPTURE(mineral);
    // Mean of n uniform heights: standard error H / sqrt(12 n); four of them.
    const double n = sum.second;
    CHECK(std::abs(sum.first / n - vessel.height / 2) < 4 * vessel.height / std::sqrt(12 * n));
  }
}

TEST_CASE("an ellipsoid holds the points inside it, whatever its dip") {
  const double R = 2e-3;
  GrainSeeds seeds{{{1e-3, -2e-3, 3e-3}}, {R}, {0}};
  for (const double ar : {1.0, 2.0, 3.0})
    for (const double dip : {0.0, 0.5, pi / 2})
      for (const double direction : {0.0, 1.1, 2.5}) {
        CAPTURE(ar);
        CAPTURE(dip);
        CAPTURE(direction);
        const double a = std::pow(ar, 2.0 / 3.0) * R, b = std::pow(ar, -1.0 / 3.0) * R;
        const double cd = std::cos(dip), sd = std::sin(dip), cz = std::cos(direction), sz = std::sin(direction);
        const std::array<Vec3, 3> axes{Vec3{cd * cz, cd * sz, sd}, Vec3{-sz, cz, 0}, Vec3{-sd * cz, -sd * sz, cd}};
        const std::array<double, 3> half{a, b, b};
        std::vector<Vec3> at;
        for (int k = 0; k < 3; ++k)
          for (const double factor : {0.999, 1.001, -0.999, -1.001}) {
            Vec3 x = seeds.position[0];
            for (int c = 0; c < 3; ++c) x[c] += factor * half[k] * axes[k][c];
            at.push_back(x);
          }
        const GrainMap map = grow_grains(points(at), seeds, {ar, dip, direction});
        for (std::size_t n = 0; n < at.size(); ++n) CHECK((map.growth_round[n] == 0) == (n % 2 == 0));
      }
}

TEST_CASE("an ellipsoid has the volume of its sphere") {
  const double R = 1e-3, h = 0.06e-3;
  const GrainSeeds seeds{{{0.011e-3, 0.007e-3, 0.003e-3}}, {R}, {0}};
  std::vector<Vec3> at;
  for (double x = -2.2e-3; x < 2.2e-3; x += h)
    for (double y = -2.2e-3; y < 2.2e-3; y += h)
      for (double z = -2.2e-3; z < 2.2e-3; z += h) at.push_back({x, y, z});
  for (const double ar : {1.0, 2.0, 3.0}) {
    const GrainMap map = grow_grains(points(at), seeds, {ar, 0.6, 0.3});
    const auto inside = std::count(map.growth_round.begin(), map.growth_round.end(), 0);
    CHECK(static_cast<double>(inside) * h * h * h == test::near(4.0 / 3.0 * pi * R * R * R).epsilon(0.005));
  }
}

TEST_CASE("overlapping claims go to the nearest ellipsoid, equal ones to the lower grain") {
  const GrainSeeds seeds{{{0, 0, 0}, {3e-3, 0, 0}}, {2e-3, 2e-3}, {0, 1}};
  const GrainMap map = grow_grains(points({{1.4e-3, 0, 0}, {1.6e-3, 0, 0}, {1.5e-3, 0, 0}}), seeds, {});
  CHECK(map.grain == std::vector<std::int32_t>{0, 1, 0});
  CHECK(map.mineral == std::vector<std::int32_t>{0, 1, 0});
}

TEST_CASE("growth along a row of particles, and past a gap") {
  // Seeds hold particles 0 and 6 of seven in a row; particle 7 touches nobody and lies nearer to grain 0.
  Packing packing = points({});
  for (int i = 0; i < 7; ++i) {
    packing.position.push_back({i * 1e-3, 0, 0});
    packing.radius.push_back(0.5e-3);
    if (i > 0) packing.contacts.push_back({i - 1, i});
  }
  packing.position.push_back({-3e-3, 0, 0});
  packing.radius.push_back(0.5e-3);
  const GrainSeeds seeds{{{0, 0, 0}, {6e-3, 0, 0}}, {0.4e-3, 0.4e-3}, {3, 1}};
  const GrainMap map = grow_grains(packing, seeds, {});
  CHECK(map.growth_round == std::vector<std::int32_t>{0, 1, 2, 3, 2, 1, 0, 4});
  CHECK(map.grain[2] == 0);
  CHECK(map.grain[4] == 1);
  CHECK(map.grain[7] == 0);
  CHECK(map.mineral[7] == 3);
}

TEST_CASE("a particle between grains follows the rule of growth") {
  // Particle 0 in the middle: two shallow contacts with grain 1, one deep contact with grain 0.
  Packing packing = points({{0, 0, 0}, {0.9e-3, 0, 0}, {-0.99e-3, 0, 0}, {0, 0.99e-3, 0}});
  packing.radius.assign(4, 0.5e-3);
  packing.contacts = {{0, 1}, {0, 2}, {0, 3}};
  const GrainSeeds seeds{{{0.9e-3, 0, 0}, {-0.5e-3, 0.5e-3, 0}}, {0.2e-3, 0.705e-3}, {0, 0}};
  CHECK(grow_grains(packing, seeds, {}).grain == std::vector<std::int32_t>{1, 0, 1, 1});
  CHECK(grow_grains(packing, seeds, {}, GrowthRule::deepest_contact).grain == std::vector<std::int32_t>{0, 0, 1, 1});
}

TEST_CASE("the shape of grown grains is that of their second moments") {
  // Two ellipsoids of 3 : 1 : 1 along (1, 1, 0), filled with a grid of small spheres.
  Packing packing;
  GrainMap map;
  const double step = 0.05, across = 1, longest = 3, half = std::sqrt(0.5);
  for (const double shift : {0.0, 10.0}) {
    for (double x = -longest; x <= longest; x += step) {
      for (double y = -longest; y <= longest; y += step) {
        for (double z = -across; z <= across; z += step) {
          const double along = half * (x + y), beside = half * (x - y);
          if (std::pow(along / longest, 2) + (beside * beside + z * z) / (across * across) > 1) continue;
          packing.position.push_back({x + shift, y, z});
          packing.radius.push_back(step / 2);
          map.grain.push_back(shift > 0 ? 1 : 0);
        }
      }
    }
  }
  packing.position.push_back({0, 0, 20});  // a grain of one particle has that particle's shape
  packing.radius.push_back(0.7);
  map.grain.push_back(2);
  const std::vector<OwnAxes> own = own_axes(packing, map, 4);
  for (const std::size_t g : {0, 1}) {
    CHECK(own[g].semi_long == doctest::Approx(longest).epsilon(0.01));
    CHECK(own[g].semi_middle == doctest::Approx(across).epsilon(0.01));
    CHECK(own[g].semi_short == doctest::Approx(across).epsilon(0.01));
    CHECK(std::abs(own[g].axis[0] * half + own[g].axis[1] * half) == doctest::Approx(1).epsilon(1e-4));
  }
  CHECK(own[2].semi_long == doctest::Approx(0.7));
  CHECK(own[2].semi_short == doctest::Approx(0.7));
  CHECK(own[3].semi_long == 0);
  packing.position.pop_back();
  packing.radius.pop_back();
  map.grain.pop_back();
  CHECK(realised_aspect_ratio(packing, map, 2, {half, half, 0}) == doctest::Approx(3).epsilon(0.01));
  CHECK(realised_aspect_ratio(packing, map, 2, {half, -half, 0}) < 1);
}

TEST_CASE("every particle has a grain: by mask when an ellipsoid holds it, else by contact") {
  RunContext context;
  const Packing& p = small_packing();
  const GrainSeeds seeds =
      seed_grains(dem_test::granite_packing(small_diameter).vessel, dem_test::granite_minerals(), 0.5, 1, context);
  std::vector<std::vector<std::int32_t>> touching(p.radius.size());
  for (const auto& [i, j] : p.contacts) {
    touching[i].push_back(j);
    touching[j].push_back(i);
  }
  for (const double ar : {1.0, 2.0, 3.0}) {
    CAPTURE(ar);
    const GrainMap map = grow_grains(p, seeds, {ar, 0, 0});
    for (std::size_t i = 0; i < p.radius.size(); ++i) {
      REQUIRE(map.grain[i] >= 0);
      CHECK(map.mineral[i] == seeds.mineral[map.grain[i]]);
      if (map.growth_round[i] == 0) continue;
      const bool grown = std::any_of(touching[i].begin(), touching[i].end(), [&](std::int32_t j) {
        return map.grain[j] == map.grain[i] && map.growth_round[j] < map.growth_round[i];
      });
      CHECK(grown);
    }
    if (ar == 1.0) {
      for (std::size_t i = 0; i < p.radius.size(); ++i) {
        const double d = distance(p.position[i], seeds.position[map.grain[i]]);
        CHECK((map.growth_round[i] > 0) == (d > seeds.radius[map.grain[i]]));
      }
    }
  }
}

TEST_CASE("elongated grains have more inter-grain contacts, by no more than their surface grows") {
  // Particles on a face-centred lattice, twelve contacts each: many, without a packing to wait for.
  const double edge = 0.7e-3;
  const Cylinder vessel{12.5e-3, 25e-3};
  std::map<std::array<int, 3>, std::int32_t> at;
  Packing packing;
  for (int k = 0; k < 72; ++k)
    for (int j = -18; j <= 18; ++j)
      for (int i = -18; i <= 18; ++i) {
        const double x = i * edge / 2, y = j * edge / 2, z = k * edge / 2;
        if ((i + j + k) % 2 != 0 || std::hypot(x, y) > vessel.diameter / 2 || z > vessel.height) continue;
        at[{i, j, k}] = static_cast<std::int32_t>(packing.radius.size());
        packing.position.push_back({x, y, z});
        packing.radius.push_back(edge / std::sqrt(8.0));
      }
  for (const auto& [cell, n] : at)
    for (const auto& [di, dj, dk] : {std::array{1, 1, 0}, {1, -1, 0}, {1, 0, 1}, {1, 0, -1}, {0, 1, 1}, {0, 1, -1}})
      if (const auto other = at.find({cell[0] + di, cell[1] + dj, cell[2] + dk}); other != at.end())
        packing.contacts.push_back({std::min(n, other->second), std::max(n, other->second)});
  std::sort(packing.contacts.begin(), packing.contacts.end());
  RunContext context;
  const GrainSeeds seeds = seed_grains(vessel, dem_test::granite_minerals(), 0.675, 1, context);
  const auto inter_share = [&](double ar) {
    const GrainMap map = grow_grains(packing, seeds, {ar, 0.5, 0.4});
    const auto inter = std::count_if(packing.contacts.begin(), packing.contacts.end(),
                                     [&](const auto& pair) { return map.grain[pair[0]] != map.grain[pair[1]]; });
    return static_cast<double>(inter) / static_cast<double>(packing.contacts.size());
  };
  // Surface of a prolate ellipsoid over that of its sphere. Eq. 14 puts 1.050 and 1.122 in the place of 1.077
  // and 1.182.
  const auto area = [](double ar) {
    const double a = std::pow(ar, 2.0 / 3.0), b = std::pow(ar, -1.0 / 3.0);
    const double e = std::sqrt(1 - 1 / (ar * ar));
    return ar > 1 ? b * b / 2 * (1 + a / b * std::asin(e) / e) : 1.0;
  };
  double before = inter_share(1);
  double ar_before = 1;
  for (const double ar : {2.0, 3.0}) {
    const double share = inter_share(ar);
    CHECK(share > before);
    CHECK(share / before < area(ar) / area(ar_before));
    before = share;
    ar_before = ar;
  }
}

TEST_CASE("a specimen is kept by its content, and made again when its file is damaged") {
  const std::filesystem::path folder = fresh_folder("genesis_kept");
  RunContext context;
  context.specimens = folder;
  int packed = 0;
  context.report = [&](const Progress&) { ++packed; };
  const PackingSettings settings = dem_test::granite_packing(5e-3);
  const std::vector<MineralGrains> minerals{{1, 1e-3, 2e-3}};
  const Genesis made = genesis(settings, minerals, 1, context);
  CHECK(packed > 0);
  const auto files = [&] {
    std::set<std::filesystem::path> found;
    for (const auto& entry : std::filesystem::directory_iterator(folder)) found.insert(entry.path());
    return found;
  };
  REQUIRE(files().size() == 2);  // the packing and the seeds

  packed = 0;
  const Genesis loaded = genesis(settings, minerals, 1, context);
  CHECK(packed == 0);
  CHECK(same(made.packing, loaded.packing));
  CHECK(made.seeds.position == loaded.seeds.position);
  CHECK(made.seeds.radius == loaded.seeds.radius);
  CHECK(made.seeds.mineral == loaded.seeds.mineral);

  for (const auto& file : files()) std::filesystem::resize_file(file, std::filesystem::file_size(file) / 2);
  const Genesis again = genesis(settings, minerals, 1, context);
  CHECK(packed > 0);
  CHECK(same(made.packing, again.packing));
  packed = 0;
  genesis(settings, minerals, 1, context);
  CHECK(packed == 0);

  genesis(settings, minerals, 0.9, context);  // other seeds, the same packing
  CHECK(files().size() == 3);
  std::filesystem::remove_all(folder);
}

TEST_CASE("two cases that run side by side and need the same specimen make it once") {
  const std::filesystem::path folder = fresh_folder("genesis_shared");
  const PackingSettings settings = dem_test::granite_packing(5e-3);
  const std::vector<MineralGrains> minerals{{1, 1e-3, 2e-3}};
  std::atomic<int> steps = 0;
  const auto make = [&](Turns& turns) {
    RunContext context;
    context.specimens = folder;
    context.turns = &turns;
    context.report = [&](const Progress&) { ++steps; };
    return genesis(settings, minerals, 1, context);
  };
  Turns turns;
  const Genesis alone = make(turns);
  const int once = steps;
  std::filesystem::remove_all(folder);

  steps = 0;
  std::vector<Genesis> made(3);
  {
    std::vector<std::jthread> cases;
    for (Genesis& one : made) cases.emplace_back([&] { one = make(turns); });
  }
  CHECK(steps == once);
  for (const Genesis& one : made) {
    CHECK(same(one.packing, alone.packing));
    CHECK(one.seeds.position == alone.seeds.position);
  }
  std::filesystem::remove_all(folder);
}

TEST_CASE("grains that do not fit are refused in plain words") {
  RunContext context;
  CHECK_THROWS_AS(seed_grains({3e-3, 6e-3}, dem_test::granite_minerals(), 1, 1, context), CaseError);
}
