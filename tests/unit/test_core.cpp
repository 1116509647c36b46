// Random streams, content hashes and base64 against published values; cells and orders of
// points; instruction sets.
#include <doctest/doctest.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <string>
#include <vector>

#include "engine/core/base64.h"
#include "engine/core/cell_grid.h"
#include "engine/core/errors.h"
#include "engine/core/files.h"
#include "engine/core/hash.h"
#include "engine/core/instruction_set.h"
#include "engine/core/random.h"
#include "engine/core/space_filling.h"
#include "engine/core/text.h"
#include "tests/support/scratch.h"

TEST_CASE("Philox 4x32-10 gives the known answers of Random123") {
  CHECK(dem::philox({0, 0, 0, 0}, {0, 0}) ==
        std::array<std::uint32_t, 4>{0x6627e8d5, 0xe169c58d, 0xbc57ac4c, 0x9b00dbd8});
  CHECK(dem::philox({0xffffffff, 0xffffffff, 0xffffffff, 0xffffffff}, {0xffffffff, 0xffffffff}) ==
        std::array<std::uint32_t, 4>{0x408f276d, 0x41c83b0e, 0xa20bc7c6, 0x6d5451fd});
  CHECK(dem::philox({0x243f6a88, 0x85a308d3, 0x13198a2e, 0x03707344}, {0xa4093822, 0x299f31d0}) ==
        std::array<std::uint32_t, 4>{0xd16cfe09, 0x94fdcceb, 0x5001e420, 0x24126ea1});
}

TEST_CASE("the numbers of a stream are part of the results: they stay what they are") {
  dem::RandomStream a(0x123456789abcdef, dem::Purpose::test_data), b(0x123456789abcdef, dem::Purpose::test_data, 7);
  for (const std::uint64_t bits : {0xb43edf95182300daULL, 0xb16f6f11af2e2c15ULL, 0x336922d34dbe20b9ULL})
    CHECK(a.bits() == bits);
  for (const std::uint64_t bits : {0x39d12d3668fe7f9cULL, 0x06f705ffa9c26199ULL, 0x726d9381d897ff48ULL})
    CHECK(b.bits() == bits);
}

TEST_CASE("SHA-256 gives the answers of FIPS 180-4") {
  CHECK(dem::sha256("abc") == "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  CHECK(dem::sha256("") == "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
  CHECK(dem::sha256("abcdbcdecdefdefgefghfghighijhijkijkljklmklmnlmnomnopnopq") ==
        "248d6a61d20638b8e5c026930c3e6039a33ce45964ff2167f6ecedd419db06c1");
  CHECK(dem::sha256(std::string(1'000'000, 'a')) == "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0");
}

TEST_CASE("base64 gives the answers of RFC 4648") {
  CHECK(dem::base64("") == "");
  CHECK(dem::base64("f") == "Zg==");
  CHECK(dem::base64("fo") == "Zm8=");
  CHECK(dem::base64("foo") == "Zm9v");
  CHECK(dem::base64("foob") == "Zm9vYg==");
  CHECK(dem::base64("fooba") == "Zm9vYmE=");
  CHECK(dem::base64("foobar") == "Zm9vYmFy");
  CHECK(dem::base64(std::string_view("\0\xfb\xff", 3)) == "APv/");
  CHECK(dem::base64(std::string(300, '\0')) == std::string(400, 'A'));  // no line breaks
}

TEST_CASE("streams of different purpose or seed do not meet, the same stream repeats") {
  dem::RandomStream a(1, dem::Purpose::test_data), b(1, dem::Purpose::test_data), c(2, dem::Purpose::test_data);
  double mean = 0;
  bool differs = false;
  for (int i = 0; i < 10000; ++i) {
    const double x = a.uniform();
    CHECK(x == b.uniform());
    differs = differs || x != c.uniform();
    mean += x / 10000;
  }
  CHECK(differs);
  CHECK(mean == doctest::Approx(0.5).epsilon(0.02));
}

TEST_CASE("a cell grid finds every near pair, in one order") {
  using Vec3 = std::array<double, 3>;
  dem::RandomStream random(1, dem::Purpose::test_data);
  std::vector<Vec3> points;
  for (int i = 0; i < 400; ++i) points.push_back({random.uniform(-3, 2), random.uniform(0, 4), random.uniform(1, 1.5)});
  points.push_back({1e12, 2, 1});  // flew off, with a neighbour
  points.push_back({1e12, 2.5, 1});
  points.push_back({std::nan(""), 2, 1});
  constexpr double edge = 0.7;
  const auto near = [&](std::size_t i, std::size_t j) {
    const Vec3 &a = points[i], &b = points[j];
    return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]) <= edge;
  };
  for (const int most : {1, 3, 200}) {
    CAPTURE(most);
    const dem::CellGrid grid(
        points.size(), edge, [&](std::size_t i) { return points[i]; }, most);
    for (std::size_t i = 0; i + 1 < points.size(); ++i) {
      std::vector<std::size_t> all, found;
      for (std::size_t j = 0; j < points.size(); ++j) {
        if (near(i, j)) all.push_back(j);
      }
      grid.around(points[i], [&](std::int32_t j) {
        if (near(i, static_cast<std::size_t>(j))) found.push_back(static_cast<std::size_t>(j));
      });
      std::sort(found.begin(), found.end());
      CHECK(found == all);
    }
  }
  const std::vector<Vec3> row{{2.5, 0, 0}, {0.5, 0, 0}, {1.5, 0, 0}, {0.6, 1.1, 0}, {1.6, 0, 0}, {1.5, 0, 1.1}};
  const dem::CellGrid grid(row.size(), 1, [&](std::size_t i) { return row[i]; });
  std::vector<std::int32_t> visited;
  grid.around({1.5, 0, 0}, [&](std::int32_t j) { visited.push_back(j); });
  CHECK(visited == std::vector<std::int32_t>{1, 2, 4, 0, 3, 5});  // x fastest, then y, then z; in a cell by number
  const dem::CellGrid empty(0, 1, [&](std::size_t i) { return row[i]; });
  empty.around({0, 0, 0}, [](std::int32_t) { FAIL("there is no point"); });
}

