#include "engine/analysis/ledger.h"

#include <algorithm>
#include <array>

namespace dem::analysis {
namespace {

std::string label_of(const std::string& column) {
  constexpr std::array<std::pair<std::string_view, std::string_view>, 18> known{
      {{"work", "Work of the boundary"},
       {"elastic_normal", "Elastic energy, normal springs"},
       {"elastic_shear", "Elastic energy, shear springs"},
       {"elastic_planes", "Elastic energy, springs of the planes"},
       {"breaking_heat_normal", "Breaking heat, normal springs"},
       {"breaking_heat_shear", "Breaking heat, shear springs"},
       {"boundary_work", "Work of the walls"},
       {"growth_work", "Work of growing grains"},
       {"released", "Released by breaking"},
       {"jumped", "Released by jumps"},
       {"elastic", "Elastic"},
       {"kinetic", "Kinetic"},
       {"gravity", "Potential energy of the weight"},
       {"damping", "Damping"},
       {"friction", "Friction"},
       {"bond_tension", "Bonds broken in tension"},
       {"bond_shear", "Bonds broken in shear"},
       {"residual", "Residual"}}};
  const auto found = std::ranges::find(known, column, [](const auto& item) { return item.first; });
  if (found != known.end()) return std::string(found->second);
  std::string text = column;
  std::ranges::replace(text, '_', ' ');
  if (!text.empty() && text[0] >= 'a' && text[0] <= 'z') text[0] = static_cast<char>(text[0] - 'a' + 'A');
  return text;
}

}  // namespace

bool in_elastic_constants(const Table& history) { return history.has("boundary_work"); }

std::vector<LedgerTerm> ledger_terms(const Table& history) {
  constexpr std::array<std::string_view, 5> of_a_sheet{"boundary_work", "growth_work", "elastic", "released", "jumped"};
  std::vector<LedgerTerm> terms;
  for (const Column& column : history.columns) {
    const bool energy = in_elastic_constants(history) ? std::ranges::find(of_a_sheet, column.name) != of_a_sheet.end()
                                                      : column.unit == "J" && column.width == 1;
    if (!energy) continue;
    const bool in = column.name.starts_with("work") || column.name.ends_with("_work");
    const auto role = in                          ? LedgerTerm::Role::work
                      : column.name == "residual" ? LedgerTerm::Role::residual
                                                  : LedgerTerm::Role::share;
    terms.push_back({column.name, label_of(column.name), role});
  }
  std::ranges::stable_partition(terms, [](const LedgerTerm& term) { return term.role == LedgerTerm::Role::work; });
  return terms;
}

}  // namespace dem::analysis
