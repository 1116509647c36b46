// The readings of crack initiation beside each other (Zhao et al. 2021, section 3.3 and Fig. 8).
#include <fmt/format.h>

#include <array>
#include <cmath>

#include "reports/figures/table.h"
#include "reports/figures/texture/parts.h"
#include "reports/text.h"

namespace reports::texture {
namespace {

struct Reading {
  dem::Quantity stress;
  std::string_view name, how, said;
};
constexpr std::array readings{
    Reading{quantity::initiation_by_stiffness, "Axial stiffness", "the axial stiffness is {} below its early plateau",
            "from the axial stiffness"},
    Reading{quantity::stress_at_strain, "Strain of 0.1 %", "the stress there", "at 0.1 % strain"},
    Reading{quantity::initiation_by_cracks, "One percent of cracks", "as many cracks as 1 % of those at the peak",
            "at 1 % of the cracks"},
    Reading{quantity::initiation_by_volume, "Crack volumetric strain",
            "the volumetric strain less its elastic part turns to dilation", "from the crack volumetric strain"}};

std::string cell(const Spread& spread, int digits) {
  if (spread.count == 0) return "not found";
  return number(spread.mean, digits) + (spread.count > 1 ? " ± " + number(spread.deviation, 2) : "");
}

}  // namespace

FigureContent initiation_readings(const StudyResult& study) {
  FigureContent content;
  content.statement =
      "Crack initiation is where the axial stiffness begins to fluctuate, at about 0.1 % strain and 71.1 MPa, 34 % of "
      "the UCS; about 40 % in laboratory experiments.";
  content.rows = {"stress_at_0_1_percent_ar_1", "crack_initiation_strain"};
  const auto cases = swept_by_test(study, test_compression);
  if (auto missing = missing_cases(study, test_compression)) content.panels.push_back(*missing);
  if (cases.empty()) return content;
  TextTable table{{"Reading", "Where", "σci (MPa)", "Share of the peak (%)"}, {}};
  std::vector<std::string> said;
  for (const Reading& one : readings) {
    const ValueOf stress = shown(one.stress);
    const ValueOf share = [&](const dem::Record& r) {
      return 100 * stress(r) / r.value_or_nan(quantity::compressive_strength);
    };
    const Spread found = analysis::spread(cases.front(), stress);
    const Spread part = analysis::spread(cases.front(), share);
    const std::string departure = percent(study.scenario->real("measure.stiffness_departure"), 0);
    table.rows.push_back(
        {std::string(one.name), fmt::format(fmt::runtime(one.how), departure), cell(found, 3), cell(part, 3)});
    said.push_back((found.count == 0 ? std::string("no value") : number(found.mean, 3) + " MPa") + " " +
                   std::string(one.said));
  }
  content.panels.push_back(
      {.id = "",
       .caption = "Crack initiation by four readings of one test, " + cases.front().label +
                  (cases.front().repeats.size() > 1 ? "; mean ± standard deviation of the seeds." : "."),
       .alt = "",
       .content = table,
       .per_row = 1});
  content.finding = "Crack initiation " + at_case(cases.front()) + ": " + listed(said) + ".";
  return content;
}

}  // namespace reports::texture
