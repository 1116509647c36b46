// Confining pressure: the walls carry it, the account closes, a cut test goes on to the same bits; broken joints in vector
// code against the scalar law.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

#include "engine/core/archive.h"
#include "engine/core/random.h"
#include "engine/texture/keys.h"
#include "engine/texture/loading/compression.h"
#include "engine/texture/loading/loading.h"
#include "engine/texture/model.h"
#include "engine/texture/solver/packs.h"
#include "tests/support/granite.h"
#include "tests/support/near.h"

using namespace dem::texture;
using T = Triple<double>;

namespace {

Settings confined(double pressure, bool membrane = false) {
  Settings s = dem_test::granite(6.25, 12.5);
  s.test = compression(pressure);
  s.test.rate = 2e-7;
  s.test.confining_step = 2e4;
  s.test.membrane = membrane;
  return s;
}

const Specimen& specimen() {
  static const Specimen one = [] {
    dem::RunContext context;
    return make_specimen(confined(0), context);
  }();
  return one;
}

Loading loaded(double pressure, double strain, bool membrane = false) {
  Loading test(specimen(), confined(pressure, membrane), 1);
  while (test.history().empty() || test.history().back().platen_strain < strain) test.advance();
  return test;
}

}  // namespace

TEST_CASE("a specimen starts from the isotropic pressure and keeps it on its sides") {
  const double pressure = 20e6;
  const Loading test = loaded(pressure, 1.5e-3), flexible = loaded(pressure, 1.5e-3, true);
  for (const Loading* one : {&test, &flexible}) {
    const HistoryRow &first = one->history().front(), &last = one->history().back();
    CHECK(first.axial_stress == test::near(pressure).epsilon(0.01));
    CHECK(first.axial_strain == doctest::Approx(0).epsilon(1e-5));
    const double wrong =
        one == &test ? 0.01 : 1e-9;  // a membrane has no stiffness that its pressure has to be found by
    for (const HistoryRow& row : one->history()) CHECK(std::abs(row.confining_pressure / pressure - 1) < wrong);
    CHECK(std::abs(last.ledger.residual()) < 1e-3 * last.ledger.work);
  }
  // The pressure on the sides hardly changes the slope of stress over strain while nothing has broken: it closes the linear
  // parts of some grain boundaries, 3 % here.
  const Loading free = loaded(0, 1.5e-3);
  const auto slope = [](const std::vector<HistoryRow>& h) {
    return (h[60].axial_stress - h[20].axial_stress) / (h[60].axial_strain - h[20].axial_strain);
  };
  CHECK(slope(test.history()) == test::near(slope(free.history())).epsilon(0.05));
  CHECK(slope(flexible.history()) == test::near(slope(test.history())).epsilon(0.03));
}

TEST_CASE("an isotropic pressure strains a specimen alike in all directions") {
  // From the walls' way inwards: radius and height shrink by the same share, within the scatter of 550 particles.
  for (const bool membrane : {false, true}) {
    CAPTURE(membrane);
    AssemblyInput input = assembly_input(specimen(), confined(1e6, membrane));
    Assembly assembly(input, 1);
    assembly.confine(30e6, 1000);
    const Sample sample = assembly.advance(3000);
    const double radial = 1 - sample.jacket_radius / input.jacket_radius;
    const double axial = 1 - (sample.place[1] - sample.place[0]) / (input.z_high - input.z_low);
    CHECK(sample.confining_pressure == test::near(30e6).epsilon(1e-3));
    CHECK(axial > 1e-4);
    CHECK(radial == test::near(axial).epsilon(0.25));
    CHECK(std::abs(sample.ledger.residual()) < 1e-3 * sample.ledger.work);
  }
}

