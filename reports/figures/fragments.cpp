#include "reports/figures/fragments.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "engine/analysis/goodness.h"
#include "reports/text.h"

namespace reports {
namespace {

constexpr double large = 0.05;  // share of the volume of a part that is counted as one of the main ones

struct Rank {
  std::string_view name;
  render::Colour colour;
};
// From light to dark, so that grey print tells them apart.
constexpr std::array<Rank, 6> ranks{{{"largest", {0.965, 0.902, 0.741}},
                                     {"second", {0.514, 0.757, 0.925}},
                                     {"third", {0.878, 0.455, 0.145}},
                                     {"fourth", {0.086, 0.478, 0.345}},
                                     {"fifth and smaller", {0.420, 0.133, 0.376}},
                                     {"single particles", {0.110, 0.110, 0.130}}}};

// Of every part: single particles have the last, the others theirs by size.
std::vector<std::size_t> ranks_of(const analysis::Fragments& parts) {
  std::vector<std::size_t> found;
  std::size_t next = 0;
  for (const analysis::Fragment& f : parts.all)
    found.push_back(f.particles == 1 ? 5 : std::min<std::size_t>(next++, 4));
  return found;
}

std::vector<std::int32_t> numbers_of(const Broken& broken) {
  std::vector<std::int32_t> numbers;
  for (std::size_t k = 1; k < broken.parts.all.size(); ++k) numbers.push_back(broken.parts.all[k].particles);
  return numbers;
}

const dem::Table* last_snapshot(const dem::Record& record) {
  const dem::Table* last = nullptr;
  for (const dem::Table& table : record.tables)
    if (table.name.starts_with("snapshots/") && table.has("displacement")) last = &table;
  return last;
}

}  // namespace

Broken broken_of(const dem::Record& record, const SeriesCase& looks) {
  Broken broken{.record = &record,
                .label = looks.label,
                .id = looks.id,
                .colour = looks.colour,
                .line = looks.line,
                .parts = analysis::fragments_of(record),
                .place = {}};
  const auto rest = record.table("particles").real("position");
  broken.place.assign(rest.begin(), rest.end());
  if (const dem::Table* end = last_snapshot(record)) {
    const auto moved = end->real("displacement");
    for (std::size_t i = 0; i < broken.place.size(); ++i) broken.place[i] += moved[i];
  }
  return broken;
}

Picture fragments_picture(const Broken& broken, double apart, const std::array<render::Point, 2>& frame, int width) {
  const auto radius = broken.record->table("particles").real("radius");
  render::Point middle{};
  for (std::size_t k = 0; k < 3; ++k) middle[k] = 0.5 * (frame[0][k] + frame[1][k]);
  const std::vector<std::size_t> rank = ranks_of(broken.parts);
  Picture picture;
  picture.label = broken.label;
  render::Spheres spheres;
  render::Point reach{};
  for (std::size_t i = 0; i < radius.size(); ++i) {
    const auto part = static_cast<std::size_t>(broken.parts.of[i]);
    render::Point at{};
    for (std::size_t k = 0; k < 3; ++k)
      at[k] = broken.place[3 * i + k] + apart * (broken.parts.all[part].centre[k] - middle[k]);
    for (std::size_t k = 0; k < 3; ++k) reach[k] = std::max(reach[k], std::abs(at[k] - middle[k]) + radius[i]);
    spheres.centre.push_back(at);
    spheres.radius.push_back(radius[i]);
    spheres.colour.push_back(ranks[rank[part]].colour);
  }
  picture.scene.spheres.push_back(std::move(spheres));
  std::array<render::Point, 2> seen = frame;
  for (std::size_t k = 0; k < 3; ++k) {
    // What flew off is seen as well, unless it flew far.
    const double least = 0.5 * (frame[1][k] - frame[0][k]) * (1 + apart);
    const double half = std::clamp(reach[k], least, 1.5 * least);
    seen[0][k] = middle[k] - half;
    seen[1][k] = middle[k] + half;
  }
  picture.scene.camera.frame = seen;
  picture.scene.axes = true;
  picture.scene.width = width;
  picture.scene.height = static_cast<int>(
      std::lround(width * std::clamp((seen[1][2] - seen[0][2]) / (seen[1][0] - seen[0][0]), 0.5, 3.0)));
  std::array<std::size_t, ranks.size()> numbers{};
  std::array<double, ranks.size()> shares{};
  for (std::size_t k = 0; k < rank.size(); ++k) {
    ++numbers[rank[k]];
    shares[rank[k]] += broken.parts.share(k);
  }
  for (std::size_t r = 0; r < ranks.size(); ++r) {
    if (numbers[r] == 0) continue;
    const std::string share =
        r < 4 ? (shares[r] < 0.0005 ? "< 0.1 %" : percent(shares[r], 1)) : count(static_cast<double>(numbers[r]));
    picture.legend.push_back({ranks[r].colour, std::string(ranks[r].name), share});
  }
  return picture;
}

std::string key_values_words(const std::vector<Picture>& pictures) {
  const bool counts = std::ranges::any_of(pictures, [](const Picture& picture) {
    return std::ranges::any_of(picture.legend, [](const LegendEntry& entry) { return !entry.count.ends_with('%'); });
  });
  return counts ? "In the keys, percentages are of the volume; numbers without % are counts."
                : "Percentages are of the volume.";
}

std::optional<analysis::PowerLaw> size_law(const Broken& broken) { return analysis::fit_power_law(numbers_of(broken)); }

bool has_size_law(const std::vector<Broken>& cases) {
  return std::ranges::any_of(cases, [](const Broken& broken) { return size_law(broken).has_value(); });
}

render::Chart fragments_by_number(const std::vector<Broken>& cases) {
  render::Chart chart;
  chart.x.title = "Particles n of a part";
  chart.left.title = "Parts with n particles or more";
  chart.x.logarithmic = chart.left.logarithmic = true;
  double most = 10;
  for (std::size_t c = 0; c < cases.size(); ++c) {
    const Broken& broken = cases[c];
    std::vector<std::int32_t> numbers;
    for (const analysis::Fragment& f : broken.parts.all) numbers.push_back(f.particles);
    std::ranges::sort(numbers);
    render::Series series{.label = broken.label,
                          .x = {},
                          .y = {},
                          .colour = broken.colour,
                          .line = render::Line::none,
                          .marker = render::marker_style(c),
                          .y_error = {}};
    for (std::size_t i = 0; i < numbers.size(); ++i) {
      if (i > 0 && numbers[i] == numbers[i - 1]) continue;
      series.x.push_back(numbers[i]);
      series.y.push_back(static_cast<double>(numbers.size() - i));
    }
    most = std::max(most, static_cast<double>(numbers.size()));
    chart.series.push_back(series);
    if (const auto law = size_law(broken); law && law->holds()) {
      render::Series line{.label = "",
                          .x = {},
                          .y = {},
                          .colour = broken.colour,
                          .line = broken.line,
                          .y_error = {},
                          .name = broken.label + ", fit"};
      for (double n = law->least; n < 2e4; n *= 1.25) {
        const double parts =
            1 + static_cast<double>(law->fragments) * law->at_least(n);  // and the largest, as the points
        if (parts < 1.7) break;
        line.x.push_back(n);
        line.y.push_back(parts);
      }
      if (line.x.size() > 1) chart.series.push_back(line);
    }
  }
  chart.left.low = 0.7;
  chart.left.high = 1.6 * most;
  chart.x.low = 0.8;
  chart.legend = render::Chart::Legend::below;
  return chart;
}

render::Chart fragments_by_volume(const std::vector<Broken>& cases) {
  render::Chart chart;
  chart.x.title = "Diameter of a sphere of the part’s volume (mm)";
  chart.left.title = "Volume up to that size (%)";
  chart.x.logarithmic = true;
  chart.left.low = 0;
  chart.left.high = 100;
  for (const Broken& broken : cases) {
    render::Series series{
        .label = broken.label, .x = {}, .y = {}, .colour = broken.colour, .line = broken.line, .y_error = {}};
    double sum = 0;
    for (auto f = broken.parts.all.rbegin(); f != broken.parts.all.rend(); ++f) {
      const double diameter = 1e3 * std::cbrt(6 * f->volume / std::numbers::pi);
      series.x.push_back(diameter);
      series.y.push_back(100 * sum / broken.parts.volume);
      sum += f->volume;
      series.x.push_back(diameter);
      series.y.push_back(100 * sum / broken.parts.volume);
    }
    chart.series.push_back(series);
  }
  chart.legend = render::Chart::Legend::below;
  return chart;
}

TextTable fragments_table(const std::vector<Broken>& cases) {
  TextTable table{
      {"Case", "Parts above 5 % of the volume", "Largest (%)", "Second (%)", "Third (%)",
       "Other parts of two particles or more", "Single particles", "Exponent of the sizes (95 % interval)", "p"},
      {}};
  for (const Broken& broken : cases) {
    const std::size_t main = broken.parts.of_at_least(large), single = broken.parts.single();
    const auto law = size_law(broken);
    std::vector<double> shares;  // single particles are counted apart, as in the pictures
    for (std::size_t k = 0; k < broken.parts.all.size(); ++k)
      if (broken.parts.all[k].particles > 1) shares.push_back(broken.parts.share(k));
    const auto share = [&](std::size_t k) { return k < shares.size() ? fixed(100 * shares[k], 1) : std::string("–"); };
    table.rows.push_back({broken.label, std::to_string(main), share(0), share(1), share(2),
                          count(static_cast<double>(broken.parts.all.size() - single - main)),
                          count(static_cast<double>(single)),
                          !law           ? "too few parts or sizes"
                          : law->holds() ? estimate_text(law->exponent, 3, true)
                                         : "no power law",
                          law ? p_cell(law->p, analysis::law_samples) : "–"});
  }
  if (!has_size_law(cases)) {
    constexpr std::size_t of_the_law = 2;
    table.head.resize(table.head.size() - of_the_law);
    for (std::vector<std::string>& row : table.rows) row.resize(table.head.size());
  }
  return table;
}

std::string fragments_words(const Broken& broken) {
  const std::size_t main = broken.parts.of_at_least(large), single = broken.parts.single(),
                    smaller = broken.parts.all.size() - single - main;
  const auto counted = [](std::size_t n, std::string_view one) {
    return n == 0   ? fmt::format("no {}s", one)
           : n == 1 ? fmt::format("one {}", one)
                    : fmt::format("{} {}s", count(static_cast<double>(n)), one);
  };
  if (main == 1 && smaller + single == 0) return broken.label + ": still in one part";
  if (main == 0)
    return fmt::format("{}: {} of two particles or more, the largest with {} of the volume, and {}", broken.label,
                       counted(smaller, "part"), percent(broken.parts.share(0), 1), counted(single, "single particle"));
  if (main == 1)
    return fmt::format("{}: one part with {} of the volume, {} and {}", broken.label, percent(broken.parts.share(0), 1),
                       counted(smaller, "smaller part"), counted(single, "single particle"));
  return fmt::format("{}: {} above 5 % of the volume, the largest with {}, {} and {}", broken.label,
                     counted(main, "part"), percent(broken.parts.share(0), 1), counted(smaller, "smaller part"),
                     counted(single, "single particle"));
}

}  // namespace reports
