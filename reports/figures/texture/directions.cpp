// Which way cracks lie: poles on equal-area nets with contoured density, the plane at its maximum, roses of strike.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "engine/analysis/directions.h"
#include "reports/figures/table.h"
#include "reports/figures/texture/failed.h"
#include "reports/figures/texture/nets.h"
#include "reports/figures/texture/parts.h"
#include "reports/text.h"

namespace reports::texture {
namespace {

constexpr std::size_t fewest = 10, strikes = 18;

/// The poles of some cracks, and what is read off them.
struct Found {
  std::string label;
  analysis::Poles poles;
  double area = 0;  // mm^2
  std::optional<analysis::Maximum> maximum;
};

Found found_in(const dem::Record& record, std::string label, int place = -1, int mode = -1) {
  Found found{
      .label = std::move(label), .poles = analysis::poles_of(record.table("cracks"), place, mode), .maximum = {}};
  for (const double w : found.poles.weight) found.area += 1e6 * w;
  if (found.poles.weight.size() >= fewest) found.maximum = analysis::maximum_of(analysis::PoleDensity(found.poles));
  return found;
}

std::string plane_words(const analysis::Maximum& m) {
  return fmt::format("dipping {}° towards {}°", number(m.dip(), 2), count(std::round(m.dip_direction())));
}

Net net_of(const Found& found) {
  Net net{.label = found.label, .words = {}, .poles = found.poles, .maximum = found.maximum};
  net.words.push_back(count(static_cast<double>(found.poles.weight.size())) + " poles");
  net.words.push_back(found.maximum ? fmt::format("maximum {} × uniform", number(found.maximum->times_uniform, 2))
                                    : "");
  net.words.push_back(found.maximum ? fmt::format("dip {}° to {}°", number(found.maximum->dip(), 2),
                                                  count(std::round(found.maximum->dip_direction())))
                                    : "");
  return net;
}

std::vector<std::string> row_of(const Found& found) {
  const auto& m = found.maximum;
  const auto shown = [&](double value, int digits) { return m ? number(value, digits) : std::string("–"); };
  return {found.label,
          count(static_cast<double>(found.poles.weight.size())),
          number(found.area, 3),
          shown(m ? m->times_uniform : 0, 3),
          shown(m ? m->deviations : 0, 2),
          shown(m ? m->dip() : 0, 2),
          m ? count(std::round(m->dip_direction())) : "–",
          shown(m ? m->to_axis() : 0, 2)};
}

std::string words_of(const Found& found) {
  if (!found.maximum) return fmt::format("{}: too few poles ({})", found.label, found.poles.weight.size());
  return fmt::format("{}: {} times uniform, at the pole of a plane {}", found.label,
                     number(found.maximum->times_uniform, 2), plane_words(*found.maximum));
}

std::string all_words(const std::vector<Found>& found) {
  std::vector<std::string> said;
  for (const Found& one : found) said.push_back(words_of(one));
  return joined(said, "; ");
}

std::string nets_of(const std::vector<Found>& found, double largest) {
  std::vector<Net> nets;
  for (const Found& one : found) nets.push_back(net_of(one));
  return nets_drawing(nets, largest);
}

double largest_of(const std::vector<Found>& found) {
  double largest = 0;
  for (const Found& one : found)
    if (one.maximum) largest = std::max(largest, one.maximum->times_uniform);
  return largest;
}

}  // namespace

FigureContent crack_directions(const StudyResult& study) {
  FigureContent content;
  add_missing_failed(content, study);
  const std::vector<SeriesCase> cases = failed(study);
  std::vector<Found> found;
  for (const SeriesCase& item : cases) found.push_back(found_in(*item.record, item.label));
  std::erase_if(found, [](const Found& one) { return one.poles.weight.empty(); });
  if (found.empty()) return content;
  const SeriesCase& base = cases.front();
  std::vector<Found> classes;
  for (const CrackClass& one : crack_classes())
    classes.push_back(found_in(*base.record, std::string(one.name), one.place, one.mode));
  std::erase_if(classes, [](const Found& one) { return one.poles.weight.empty(); });
  const double largest = std::max(largest_of(found), largest_of(classes));  // one scale of greys for all nets
  const std::string shared = found.size() + classes.size() > 1 ? " The nets of this figure share one scale." : "";
  content.panels.push_back(
      {.id = "nets",
       .caption = "Poles of all cracks on the lower hemisphere, equal areas, weighted by crack area (one pole per "
                  "contact and mode): density by the kernel of Kamb and Vollmer; " +
                  std::string(load_words(*base.record)) +
                  ", the middle of the net. Below it: dip and dip direction of the plane of the maximum, "
                  "counter-clockwise from x." +
                  std::string(found.size() > 1 ? shared : ""),
       .alt = all_words(found) + ".",
       .content = nets_of(found, largest),
       .per_row = found.size() > 1 ? 1 : 2,
       .whole_width = found.size() > 1});
  if (!classes.empty()) {
    content.panels.push_back(
        {.id = "classes",
         .caption = "The same by class of crack: " + base.label + "." + (found.size() > 1 ? "" : shared),
         .alt = all_words(classes) + ".",
         .content = nets_of(classes, largest),
         .per_row = classes.size() > 1 ? 1 : 2,
         .whole_width = classes.size() > 1});
  }
  std::vector<Rose> roses;
  for (const Found& one : found) {
    const auto share = analysis::strikes_of(one.poles, strikes);
    if (one.poles.weight.size() >= fewest && std::isfinite(share[0])) roses.push_back({one.label, {}, share});
  }
  if (!roses.empty()) {
    content.panels.push_back({.id = "strikes",
                              .caption = "Strike of the cracks by the length of their traces on horizontal sections; "
                                         "the area of a sector is its share.",
                              .alt = "Roses of the strike of cracks, from x towards y.",
                              .content = roses_drawing(roses),
                              .per_row = roses.size() > 1 ? 1 : 2,
                              .whole_width = roses.size() > 1});
  }
  TextTable table{{"Cracks", "Poles", "Area (mm²)", "Largest density (× uniform)", "Above uniform (std. deviations)",
                   "Plane there: dip (°)", "Dip direction (° from x)", "To the loading axis (°)"},
                  {}};
  for (const Found& one : found) table.rows.push_back(row_of(one));
  for (Found& one : classes) {
    one.label = base.label + ", " + one.label;
    table.rows.push_back(row_of(one));
  }
  content.panels.push_back({.id = "maxima",
                            .caption = "Largest densities of poles, and the planes there.",
                            .alt = "",
                            .content = table,
                            .per_row = 1});
  content.finding = "Largest density of poles of cracks. " + capital(all_words(found)) + ".";
  return content;
}

}  // namespace reports::texture