TEST_CASE("a Morton code takes the bits of x, y and z in turn") {
  CHECK(dem::morton(1, 0, 0) == 1);
  CHECK(dem::morton(0, 1, 0) == 2);
  CHECK(dem::morton(0, 0, 1) == 4);
  CHECK(dem::morton(0x1fffff, 0x1fffff, 0x1fffff) == 0x7fffffffffffffffULL);
  CHECK(dem::morton(0x200000, 0, 0) == 0);  // the 22nd bit is not taken
  std::uint64_t code = 0;
  for (unsigned b = 0; b < 21; ++b) {
    code |= std::uint64_t{0x15a5a5U >> b & 1U} << 3 * b | std::uint64_t{0x0c3c3cU >> b & 1U} << (3 * b + 1) |
            std::uint64_t{0x1f00ffU >> b & 1U} << (3 * b + 2);
  }
  CHECK(dem::morton(0x15a5a5, 0x0c3c3c, 0x1f00ff) == code);
}

TEST_CASE("points are ordered by slab, along the curve, and by number where they share a cell") {
  const std::vector<dem::SlabCell> cells{{1, 0, 0, 0}, {0, 1, 1, 0}, {0, 0, 0, 1}, {0, 1, 1, 0}, {0, 1, 0, 0}};
  const auto order = dem::slab_order<std::int32_t>(cells.size(), [&](std::size_t i) { return cells[i]; });
  CHECK(order == std::vector<std::int32_t>{4, 1, 3, 2, 0});
}

TEST_CASE("DEM_SIMD leaves one set of instructions, if the processor has it") {
  using dem::InstructionSet;
  const char* const before = std::getenv("DEM_SIMD");
  const std::string kept = before ? before : "";
  unsetenv("DEM_SIMD");
  const std::vector<InstructionSet> all = dem::instruction_sets();
  CHECK(all.front() == InstructionSet::sse2);
  CHECK(std::is_sorted(all.begin(), all.end()));
  CHECK(dem::widest_set() == all.back());
  for (const InstructionSet set : {InstructionSet::sse2, InstructionSet::avx2, InstructionSet::avx512}) {
    const std::string name(dem::name_of(set));
    CHECK(dem::set_of(name) == set);
    setenv("DEM_SIMD", name.c_str(), 1);
    if (dem::processor_has(set)) {
      CHECK(dem::instruction_sets() == std::vector{set});
    } else {
      CHECK_THROWS_AS((void)dem::instruction_sets(), dem::InputError);
    }
  }
  setenv("DEM_SIMD", "mmx", 1);
  CHECK_THROWS_AS((void)dem::instruction_sets(), dem::InputError);
  unsetenv("DEM_SIMD");
  if (before) setenv("DEM_SIMD", kept.c_str(), 1);
}

