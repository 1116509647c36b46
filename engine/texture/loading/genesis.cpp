#include "engine/texture/loading/genesis.h"

namespace dem::texture {
namespace {

constexpr std::string_view name = "genesis";

}  // namespace

TestEntry genesis_entry() {
  return {name, [] { return std::vector<Key>{}; }, [](const Scenario&) { return Test{.name = name}; }};
}

}  // namespace dem::texture