TEST_CASE("a confined test that is cut goes on to the same bits") {
  for (const auto& [while_confining, membrane] :
       {std::pair{true, false}, {false, false}, {true, true}, {false, true}}) {
    CAPTURE(while_confining);
    CAPTURE(membrane);
    const Settings settings = confined(10e6, membrane);
    Loading whole(specimen(), settings, 1), cut(specimen(), settings, 1);
    const int chunks = while_confining ? 4 : 40;
    for (int k = 0; k < chunks; ++k) {
      whole.advance();
      cut.advance();
    }
    dem::ArchiveWriter writer;
    writer(cut);
    Loading resumed(specimen(), settings, 1);
    dem::ArchiveReader reader(writer.bytes());
    reader(resumed);
    for (int k = 0; k < 20; ++k) {
      whole.advance();
      resumed.advance();
    }
    REQUIRE(whole.history().size() == resumed.history().size());
    for (std::size_t i = 0; i < whole.history().size(); ++i) {
      CHECK(whole.history()[i].axial_stress == resumed.history()[i].axial_stress);
      CHECK(whole.history()[i].ledger.work == resumed.history()[i].ledger.work);
    }
  }
}

TEST_CASE("the vector code of broken joints does what the scalar law does") {
  dem::RandomStream random(5, dem::Purpose::test_data);
  const auto vector = [&](double size) {
    return T{random.uniform(-size, size), random.uniform(-size, size), random.uniform(-size, size)};
  };
  const ContactGroup group = inside(dem_test::granite(10, 20).minerals[1], JointModulus::sum);
  constexpr int count = 203;  // no multiple of any width
  std::vector<PartlyBrokenJoint> joints;
  std::vector<Row8> pose(2 * count), force(2 * count);
  std::vector<std::int32_t> list;
  for (int k = 0; k < count; ++k) {
    PartlyBrokenJoint j;
    j.first = 2 * k;
    j.second = 2 * k + 1;
    j.reference = T{0.3e-3, 0.2e-3, 0.7e-3};
    j.reference_length = std::sqrt(dot(j.reference, j.reference));
    const double r = 0.4e-3, kn = group.bond_modulus / (2 * r), area = std::numbers::pi * r * r;
    j.law = {kn * area,           1 / group.bond_stiffness_ratio, flat_joint_arm * r, group.tensile_strength / kn,
             group.cohesion / kn, std::tan(group.friction_angle)};
    j.friction = 0.6;
    j.zero_angle = any_perpendicular(j.reference);
    for (JointElement& e : j.element) {
      e.bonded = random.uniform(0, 1) < 0.4;
      if (!e.bonded) {
        e.slip = vector(2e-7);
        e.shear = vector(1e-7);
      }
    }
    j.open = j.broken() && random.uniform(0, 1) < 0.3;
    for (JointElement& e : j.element) {
      if (j.open) e.shear = {0, 0, 0};
    }
    const T d = j.reference + vector(6e-7), a = vector(3e-4), b = vector(3e-4);
    pose[static_cast<std::size_t>(j.first)] = {{0, 0, 0, r, std::sqrt(1 - dot(a, a)), a.x, a.y, a.z}};
    pose[static_cast<std::size_t>(j.second)] = {{d.x, d.y, d.z, r, std::sqrt(1 - dot(b, b)), b.x, b.y, b.z}};
    joints.push_back(j);
    list.push_back(k);
  }
  const auto at = [&](std::int32_t p) {
    const double* v = pose[static_cast<std::size_t>(p)].v;
    return Pose<double>{{v[0], v[1], v[2]}, {v[4], v[5], v[6], v[7]}};
  };
  int compared = 0;
  for (const char* name : {"sse2", "wide", "avx2", "avx512"}) {
    const Kernels* set = kernels(name);
    if (!set) continue;
    CAPTURE(name);
    std::vector<PartlyBrokenJoint> moved = joints;
    std::fill(force.begin(), force.end(), Row8{});
    std::vector<std::int32_t> flagged(count);
    BondLoop loop{pose.front().v, force.front().v, flagged.data(), 0, 0};
    set->broken_joints(moved.data(), list.data(), count, loop);
    double heat = 0;
    for (int k = 0; k < count; ++k) {
      CAPTURE(k);
      PartlyBrokenJoint one = joints[static_cast<std::size_t>(k)];
      const JointResult expected = advance(one, at(one.first), at(one.second));
      const bool is_flagged =
          std::find(flagged.begin(), flagged.begin() + loop.flagged_count, k) != flagged.begin() + loop.flagged_count;
      CHECK(is_flagged == (expected.breaks > 0));
      if (is_flagged) continue;
      ++compared;
      heat += expected.friction_heat;
      const double* f = force[static_cast<std::size_t>(one.second)].v;
      const double scale = 1e-12 * one.law.normal * 1e-6;
      CHECK(std::abs(f[0] - expected.action.force.x) < scale);
      CHECK(std::abs(f[1] - expected.action.force.y) < scale);
      CHECK(std::abs(f[2] - expected.action.force.z) < scale);
      CHECK(std::abs(f[4] - expected.action.moment_2.x) < scale * 1e-3);
      CHECK(moved[static_cast<std::size_t>(k)].open == one.open);
      for (int e = 0; e < 3; ++e) {
        const JointElement &got = moved[static_cast<std::size_t>(k)].element[e], &want = one.element[e];
        CHECK(std::abs(got.slip.x - want.slip.x) < 1e-18);
        CHECK(std::abs(got.shear.z - want.shear.z) < 1e-18);
      }
    }
    CHECK(loop.heat == test::near(heat).epsilon(1e-10));
  }
  CHECK(compared > 50);
}

