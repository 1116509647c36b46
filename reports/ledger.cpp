#include "reports/ledger.h"

#include <algorithm>
#include <array>

#include "reports/text.h"

namespace reports {
namespace {

std::string label_of(const std::string& column) {
  constexpr std::array<std::pair<std::string_view, std::string_view>, 8> known{
      {{"work", "Work of the platens"},
       {"elastic", "Elastic"},
       {"kinetic", "Kinetic"},
       {"damping", "Damping"},
       {"friction", "Friction"},
       {"bond_tension", "Bonds broken in tension"},
       {"bond_shear", "Bonds broken in shear"},
       {"residual", "Residual"}}};
  const auto found = std::ranges::find(known, column, [](const auto& item) { return item.first; });
  if (found != known.end()) return std::string(found->second);
  std::string text = words(column);
  if (!text.empty() && text[0] >= 'a' && text[0] <= 'z') text[0] = static_cast<char>(text[0] - 'a' + 'A');
  return text;
}

}  // namespace

std::vector<LedgerTerm> ledger_terms(const dem::Table& history) {
  std::vector<LedgerTerm> terms;
  for (const dem::Column& column : history.columns) {
    if (column.unit != "J" || column.width != 1) continue;
    const auto role = column.name.starts_with("work") ? LedgerTerm::Role::work
                      : column.name == "residual"     ? LedgerTerm::Role::residual
                                                      : LedgerTerm::Role::share;
    terms.push_back({column.name, label_of(column.name), role});
  }
  return terms;
}

}  // namespace reports
