// Blocks of the close-packed lattice: published counts, and a graph that is what geometry says.
#include <doctest/doctest.h>

#include <cmath>
#include <set>

#include "engine/lattice/block.h"

using namespace dem::lattice;

TEST_CASE("every published block has the published number of elements, and its bonds") {
  struct Published {
    int ny;
    std::size_t elements, bonds;
  };
  for (const auto& [ny, elements, bonds] : {Published{2, 4, 6},
                                            {4, 82, 319},
                                            {6, 255, 1157},
                                            {8, 580, 2831},
                                            {10, 1105, 5629},
                                            {12, 2166, 11412},
                                            {16, 5461, 0},
                                            {20, 10985, 0},
                                            {24, 18079, 0},
                                            {30, 37681, 215424}}) {
    const Block block = make_block(block_shape(ny), 1e-3);
    CHECK(block.site.size() == elements);
    CHECK(static_cast<std::size_t>(element_count(block.shape)) == elements);
    if (bonds) CHECK(block.bonds.size() == bonds);
  }
}

TEST_CASE("bonds join exactly the elements that touch, each once") {
  for (const BlockShape& shape : {block_shape(2), block_shape(5), block_shape(6), BlockShape{3, 3, 7}}) {
    const Block block = make_block(shape, 1e-3);
    std::set<std::pair<int, int>> touching, bonded;
    for (std::size_t i = 0; i < block.site.size(); ++i) {
      for (std::size_t j = i + 1; j < block.site.size(); ++j) {
        double r2 = 0;
        for (std::size_t k = 0; k < 3; ++k) r2 += std::pow(block.position[i][k] - block.position[j][k], 2);
        CHECK(std::sqrt(r2) > 0.999999e-3);
        if (std::sqrt(r2) < 1.000001e-3) touching.insert({static_cast<int>(i), static_cast<int>(j)});
      }
    }
    for (const Block::Bond& b : block.bonds) {
      bonded.insert({std::min(b.a, b.b), std::max(b.a, b.b)});
      const auto r = bond_vector(block.site[static_cast<std::size_t>(b.a)].layer & 1, b.direction);
      for (std::size_t k = 0; k < 3; ++k) {
        const double from_positions =
            block.position[static_cast<std::size_t>(b.b)][k] - block.position[static_cast<std::size_t>(b.a)][k];
        CHECK(from_positions == doctest::Approx(1e-3 * r[k]).epsilon(1e-12).scale(1e-3));
      }
    }
    CHECK(bonded.size() == block.bonds.size());
    CHECK(bonded == touching);
  }
}

TEST_CASE("faces hold the outermost sites") {
  const Block block = make_block(block_shape(12), 1e-3);
  CHECK(block.face(2, false).size() == 7 * 12 + 6 * 11);
  CHECK(block.face(2, true).size() == block.face(2, false).size());
  CHECK(block.face(1, false).size() == 8 * 7 + 7 * 6);
  CHECK(block.face(0, true).size() == 8 * 12);
}