TEST_CASE("the vector code flags the intact joints that the scalar law breaks, and finds the broken ones that close") {
  dem::RandomStream random(6, dem::Purpose::test_data);
  const auto vector = [&](double size) {
    return T{random.uniform(-size, size), random.uniform(-size, size), random.uniform(-size, size)};
  };
  const ContactGroup group = inside(dem_test::granite(10, 20).minerals[1], JointModulus::sum);
  constexpr std::size_t packs = 40, count = packs * pack_width;
  const double r = 0.4e-3, kn = group.bond_modulus / (2 * r), area = std::numbers::pi * r * r;
  std::vector<FlatJointPack> intact(packs);
  std::vector<OpenJointPack> watched(packs);
  std::vector<PartlyBrokenJoint> joints;
  std::vector<Row8> pose(2 * count), force(2 * count);
  for (std::size_t k = 0; k < count; ++k) {
    PartlyBrokenJoint j;
    j.first = static_cast<int>(2 * k);
    j.second = j.first + 1;
    j.reference = vector(0.6e-3);
    j.reference_length = std::sqrt(dot(j.reference, j.reference));
    j.law = {kn * area,           1 / group.bond_stiffness_ratio, flat_joint_arm * r, group.tensile_strength / kn,
             group.cohesion / kn, std::tan(group.friction_angle)};
    j.zero_angle = any_perpendicular(j.reference);
    const T d = j.reference + vector(5e-7), a = vector(4e-4), b = vector(4e-4);
    pose[2 * k] = {{0, 0, 0, r, std::sqrt(1 - dot(a, a)), a.x, a.y, a.z}};
    pose[2 * k + 1] = {{d.x, d.y, d.z, r, std::sqrt(1 - dot(b, b)), b.x, b.y, b.z}};
    FlatJointPack& pack = intact[k / pack_width];
    const std::size_t lane = k % pack_width;
    const double values[] = {j.reference.x,      j.reference.y,  j.reference.z,       j.share_one,
                             j.reference_length, j.law.normal,   j.law.inverse_ratio, j.law.rho,
                             j.law.opening,      j.law.cohesion, j.law.tan_phi};
    static_assert(std::size(values) == FlatJointPack::fields);
    for (std::size_t f = 0; f < std::size(values); ++f) pack.field[f][lane] = values[f];
    OpenJointPack& watch = watched[k / pack_width];
    j.open = random.uniform(0, 1) < 0.7 ? 1 : 0;
    watch.length[lane] = j.reference_length;
    watch.reach[lane] = j.open != 0 ? 4 * j.law.rho * j.law.rho : std::numeric_limits<double>::infinity();
    pack.first[lane] = watch.first[lane] = j.first;
    pack.second[lane] = watch.second[lane] = j.second;
    joints.push_back(j);
  }
  const auto at = [&](int p) {
    const double* v = pose[static_cast<std::size_t>(p)].v;
    return Pose<double>{{v[0], v[1], v[2]}, {v[4], v[5], v[6], v[7]}};
  };
  std::vector<std::int32_t> breaking, closed;
  for (std::size_t k = 0; k < count; ++k) {
    PartlyBrokenJoint probe = joints[k];
    if (!stays_open(probe, at(probe.first), at(probe.second))) closed.push_back(static_cast<std::int32_t>(k));
    probe.open = 0;
    if (advance(probe, at(probe.first), at(probe.second)).breaks > 0) breaking.push_back(static_cast<std::int32_t>(k));
  }
  CHECK(breaking.size() > count / 10);
  CHECK(breaking.size() < count * 9 / 10);
  CHECK(closed.size() > count / 3);
  CHECK(closed.size() < count * 9 / 10);
  for (const char* name : {"sse2", "wide", "avx2", "avx512"}) {
    const Kernels* set = kernels(name);
    if (!set) continue;
    CAPTURE(name);
    std::vector<std::int32_t> found(count);
    BondLoop loop{pose.front().v, force.front().v, found.data(), 0, 0};
    set->flat_joints(intact.data(), static_cast<std::int32_t>(packs), loop);
    found.resize(static_cast<std::size_t>(loop.flagged_count));
    CHECK(found == breaking);
    found.resize(count);
    found.resize(static_cast<std::size_t>(
        set->closed_joints(watched.data(), static_cast<std::int32_t>(count), pose.front().v, found.data())));
    CHECK(found == closed);
  }
}

