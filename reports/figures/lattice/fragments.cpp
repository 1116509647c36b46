// What holds together after failure, and the emission of the blocks: bonds that break as events.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "engine/analysis/goodness.h"
#include "reports/figures/emission.h"
#include "reports/figures/fragments.h"
#include "reports/figures/lattice/parts.h"
#include "reports/figures/table.h"
#include "reports/text.h"

namespace reports::lattice {
namespace {

constexpr int most_cases = 4;
constexpr double main_part = 0.05;  // share of the volume of a main part

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

// Whether what is drawn at `front` hides what is drawn at `behind` from an eye that looks along x or y.
bool hides(const render::Spheres& all, std::size_t front, std::size_t behind, const render::Point& look) {
  const std::size_t deep = look[0] != 0 ? 0 : 1, across = 1 - deep;
  const render::Point &a = all.centre[front], &b = all.centre[behind];
  return (b[deep] - a[deep]) * look[deep] > 0 &&
         std::hypot(a[across] - b[across], a[2] - b[2]) < all.radius[front] + all.radius[behind];
}

// Small parts all around a crushed block hide its larger ones: single particles, the last entry of the key, are left out, and
// so is what stands before one of the four largest parts, the first entries. The eye looks from the side where these hide
// each other least.
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
  render::Point& look = picture.scene.camera.direction;
  std::size_t most = 0;
  for (const render::Point& side : {render::Point{0, -1, 0}, {0, 1, 0}, {-1, 0, 0}, {1, 0, 0}}) {
    std::array<std::size_t, largest> seen{};  // particles of each that none of another part hides
    for (const std::size_t k : large) {
      const auto own = [&](std::size_t i) { return same(all.colour[i], all.colour[k]); };
      if (std::ranges::any_of(large, [&](std::size_t i) { return !own(i) && hides(all, i, k, side); })) continue;
      for (std::size_t rank = 0; rank < largest && rank + 1 < picture.legend.size(); ++rank)
        seen[rank] += same(all.colour[k], picture.legend[rank].colour);
    }
    if (const std::size_t least = 1 + std::ranges::min(seen); least > most) most = least, look = side;
  }
  const auto before_large = [&](std::size_t i) {
    return std::ranges::any_of(large, [&](std::size_t k) { return hides(all, i, k, look); });
  };
  render::Spheres& kept = picture.scene.spheres.front();
  kept.centre.clear(), kept.radius.clear(), kept.colour.clear();
  for (std::size_t i = 0; i < all.centre.size(); ++i) {
    if (same(all.colour[i], picture.legend.back().colour) || (!is_large[i] && before_large(i))) continue;
    kept.centre.push_back(all.centre[i]);
    kept.radius.push_back(all.radius[i]);
    kept.colour.push_back(all.colour[i]);
  }
  std::erase_if(picture.legend, [&](const auto& entry) {
    return std::ranges::none_of(kept.colour, [&](const render::Colour& c) { return same(c, entry.colour); });
  });
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

// What the table says of the sizes of parts.
std::string law_words() {
  return " The exponent is that of a power law of their numbers of elements, the largest part left out, fitted to at "
         "least 30 parts of at least five sizes; p is the share of samples drawn from that law that lie at least as "
         "far from it, and below " +
         percent(analysis::least_p, 0) + " no exponent is given.";
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
  std::vector<Picture> pictures;
  for (const Broken& broken : cases) {
    const render::Outline box = box_of(*broken.record);
    pictures.push_back(fragments_picture(broken, apart, {box.low, box.high}, 480));
    without_what_hides(pictures.back(), broken.parts);
  }
  const std::string caption = fmt::format(
      "Parts that hold together at the end, each moved outwards by {:g} of its distance from the middle. {}", apart,
      key_values_words(pictures));
  for (std::size_t i = 0; i < cases.size(); ++i)
    content.panels.push_back({.id = "apart_" + cases[i].id,
                              .caption = caption,
                              .alt = fragments_words(cases[i]) + ".",
                              .content = std::move(pictures[i]),
                              .per_row = 3});
  const double published = study.published_value("pieces");
  content.panels.push_back(
      {.id = "table",
       .caption = fmt::format("Parts at the end of the test.{}{}", has_size_law(cases) ? law_words() : std::string(),
                              std::isfinite(published)
                                  ? fmt::format(" Only pieces of at least 2 % of the elements count towards the "
                                                "published number ({}).",
                                                count(published))
                                  : std::string()),
       .alt = "",
       .content = fragments_table(cases),
       .per_row = 1});
  std::vector<std::string> said;
  std::vector<const Broken*> clean;  // blocks that part and leave nothing small
  const auto parts_of = [](const Broken& broken) { return broken.parts.of_at_least(main_part); };
  for (const Broken& broken : cases) {
    const std::size_t main = parts_of(broken);
    const bool alike = main > 1 && main == broken.parts.all.size() && broken.record->text("test") == "tension" &&
                       (clean.empty() || parts_of(*clean.front()) == main);
    if (alike)
      clean.push_back(&broken);
    else
      said.push_back(fragments_words(broken));
  }
  if (clean.size() == 1) said.push_back(fragments_words(*clean.front()));
  if (clean.size() > 1) {
    std::vector<std::pair<std::string, std::vector<std::string>>> shares;  // of the largest part, and with which planes
    for (const Broken* broken : clean) {
      const std::string share = percent(broken->parts.share(0), 1);
      const auto same = std::ranges::find(shares, share, &std::pair<std::string, std::vector<std::string>>::first);
      (same == shares.end() ? shares.emplace_back(share, std::vector<std::string>()) : *same)
          .second.push_back(planes_of(*broken->record));
    }
    std::vector<std::string> each;
    for (const auto& [share, planes] : shares) each.push_back(share + " with " + listed(planes) + " planes");
    std::vector<std::string> all;
    for (const Broken* broken : clean) all.push_back(planes_of(*broken->record));
    said.push_back(fmt::format("tension, {} planes: {} parts and nothing smaller; the largest has {}", listed(all),
                               count(static_cast<double>(parts_of(*clean.front()))), listed(each)));
  }
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