TEST_CASE("the set with which work takes least time is found") {
  for (const dem::InstructionSet fast : dem::instruction_sets()) {
    double sum = 0;
    int calls = 0;
    const auto work = [&](dem::InstructionSet set) {
      ++calls;
      for (int i = 1; i < (set == fast ? 5000 : 50000); ++i) sum += 1.0 / i;
    };
    CHECK(dem::fastest_set(work) == fast);
    CHECK(sum >= 0);
    if (dem::instruction_sets().size() == 1) CHECK(calls == 0);
  }
}

TEST_CASE("nothing is written outside its folder") {
  const test::Scratch folder;
  const std::filesystem::path out = folder / "out";
  for (const std::string& name : {std::string("../x"), std::string("a/../../x"), std::string("/tmp/x"), std::string(""),
                                  std::string(".."), std::string("a\0b", 3)}) {
    CAPTURE(name);
    CHECK_THROWS_AS((void)dem::inside(out, name), dem::EnvironmentError);
  }
  CHECK(dem::inside(out, "a/b.csv") == out / "a/b.csv");
  for (const std::string& name : {std::string("../x"), std::string("a/../../x"), std::string("a\0b", 3)}) {
    CAPTURE(name);
    CHECK_THROWS_AS(dem::write_file(out / name, "x"), dem::EnvironmentError);
    CHECK_THROWS_AS(dem::make_folder(out / name), dem::EnvironmentError);
  }
  CHECK(std::filesystem::is_empty(folder.path()));
  // A folder above is one that was asked for.
  const std::filesystem::path before = std::filesystem::current_path();
  std::filesystem::create_directory(out);
  std::filesystem::current_path(out);
  dem::write_file("../beside/x", "x");
  std::filesystem::current_path(before);
  CHECK(dem::read_file(folder / "beside/x") == "x");
}

TEST_CASE("a temporary name is looked for a thousand times, not for ever") {
  const test::Scratch folder;
  std::string head;  // of the names that this process takes
  dem::write_aside(folder / "x", [&](const std::filesystem::path& part) {
    head = part.filename().string();
    std::ofstream(part) << "y";
  });
  REQUIRE(head.ends_with("-0.part"));
  head.resize(head.size() - 6);
  for (int i = 0; i < 1000; ++i) std::filesystem::create_directory(folder / (head + std::to_string(i) + ".part"));
  CHECK_THROWS_WITH_AS(dem::write_file(folder / "x", "x"), doctest::Contains("are taken; remove them"),
                       dem::EnvironmentError);
  std::filesystem::remove(folder / (head + "999.part"));
  dem::write_file(folder / "x", "x");
  CHECK(dem::read_file(folder / "x") == "x");
}

TEST_CASE("files of people are regular ones below a size") {
  const test::Scratch folder;
  dem::write_file(folder / "x", "0123456789");
  CHECK(dem::read_input(folder / "x", 10) == "0123456789");
  const auto refused = [&](const std::filesystem::path& path, const char* said) {
    CHECK_THROWS_WITH_AS((void)dem::read_input(path, 9, {"s.toml", 3, 1}, "grains.file"), doctest::Contains(said),
                         dem::InputError);
  };
  refused(folder / "x", "s.toml:3:1: grains.file:");
  refused(folder / "x", "has 10 bytes; at most 9 are read");
  refused(folder / "y", "No such file");
  refused(folder.path(), "is no plain file");
  refused("/dev/zero", "is no plain file");
}

TEST_CASE("what acts on a terminal is shown, not done") {
  CHECK(dem::printable("a \x1b[2J\x07\x7f b") == "a \\x1b[2J\\x07\\x7f b");
  CHECK(dem::printable("a\nb") == "a\\x0ab");
  CHECK(dem::printable("a\nb", true) == "a\nb");
  CHECK(dem::printable("\xc2\x9b \xe2\x80\xae \xff") == "\\u009b \\u202e \\xff");
  CHECK(dem::printable("Größe σ 石英") == "Größe σ 石英");
  CHECK(dem::is_utf8("Größe"));
  for (const char* text : {"\xe9", "\xc0\xaf", "\xed\xa0\x80", "\xf5\x80\x80\x80", "\xe2\x80"}) {
    CHECK_FALSE(dem::is_utf8(text));
  }
  CHECK(dem::length_of("Größe") == 5);
}