TEST_CASE("lanes that are out of use leave the packs, the others keep their order") {
  std::vector<FlatJointPack> packs(4);
  std::vector<std::int32_t> contact;
  for (std::size_t slot = 0; slot < 29; ++slot) {
    FlatJointPack& pack = packs[slot / pack_width];
    for (auto& field : pack.field) field[slot % pack_width] = static_cast<double>(slot + 1);
    pack.first[slot % pack_width] = static_cast<std::int32_t>(slot);
    contact.push_back(static_cast<std::int32_t>(100 + slot));
  }
  pad(packs, contact);
  CHECK(contact.size() == 32);
  CHECK(contact[29] == -1);
  retire(packs[0], 3);
  close_ranks(packs, contact);
  CHECK(packs.size() == 4);  // 28 of 32 lanes live: nothing to gain
  for (std::size_t slot = 8; slot < 24; ++slot) retire(packs[slot / pack_width], slot % pack_width);
  close_ranks(packs, contact);
  REQUIRE(packs.size() == 2);
  const std::vector<std::int32_t> left{100, 101, 102, 104, 105, 106, 107, 124, 125, 126, 127, 128, -1, -1, -1, -1};
  CHECK(contact == left);
  for (std::size_t slot = 0; slot < 16; ++slot) {
    const FlatJointPack& pack = packs[slot / pack_width];
    CHECK(lives(pack, slot % pack_width) == (slot < 12));
    CHECK(pack.first[slot % pack_width] == std::max(contact[slot], 0) % 100 + (slot < 12 ? 0 : 28));
  }
  for (std::size_t slot = 0; slot < 12; ++slot) retire(packs[slot / pack_width], slot % pack_width);
  close_ranks(packs, contact);
  CHECK(packs.empty());
  CHECK(contact.empty());
}

TEST_CASE("tests under confining pressure have a rate of their own") {
  const auto cases = [](const std::vector<std::string>& set) {
    return model().cases(dem::Scenario::read(DEM_SOURCE_DIR "/scenarios/my_rock.toml", "draft", set,
                                             [](std::string_view) { return keys(); }));
  };
  const std::string both = R"(sweep.confining_pressure=["0 MPa", "10 MPa"])";
  const auto rate = [](const dem::CaseSpec& spec) { return read_settings(spec.scenario, "compression").test.rate; };
  const auto own = cases({both, "compression.rate=5e-8", "compression.confined_rate=1e-7"});
  CHECK(rate(own[0]) == 5e-8);
  CHECK(rate(own[1]) == 1e-7);
  const auto same = cases({both, "compression.rate=1e-7"});
  CHECK(rate(same[1]) == 1e-7);
  // What a case depends on is the rate that it runs at: records are kept however that was written.
  CHECK(own[1].content == same[1].content);
  CHECK(own[0].content != same[0].content);
}
