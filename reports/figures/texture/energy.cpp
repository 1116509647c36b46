// Where the energy went in the two tests of the granite.
#include "reports/figures/energy.h"

#include "reports/figures/table.h"
#include "reports/figures/texture/parts.h"

namespace reports::texture {

// Against the strain of the platens, which only grows: that of the gauge springs back where a band fails outside it.
FigureContent energy_compression(const StudyResult& study) {
  return energy_figure(study, test_compression, swept(study, test_compression), "platen_strain",
                       "Strain of the platens (%)", 100);
}

FigureContent energy_tension(const StudyResult& study) {
  return energy_figure(study, test_tension, swept(study, test_tension), "platen_strain", "Strain of the platens (%)",
                       100);
}

}  // namespace reports::texture
