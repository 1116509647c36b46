// What holds together after failure, and the emission of the blocks: bonds that break as events.
#include <algorithm>
#include <cmath>
#include <vector>

#include "reports/figures/emission.h"
#include "reports/figures/fragments.h"
#include "reports/figures/lattice/parts.h"
#include "reports/figures/table.h"
#include "reports/text.h"

namespace reports::lattice {
namespace {

constexpr int most_cases = 4;

// The main records of both tests, tension with all kinds of planes.
std::vector<SeriesCase> failed(const StudyResult& study) {
  std::vector<SeriesCase> cases;
  const auto add = [&](const dem::Record* record, const std::string& label, const std::string& id) {
    if (!record || !has_failure(*record) || cases.size() == most_cases) return;
    SeriesCase item;
    item.record = record;
    item.label = label;
    item.id = id;
    item.colour = render::palette(cases.size());
    item.line = render::line_style(cases.size());
    cases.push_back(item);
  };
  add(main_record(study, "compression"), "compression", "compression");
  for (const dem::Record* record : records_of(study, "tension"))
    add(record, "tension, " + planes_of(*record) + " planes", "tension_" + planes_of(*record));
  return cases;
}

// Small parts all around a crushed block hide its larger ones: single particles, the last entry of the key, are left out, and
// so is what stands before one of the four largest parts, the first entries. The eye looks against y.
void without_what_hides(Picture& picture, const analysis::Fragments& parts) {
  if (parts.single() * 4 < parts.of.size()) return;
  constexpr std::size_t largest = 4;
  const auto same = [](const render::Colour& a, const render::Colour& b) {
    return a.red == b.red && a.green == b.green && a.blue == b.blue;
  };
  const render::Spheres all = picture.scene.spheres.front();
  std::vector<std::size_t> large;
  std::vector<bool> is_large(all.centre.size(), false);
  for (std::size_t i = 0; i < all.centre.size(); ++i) {
    for (std::size_t rank = 0; rank < std::min(largest, picture.legend.size() - 1); ++rank)
      is_large[i] = is_large[i] || same(all.colour[i], picture.legend[rank].colour);
    if (is_large[i]) large.push_back(i);
  }
  const auto hides = [&](std::size_t i) {
    return std::ranges::any_of(large, [&](std::size_t k) {
      return all.centre[i][1] > all.centre[k][1] &&
             std::hypot(all.centre[i][0] - all.centre[k][0], all.centre[i][2] - all.centre[k][2]) <
                 all.radius[i] + all.radius[k];
    });
  };
  render::Spheres& kept = picture.scene.spheres.front();
  kept.centre.clear(), kept.radius.clear(), kept.colour.clear();
  for (std::size_t i = 0; i < all.centre.size(); ++i) {
    if (same(all.colour[i], picture.legend.back().colour) || (!is_large[i] && hides(i))) continue;
    kept.centre.push_back(all.centre[i]);
    kept.radius.push_back(all.radius[i]);
    kept.colour.push_back(all.colour[i]);
  }
  picture.legend.pop_back();
  picture.label += ", without " + count(static_cast<double>(parts.single())) +
                   " single particles and what hides the four largest parts";
}

render::Outline box_of(const dem::Record& record) {
  const auto place = record.table("particles").real("position"), radius = record.table("particles").real("radius");
  render::Outline box;
  box.shape = render::Outline::Shape::box;
  for (std::size_t i = 0; i < place.size(); ++i) {
    const double low = place[i] - radius[i / 3], high = place[i] + radius[i / 3];
    box.low[i % 3] = i < 3 ? low : std::min(box.low[i % 3], low);
    box.high[i % 3] = i < 3 ? high : std::max(box.high[i % 3], high);
  }
  return box;
}

}  // namespace

FigureContent fragments(const StudyResult& study) {
  FigureContent content;
  content.statement = "In tension the block breaks in two.";
  content.rows = {"pieces"};
  std::vector<Broken> cases;
  for (const SeriesCase& item : failed(study)) cases.push_back(broken_of(*item.record, item));
  if (cases.empty()) return content;
  constexpr double apart = 0.3;
  for (const Broken& broken : cases) {
    const render::Outline box = box_of(*broken.record);
    Picture picture = fragments_picture(broken, apart, {box.low, box.high}, 480);
    without_what_hides(picture, broken.parts);
    content.panels.push_back({.id = "apart_" + broken.id,
                              .caption =
                                  "Parts that hold together at the end, each moved outwards by 0.3 of its distance "
                                  "from the middle. Percentages are of the volume; the others are counts.",
                              .alt = fragments_words(broken) + ".",
                              .content = std::move(picture),
                              .per_row = 3});
  }
  content.panels.push_back({.id = "table",
                            .caption = "Parts at the end of the test.",
                            .alt = "",
                            .content = fragments_table(cases),
                            .per_row = 1});
  std::vector<std::string> said;
  for (const Broken& broken : cases) said.push_back(fragments_words(broken));
  content.finding = sentence(said);
  return content;
}

FigureContent acoustic_emission(const StudyResult& study) {
  FigureContent content;
  const dem::Scenario& s = *study.scenario;
  const double speed =
      std::sqrt(s.real("rock.young_modulus") / (2 * (1 + s.real("rock.poisson_ratio"))) / s.real("rock.density"));
  std::vector<Emission> all;
  for (const SeriesCase& item : failed(study)) {
    const Emitter of{.window = s.real("emission.window"),
                     .duration = s.real("emission.duration"),
                     .shear_wave = speed,
                     .diameter = 2 * item.record->table("particles").real("radius")[0],
                     .strain = "axial_strain",
                     .heat = {"breaking_heat_normal", "breaking_heat_shear"},
                     .outline = box_of(*item.record)};
    if (auto found = emission_of(item, of)) all.push_back(std::move(*found));
  }
  add_emission(content, all);
  return content;
}

}  // namespace reports::lattice
