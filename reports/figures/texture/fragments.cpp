// What holds together after failure: parts in colours by size and pulled apart, and their sizes.
#include <fmt/format.h>

#include <algorithm>

#include "engine/analysis/goodness.h"
#include "reports/figures/fragments.h"
#include "reports/figures/table.h"
#include "reports/figures/texture/failed.h"
#include "reports/figures/texture/parts.h"

namespace reports::texture {

FigureContent fragments(const StudyResult& study) {
  FigureContent content;
  add_missing_failed(content, study);
  const std::vector<SeriesCase> specimens = failed(study);
  std::vector<Broken> cases;
  for (const SeriesCase& item : specimens) cases.push_back(broken_of(*item.record, item));
  if (cases.empty()) return content;
  constexpr double apart = 0.3;
  const int per_row = pictures_per_row(specimens);
  std::vector<Picture> pictures;
  for (const Broken& broken : cases)
    pictures.push_back(fragments_picture(broken, apart, frame_of(size_of(*broken.record)), 480));
  const std::string caption = fmt::format(
      "Parts that hold together at the end of loading, each moved outwards by {:g} of its distance from the middle. {}",
      apart, key_values_words(pictures));
  for (std::size_t i = 0; i < cases.size(); ++i)
    content.panels.push_back({.id = "apart_" + cases[i].id,
                              .caption = caption,
                              .alt = fragments_words(cases[i]) + ".",
                              .content = std::move(pictures[i]),
                              .per_row = per_row});
  std::vector<std::string> said, laws;
  for (const Broken& broken : cases) {
    said.push_back(fragments_words(broken));
    if (const auto law = size_law(broken); law && law->holds())
      laws.push_back(broken.label + " " + estimate_text(law->exponent, 3));
  }
  content.finding = capital(joined(said, "; ")) + ".";
  if (std::ranges::all_of(cases, [](const Broken& b) { return b.parts.all.size() == 1; })) return content;
  content.panels.push_back({.id = "numbers",
                            .caption = std::string("Parts by their number of particles") +
                                       (laws.empty() ? "."
                                                     : "; lines are power laws through all but the largest, by maximum "
                                                       "likelihood, where one may hold."),
                            .alt = laws.empty() ? "No power law holds, or parts are too few for one."
                                                : "Exponents: " + joined(laws, "; ") + ".",
                            .content = fragments_by_number(cases),
                            .per_row = 2});
  // Of a specimen that holds together nearly all volume has one size: there is nothing to see in a distribution.
  constexpr double nearly_all = 0.9;
  if (std::ranges::any_of(cases, [](const Broken& b) { return b.parts.share(0) < nearly_all; }))
    content.panels.push_back({.id = "volumes",
                              .caption = "Share of the volume in parts up to a size.",
                              .alt = joined(said, "; ") + ".",
                              .content = fragments_by_volume(cases),
                              .per_row = 2});
  content.panels.push_back(
      {.id = "table",
       .caption = has_size_law(cases) ? "Parts at the end of loading. Exponent of the power law of their numbers of "
                                        "particles n, the largest part left out, fitted to at least 30 parts of at "
                                        "least five sizes. p: share of samples drawn from the law that lie at least as "
                                        "far from it; below " +
                                            percent(dem::analysis::least_p, 0) + " no exponent is given."
                                      : std::string("Parts at the end of loading; too few parts or sizes for a power "
                                                    "law."),
       .alt = "",
       .content = fragments_table(cases),
       .per_row = 1});
  return content;
}

}  // namespace reports::texture
