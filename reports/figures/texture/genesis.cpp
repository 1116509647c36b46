// How a specimen is made: seeds, packing, masks, growth, contact groups (Zhao et al. 2021, Figs. 3 and 5).
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "reports/figures/table.h"
#include "reports/figures/texture/parts.h"
#include "reports/text.h"

namespace reports::texture {
namespace {

constexpr int narrow = 320;                            // px, of pictures beside each other
const render::Colour gap_colour = render::palette(0);  // white, as in the paper, is too near the light minerals
const render::Colour grey{0.80, 0.82, 0.84};
const render::Colour joint_colour = render::palette(0), bond_colour = render::palette(2);  // as the paper's Fig. 5h

// Particles after `round` rounds of growth: those without a grain yet have a colour of their own.
render::Spheres after_round(const StudyResult& study, const dem::Record& record, std::int32_t round) {
  render::Spheres spheres = particles_by_mineral(study, record);
  const auto claimed = record.table("particles").integer("growth_round");
  for (std::size_t i = 0; i < claimed.size(); ++i) {
    if (claimed[i] > round) spheres.colour[i] = gap_colour;
  }
  return spheres;
}

// "AR 1, seed 1": which of the specimens is shown, where there are several.
std::string shown_words(const StudyResult& study, const dem::Record& record) {
  if (study.cases.size() < 2) return {};
  std::string words = "AR " + shortest(record.number("aspect_ratio"));
  if (const auto* seed = dem::find_value(record.parameters, "seed")) words += ", seed " + parameter_text(*seed);
  return words;
}

std::int32_t rounds_of(const dem::Record& record) {
  const auto claimed = record.table("particles").integer("growth_round");
  return claimed.empty() ? 0 : std::ranges::max(claimed);
}

std::size_t gaps_after(const dem::Record& record, std::int32_t round) {
  return static_cast<std::size_t>(std::ranges::count_if(record.table("particles").integer("growth_round"),
                                                        [&](std::int32_t r) { return r > round; }));
}

render::Spheres seeds_of(const StudyResult& study, const dem::Record& record) {
  const dem::Table& grains = record.table("grains");
  const auto centre = grains.real("centre"), radius = grains.real("radius");
  const auto mineral = grains.integer("mineral");
  const auto names = minerals_of(record);
  render::Spheres spheres;
  for (std::size_t g = 0; g < radius.size(); ++g) {
    spheres.centre.push_back({centre[3 * g], centre[3 * g + 1], centre[3 * g + 2]});
    spheres.radius.push_back(radius[g]);
    spheres.colour.push_back(mineral_colour(study, names.at(static_cast<std::size_t>(mineral[g]))));
  }
  return spheres;
}

render::Scene scene_of(const StudyResult& study, const dem::Record& record, render::Spheres spheres, bool section) {
  render::Scene scene = section ? section_scene(study, record, narrow) : specimen_scene(study, record, narrow);
  scene.spheres = {std::move(spheres)};
  return scene;
}

std::vector<LegendEntry> with_gaps(const StudyResult& study, const dem::Record& record) {
  std::vector<LegendEntry> legend = mineral_legend(study, record);
  legend.push_back({gap_colour, "no grain yet"});
  return legend;
}

// A square window around the middle of the axis that shows a few grains.
std::array<render::Point, 2> window(const dem::Record& record) {
  const auto radius = record.table("grains").real("radius");
  const double mean =
      std::accumulate(radius.begin(), radius.end(), 0.0) / static_cast<double>(std::max<std::size_t>(1, radius.size()));
  const Size size = size_of(record);
  const double half = std::min(4.5 * mean, 0.5 * size.diameter), middle = size.z_low + 0.5 * size.height;
  return {{{-half, -half, middle - half}, {half, half, middle + half}}};
}

// Whether a round of growth assigned a particle that the section shows in the frame.
bool changes_in(const dem::Record& record, const std::array<render::Point, 2>& frame, std::int32_t round) {
  const dem::Table& particles = record.table("particles");
  const auto position = particles.real("position"), radius = particles.real("radius");
  const auto claimed = particles.integer("growth_round");
  for (std::size_t i = 0; i < radius.size(); ++i) {
    const bool inside = position[3 * i] > frame[0][0] && position[3 * i] < frame[1][0] &&
                        position[3 * i + 2] > frame[0][2] && position[3 * i + 2] < frame[1][2];
    if (claimed[i] == round && inside && std::abs(position[3 * i + 1]) < radius[i]) return true;
  }
  return false;
}

/// Of thin lines on white, for which the minerals are too light: six, apart for every reader and in grey.
render::Colour line_colour(std::size_t group) {
  constexpr std::array<render::Colour, 6> colours{{{0.459, 0.353, 0.008},
                                                   {0.898, 0.455, 0.145},
                                                   {0.224, 0.486, 0.718},
                                                   {0.188, 0.129, 0.388},
                                                   {0.545, 0.020, 0.239},
                                                   {0.043, 0.031, 0.000}}};
  return colours[group % colours.size()];
}

/// Contacts whose middle lies near the section y = 0, as lines between the centres.
struct ContactLines {
  std::vector<render::Polyline> lines;
  std::vector<std::size_t> numbers;  ///< of all contacts, by class
};
template <class ClassOf>
ContactLines contact_lines(const dem::Record& record, const std::vector<render::Colour>& colours, ClassOf class_of) {
  const dem::Table& particles = record.table("particles");
  const auto position = particles.real("position");
  const auto pair = record.table("contacts").integer("pair");
  const double reach = 0.5 * mean_diameter(record);
  ContactLines result{{}, std::vector<std::size_t>(colours.size(), 0)};
  for (std::size_t c = 0; c < pair.size() / 2; ++c) {
    const auto i = static_cast<std::size_t>(pair[2 * c]), j = static_cast<std::size_t>(pair[2 * c + 1]);
    const std::size_t k = class_of(c, i, j);
    ++result.numbers[k];
    if (std::abs(position[3 * i + 1] + position[3 * j + 1]) > 2 * reach) continue;
    result.lines.push_back(
        {{{position[3 * i], 0, position[3 * i + 2]}, {position[3 * j], 0, position[3 * j + 2]}}, colours[k], 1.3});
  }
  return result;
}

Picture contacts_picture(const StudyResult& study, const dem::Record& record, const ContactLines& contacts,
                         const std::vector<LegendEntry>& legend, const std::string& label, bool zoomed) {
  render::Scene scene = specimen_scene(study, record, narrow);
  scene.spheres.clear();
  scene.lines = contacts.lines;
  if (zoomed) {
    scene.camera.frame = window(record);
    scene.height = scene.width;
    for (render::Polyline& line : scene.lines) line.width = 2.4;
  }
  return {.scene = std::move(scene), .label = label, .legend = legend};
}
}  // namespace

FigureContent genesis_steps(const StudyResult& study) {
  FigureContent content;
  content.statement =
      "Grain seeds are spread at random, a specimen of small particles is made, ellipsoids mask the particles of each "
      "grain, and grains grow along contacts until every particle belongs to one. The specimen has 36 528 particles.";
  content.rows = {"texture_particles"};
  if (auto missing = missing_cases(study, test_genesis)) content.panels.push_back(*missing);
  const dem::Record* record = first_specimen(study);
  if (!record) return content;
  const auto particles = static_cast<double>(record->table("particles").rows());
  const auto grains = static_cast<double>(record->table("grains").rows());
  const auto gaps = static_cast<double>(gaps_after(*record, 0));
  const auto add = [&](std::string id, std::string caption, std::string alt, Picture picture) {
    content.panels.push_back({.id = std::move(id),
                              .caption = std::move(caption),
                              .alt = std::move(alt),
                              .content = std::move(picture),
                              .per_row = 4});
  };
  render::Scene seeds = scene_of(study, *record, seeds_of(study, *record), false);
  const auto frame = frame_of(size_of(*record));
  seeds.outline = {render::Outline::Shape::cylinder, frame[0], frame[1]};
  add("seeds", "Grain seeds in the core.", count(grains) + " spheres of four minerals spread through the cylinder.",
      {.scene = std::move(seeds), .label = count(grains) + " grain seeds", .legend = mineral_legend(study, *record)});
  render::Spheres bare = particles_by_mineral(study, *record);
  std::ranges::fill(bare.colour, grey);
  add("packing", "Particles packed in the cylinder.",
      count(particles) + " particles packed in the cylinder, of no mineral yet.",
      {.scene = scene_of(study, *record, std::move(bare), false),
       .label = count(particles) + " particles",
       .legend = {}});
  add("masked", "Masked by ellipsoids.",
      percent(gaps / particles) + " of the particles are in no ellipsoid and drawn in blue.",
      {.scene = scene_of(study, *record, after_round(study, *record, 0), false),
       .label = "after masking: " + count(gaps) + " particles without a grain",
       .legend = with_gaps(study, *record)});
  add("masked_section", "Masked specimen, cut along the axis.", "Gap particles, in blue, lie between the grains.",
      {.scene = scene_of(study, *record, after_round(study, *record, 0), true),
       .label = "section",
       .legend = with_gaps(study, *record)});
  add("grown", "After growth.", "Every particle belongs to a grain.",
      {.scene = specimen_scene(study, *record, narrow),
       .label = count(grains) + " grains",
       .legend = mineral_legend(study, *record)});
  add("grown_section", "Grown specimen, cut along the axis.", "Grains of four minerals fill the section.",
      {.scene = section_scene(study, *record, narrow), .label = "section", .legend = mineral_legend(study, *record)});
  const std::string which = shown_words(study, *record);
  content.finding = which.empty() ? "" : "Shown: " + which + ". ";
  content.finding += fmt::format(
      "{} grain seeds and {} particles; ellipsoids mask {} of the particles, and {} rounds of growth assign the other "
      "{}; "
      "the coordination number is {}, the porosity {}.",
      count(grains), count(particles), percent(1 - gaps / particles), rounds_of(*record), count(gaps),
      number(record->value(quantity::coordination), 3), number(record->value(quantity::porosity), 4));
  return content;
}

FigureContent genesis_growth(const StudyResult& study) {
  FigureContent content;
  content.statement =
      "A gap particle in contact with a particle of a grain takes its group; the step is repeated until every particle "
      "belongs to a grain.";
  const dem::Record* record = first_specimen(study);
  if (!record) return content;
  const std::int32_t rounds = rounds_of(*record);
  std::vector<std::int32_t> shown{0};
  if (rounds > 1) shown.push_back(1);
  // The last round may change nothing that the section shows: then the table alone tells of it.
  const auto frame = window(*record);
  const bool seen = rounds == 1 || changes_in(*record, frame, rounds);
  if (rounds > 0 && seen) shown.push_back(rounds);
  for (const std::int32_t round : shown) {
    render::Scene scene = section_scene(study, *record, 480);
    scene.spheres = {after_round(study, *record, round)};
    scene.camera.frame = frame;
    scene.height = scene.width;
    const std::string left = count(static_cast<double>(gaps_after(*record, round)));
    content.panels.push_back(
        {.id = fmt::format("round_{}", round),
         .caption = round == 0 ? "After masking; a detail of the section."
                               : fmt::format("After round {} of growth; the same detail.", round),
         .alt = fmt::format(
             "A few grains in the middle of the section; {} particles of the specimen are without a grain.", left),
         .content = Picture{.scene = std::move(scene), .label = left + " left", .legend = with_gaps(study, *record)},
         .per_row = 3});
  }
  TextTable table{{"Round of growth", "Particles assigned", "Particles left"}, {}};
  const auto all = record->table("particles").rows();
  for (std::int32_t round = 0; round <= rounds; ++round) {
    const std::size_t before = round == 0 ? all : gaps_after(*record, round - 1), after = gaps_after(*record, round);
    table.rows.push_back({round == 0 ? "masking" : std::to_string(round), count(static_cast<double>(before - after)),
                          count(static_cast<double>(after))});
  }
  content.panels.push_back(
      {.id = "rounds", .caption = "Particles by round of growth.", .alt = "", .content = table, .per_row = 1});
  content.agreement = gaps_after(*record, rounds) == 0 ? Agreement::agrees : Agreement::disagrees;
  const std::string which = shown_words(study, *record);
  content.finding =
      fmt::format("Growth took {} {}{}; the first assigned {} of the gap particles.", rounds,
                  rounds == 1 ? "round" : "rounds", which.empty() ? "" : " (" + which + ")",
                  percent(rounds == 0 ? 0.0
                                      : 1 - static_cast<double>(gaps_after(*record, 1)) /
                                                static_cast<double>(std::max<std::size_t>(1, gaps_after(*record, 0)))));
  return content;
}

FigureContent genesis_contacts(const StudyResult& study) {
  FigureContent content;
  content.statement =
      "Intra-grain contacts take the flat joint model, inter-grain contacts the parallel bond model; their properties "
      "follow from the minerals of the two particles.";
  const dem::Record* record = first_specimen(study);
  if (!record) return content;
  const auto grain = record->table("particles").integer("grain"),
             mineral = record->table("particles").integer("mineral");
  const auto kind = record->table("contacts").integer("kind");
  const auto names = minerals_of(*record);
  std::vector<render::Colour> colours;
  for (std::size_t k = 0; k < names.size() + 2; ++k) colours.push_back(line_colour(k));
  const ContactLines groups = contact_lines(*record, colours, [&](std::size_t, std::size_t i, std::size_t j) {
    if (grain[i] == grain[j]) return static_cast<std::size_t>(mineral[i]);
    return names.size() + (mineral[i] == mineral[j] ? 0 : 1);
  });
  const ContactLines laws =
      contact_lines(*record, {joint_colour, bond_colour},
                    [&](std::size_t c, std::size_t, std::size_t) { return static_cast<std::size_t>(kind[c]); });
  const auto all = static_cast<double>(kind.size());
  std::vector<LegendEntry> group_legend, law_legend;
  for (std::size_t k = 0; k < names.size(); ++k) {
    group_legend.push_back({colours[k], "inside " + names[k], count(static_cast<double>(groups.numbers[k]))});
  }
  group_legend.push_back({colours[names.size()], "between grains of one mineral",
                          count(static_cast<double>(groups.numbers[names.size()]))});
  group_legend.push_back(
      {colours[names.size() + 1], "between minerals", count(static_cast<double>(groups.numbers[names.size() + 1]))});
  law_legend = {{joint_colour, "flat joint", count(static_cast<double>(laws.numbers[0]))},
                {bond_colour, "parallel bond", count(static_cast<double>(laws.numbers[1]))}};
  const double inter = static_cast<double>(groups.numbers[names.size()] + groups.numbers[names.size() + 1]) / all;
  const std::string by_group = percent(inter) + " of the contacts are inter-grain contacts.";
  const std::string by_law =
      percent(static_cast<double>(laws.numbers[1]) / all) + " of the contacts are parallel bonds.";
  // The counts are those of all contacts: the enlarged pictures have the key alone.
  const auto add = [&](const char* id, const ContactLines& lines, std::vector<LegendEntry> legend, const char* label,
                       const std::string& by, bool near) {
    if (near) {
      for (LegendEntry& one : legend) one.count.clear();
    }
    content.panels.push_back({.id = id,
                              .caption = near ? "A few grains of the section."
                                              : "Contacts near the section; the counts are of all contacts.",
                              .alt = by,
                              .content = contacts_picture(study, *record, lines, legend, label, near),
                              .per_row = 2});
  };
  add("groups", groups, group_legend, "contact groups", by_group, false);
  add("laws", laws, law_legend, "contact laws", by_law, false);
  add("groups_near", groups, group_legend, "contact groups, enlarged", by_group, true);
  add("laws_near", laws, law_legend, "contact laws, enlarged", by_law, true);
  const bool same = groups.numbers[names.size()] + groups.numbers[names.size() + 1] == laws.numbers[1];
  content.agreement = same ? Agreement::agrees : Agreement::disagrees;
  const std::string which = shown_words(study, *record);
  content.finding = (which.empty() ? "" : "Shown: " + which + ". ") + by_group + " " +
                    (same ? "All of them, and no other contact, are parallel bonds." : by_law);
  return content;
}
}  // namespace reports::texture
