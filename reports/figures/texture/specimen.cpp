// Specimen by mineral (Zhao et al. 2021, Figs. 5 and 7c) and one grain cluster at each aspect ratio (Fig. 13).
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "reports/figures/table.h"
#include "reports/figures/texture/parts.h"
#include "reports/text.h"

namespace reports::texture {
namespace {

struct Grain {
  render::Point centre{}, axis{};
  double seed_radius = 0, semi_long = 0, semi_short = 0;
  render::Point own_axis{};  // of the grown grain, from its second moments
  double own_long = 0, own_short = 0;
  std::int32_t particles = 0, mineral = 0;
};

std::vector<Grain> grains_of(const dem::Record& record) {
  const dem::Table& table = record.table("grains");
  const auto centre = table.real("centre");
  const auto axis = table.real("axis");
  const auto radius = table.real("radius");
  const auto semi_long = table.real("semi_long");
  const auto semi_short = table.real("semi_short");
  const auto own_axis = table.real("own_axis"), own_long = table.real("own_long"), own_short = table.real("own_short");
  const auto particles = table.integer("particles");
  const auto mineral = table.integer("mineral");
  std::vector<Grain> grains(radius.size());
  for (std::size_t i = 0; i < grains.size(); ++i) {
    grains[i] = {{centre[3 * i], centre[3 * i + 1], centre[3 * i + 2]},
                 {axis[3 * i], axis[3 * i + 1], axis[3 * i + 2]},
                 radius[i],
                 semi_long[i],
                 semi_short[i],
                 {own_axis[3 * i], own_axis[3 * i + 1], own_axis[3 * i + 2]},
                 own_long[i],
                 own_short[i],
                 particles[i],
                 mineral[i]};
  }
  return grains;
}

// The grain that every panel shows: among those whose longest ellipsoid stays inside the specimen and whose seed is
// larger than that of 60 % and smaller than that of 95 % of all grains, the one nearest to the middle.
std::optional<std::size_t> chosen_grain(const std::vector<SeriesCase>& cases) {
  const Size size = size_of(*cases.front().record);
  const auto base = grains_of(*cases.front().record);
  const auto longest = grains_of(*cases.back().record);
  std::vector<double> radii;
  for (const Grain& grain : base) radii.push_back(grain.seed_radius);
  std::ranges::sort(radii);
  if (radii.empty()) return std::nullopt;
  const double low = radii[radii.size() * 60 / 100];
  const double high = radii[std::min(radii.size() - 1, radii.size() * 95 / 100)];
  std::optional<std::size_t> best;
  double best_distance = 0;
  for (std::size_t i = 0; i < std::min(base.size(), longest.size()); ++i) {
    const Grain& grain = base[i];
    if (grain.seed_radius < low || grain.seed_radius > high || grain.particles < 8) continue;
    const double off_axis = std::hypot(grain.centre[0], grain.centre[1]);
    const double off_middle = std::abs(grain.centre[2] - size.z_low - 0.5 * size.height);
    const bool inside =
        off_axis + longest[i].semi_long < 0.5 * size.diameter && off_middle + longest[i].semi_long < 0.5 * size.height;
    const double distance = std::hypot(off_axis, off_middle) + (inside ? 0 : size.height);
    if (!best || distance < best_distance) {
      best = i;
      best_distance = distance;
    }
  }
  return best;
}

render::Point along(const render::Point& from, const render::Point& direction, double distance) {
  return {from[0] + distance * direction[0], from[1] + distance * direction[1], from[2] + distance * direction[2]};
}

// The horizontal direction across the long axis of the ellipsoid.
render::Point view_of(const Grain& grain) {
  const double flat = std::hypot(grain.axis[0], grain.axis[1]);
  return flat > 1e-9 ? render::Point{grain.axis[1] / flat, -grain.axis[0] / flat, 0} : render::Point{0, -1, 0};
}

// Spheres of one grain, its long axis (red, dashed) and a short axis (gold, dashed), seen along the other short axis; where
// the long axis dips, the horizontal (grey) stands for the short axis.
Picture cluster_picture(const StudyResult& study, const SeriesCase& item, std::size_t index, double reach, bool dips) {
  const dem::Record& record = *item.record;
  const Grain grain = grains_of(record)[index];
  const render::Spheres all = particles_by_mineral(study, record);
  const auto grain_of = record.table("particles").integer("grain");
  render::Spheres cluster;
  for (std::size_t i = 0; i < all.centre.size(); ++i) {
    if (grain_of[i] != static_cast<std::int32_t>(index)) continue;
    cluster.centre.push_back(all.centre[i]);
    cluster.radius.push_back(all.radius[i]);
    cluster.colour.push_back(all.colour[i]);
  }
  render::Scene scene;
  scene.spheres.push_back(std::move(cluster));
  // Seen along the horizontal direction across the long axis; lines lie in front of the spheres.
  const render::Point view = view_of(grain);
  const render::Point& a = grain.axis;
  const render::Point across{view[1] * a[2] - view[2] * a[1], view[2] * a[0] - view[0] * a[2],
                             view[0] * a[1] - view[1] * a[0]};
  const render::Point front = along(grain.centre, view, -1.2 * reach);
  scene.lines.push_back({{along(front, a, -grain.semi_long), along(front, a, grain.semi_long)},
                         {0.75, 0.05, 0.05},
                         1.8,
                         render::Line::dash});
  const render::Point level{-view[1], view[0], 0};
  const render::Point& other = dips ? level : across;
  const double length = dips ? grain.semi_long : grain.semi_short;
  const render::Colour other_colour{0.74, 0.52, 0.0};
  scene.lines.push_back(
      {{along(front, other, -length), along(front, other, length)}, other_colour, 1.8, render::Line::dash});
  // What growth made of the ellipsoid: the own axis of the spheres, as seen from here.
  const render::Colour own_colour{0, 0, 0};
  scene.lines.push_back({{along(front, grain.own_axis, -grain.own_long), along(front, grain.own_axis, grain.own_long)},
                         own_colour,
                         1.2,
                         render::Line::solid});
  scene.camera.direction = view;
  scene.camera.frame = {{{grain.centre[0] - reach, grain.centre[1] - reach, grain.centre[2] - 0.75 * reach},
                         {grain.centre[0] + reach, grain.centre[1] + reach, grain.centre[2] + 0.75 * reach}}};
  scene.axes = true;
  scene.width = 640;
  scene.height = 480;
  return {.scene = std::move(scene),
          .label = fmt::format("{} ({} particles)", item.label, grain.particles),
          .legend = {{{0.75, 0.05, 0.05}, "long axis of the ellipsoid"},
                     {other_colour, dips ? "horizontal" : "short axis of the ellipsoid"},
                     {own_colour, "long axis of the grown grain"}}};
}

// Angle between the own axis of a grown grain and the plane of its picture: an axis that points at the reader looks short.
std::string out_of_plane(const Grain& grain) {
  const render::Point view = view_of(grain);
  const double towards =
      std::abs(grain.own_axis[0] * view[0] + grain.own_axis[1] * view[1] + grain.own_axis[2] * view[2]);
  return fixed(std::asin(std::min(1.0, towards)) * 180 / std::numbers::pi, 0) + "°";
}

// Of the particles of a grain, in a unit of its own.
double cluster_volume(const dem::Record& record, std::size_t index) {
  const dem::Table& particles = record.table("particles");
  const auto grain = particles.integer("grain");
  const auto radius = particles.real("radius");
  double volume = 0;
  for (std::size_t i = 0; i < grain.size(); ++i)
    if (grain[i] == static_cast<std::int32_t>(index)) volume += radius[i] * radius[i] * radius[i];
  return volume;
}

// By volume, of the particles.
std::string mineral_shares(const dem::Record& record) {
  const auto names = minerals_of(record);
  const dem::Table& particles = record.table("particles");
  const auto mineral = particles.integer("mineral");
  const auto radius = particles.real("radius");
  std::vector<double> volume(names.size(), 0);
  double all = 0;
  for (std::size_t i = 0; i < mineral.size(); ++i) {
    const double cube = radius[i] * radius[i] * radius[i];
    volume[static_cast<std::size_t>(mineral[i])] += cube;
    all += cube;
  }
  std::vector<std::string> parts;
  for (std::size_t m = 0; m < names.size(); ++m) parts.push_back(percent(volume[m] / all, 0) + " " + names[m]);
  return listed(parts);
}

}  // namespace

FigureContent specimen(const StudyResult& study) {
  FigureContent content;
  content.statement = "The volume is 17 % plagioclase, 48 % alkali feldspar, 29 % quartz and 6 % biotite (Table 4).";
  content.rows = {"share_plagioclase", "share_alkali_feldspar", "share_quartz", "share_biotite"};
  const auto cases = swept(study, test_compression);
  if (auto missing = missing_cases(study, test_compression)) content.panels.push_back(*missing);
  if (cases.empty()) return content;
  const dem::Record& base = *cases.front().record;
  const int width = 420;
  const std::string shares = mineral_shares(base);
  content.panels.push_back({.id = "whole",
                            .caption = "The whole specimen.",
                            .alt = "Cylinder of " + count(static_cast<double>(base.table("particles").rows())) +
                                   " spheres coloured by mineral: " + shares + " by volume.",
                            .content = Picture{.scene = specimen_scene(study, base, width),
                                               .label = cases.front().label,
                                               .legend = mineral_legend(study, base)},
                            .per_row = 4});
  for (const SeriesCase& item : cases) {
    content.panels.push_back(
        {.id = "section_" + item.id,
         .caption = "Longitudinal section.",
         .alt = "Section along the axis at " + item.label + ": " + mineral_shares(*item.record) + " by volume.",
         .content = Picture{.scene = section_scene(study, *item.record, width),
                            .label = item.label,
                            .legend = mineral_legend(study, *item.record)},
         .per_row = 4});
  }
  const Size size = size_of(base);
  content.finding = fmt::format("{} particles in {} grains, {:g} mm × {:g} mm. By volume, the particles at {} are {}.",
                                count(static_cast<double>(base.table("particles").rows())),
                                count(static_cast<double>(base.table("grains").rows())), 1e3 * size.diameter,
                                1e3 * size.height, cases.front().label, shares);
  return content;
}

FigureContent grain_cluster(const StudyResult& study) {
  FigureContent content;
  content.statement =
      "One grain at aspect ratios 1, 2 and 3: ellipsoids of the same volume, longer with the aspect ratio (Eqs. 5 and "
      "6).";
  const auto cases = swept(study, test_compression);
  if (auto missing = missing_cases(study, test_compression)) content.panels.push_back(*missing);
  if (cases.empty()) return content;
  const auto index = chosen_grain(cases);
  if (!index) {
    content.panels.push_back(note_panel("none", "Grain cluster.", "No grain of this specimen has eight particles."));
    return content;
  }
  double reach = 0;
  std::vector<std::string> counts;
  for (const SeriesCase& item : cases) reach = std::max(reach, 1.45 * grains_of(*item.record)[*index].semi_long);
  for (const SeriesCase& item : cases) {
    const Grain grain = grains_of(*item.record)[*index];
    const std::string mineral = minerals_of(*item.record).at(static_cast<std::size_t>(grain.mineral));
    counts.push_back(fmt::format("{} particles at {}", grain.particles, item.label));
    content.panels.push_back(
        {.id = item.id,
         .caption = fmt::format(
             "Grain {}, {}; half axes of its ellipsoid {:.2f} and {:.2f} mm; principal half axes of the grown grain "
             "{:.2f} and {:.2f} mm, the long one at {} to the plane of the picture.",
             *index, mineral, 1e3 * grain.semi_long, 1e3 * grain.semi_short, 1e3 * grain.own_long,
             1e3 * grain.own_short, out_of_plane(grain)),
         .alt = fmt::format(
             "Cluster of {} spheres of grain {} ({}) with its long axis of {:.2f} mm and short axis of {:.2f} mm.",
             grain.particles, *index, mineral, 2e3 * grain.semi_long, 2e3 * grain.semi_short),
         .content = cluster_picture(study, item, *index, reach, swept_axis(study).id == "dip"),
         .per_row = 3});
  }
  // No verdict: the ellipsoids follow the formulas by construction, and one grain says nothing of what growth makes of them.
  std::vector<std::string> volumes;
  const double first = cluster_volume(*cases.front().record, *index);
  for (std::size_t i = 1; i < cases.size(); ++i)
    volumes.push_back(number(cluster_volume(*cases[i].record, *index) / first, 2) + " (" + cases[i].label + ")");
  content.finding = fmt::format("All ellipsoids have the same volume by construction. Grown, grain {} has {}", *index,
                                listed(counts));
  if (cases.size() > 1)
    content.finding += fmt::format(": {} times its volume at {}", listed(volumes), cases.front().label);
  content.finding += fmt::format(
      ". Measured by second moments along and across the set axis, which is another measure than the principal half "
      "axes, "
      "the mean aspect ratio over all grains is {}.",
      by_case(cases, quantity::realised_ar, 3));
  return content;
}

FigureContent dip_clusters(const StudyResult& study) {
  FigureContent content = grain_cluster(study);
  content.statement = "One grain of aspect ratio 2 with its long axis at dips of 0° to 90°.";
  return content;
}

}  // namespace reports::texture
