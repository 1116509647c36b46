#include "reports/figures/texture/failed.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <set>

#include "reports/figures/texture/parts.h"
#include "reports/text.h"

namespace reports::texture {
namespace {

constexpr std::array breaking{test_compression, test_tension,   test_loops, test_brazilian,
                              test_bending,     test_half_disc, test_shear};

// Of the tests that have one specimen each or a parameter of their own.
std::vector<SeriesCase> of_the_trade(const StudyResult& rock, std::string_view test) {
  if (test == test_brazilian) {
    std::vector<SeriesCase> cases = discs_of(rock);
    for (SeriesCase& item : cases) item.label = (item.value > 0 ? "disc in " : "disc between ") + item.label;
    return cases;
  }
  if (test == test_bending) {
    std::vector<SeriesCase> cases = series_of(rock, test, parameter::notch);
    for (SeriesCase& item : cases)
      item.label = item.value > 0 ? "bar with a notch of " + shortest(item.value) + " W" : "bar without a notch";
    return cases;
  }
  if (test == test_shear) {
    std::vector<SeriesCase> cases = series_of(rock, test, parameter::normal_stress);
    for (SeriesCase& item : cases) item.label = "block at " + item.label;
    return cases;
  }
  std::vector<SeriesCase> cases = swept(rock, test);
  if (cases.size() == 1) cases.front().label = test == test_half_disc ? "half disc" : words(test);
  return cases;
}

// Each mineral alone, without pressure.
std::vector<SeriesCase> minerals_alone(const StudyResult& study) {
  std::vector<SeriesCase> found;
  for (const std::string& mineral : minerals_tested(study)) {
    auto cases = series_of(of_mineral(study, mineral), test_compression, parameter::confining_pressure);
    if (cases.empty()) continue;
    cases.front().label = mineral;
    cases.front().id = mineral;
    std::ranges::replace(cases.front().id, ' ', '_');
    found.push_back(std::move(cases.front()));
  }
  return found;
}

}  // namespace

std::vector<SeriesCase> discs_of(const StudyResult& study) {
  std::vector<SeriesCase> cases = series_of(of_mineral(study, ""), test_brazilian, parameter::jaw_ratio);
  for (SeriesCase& item : cases)
    item.label = item.value > 0 ? "jaws of " + shortest(item.value) + " R" : "flat platens";
  return cases;
}

std::vector<SeriesCase> failed(const StudyResult& study) {
  const StudyResult rock = of_mineral(study, "");
  std::vector<SeriesCase> all = swept_by_test(rock, test_compression);
  std::set<std::string_view> tests;
  for (const CaseResult& one : rock.cases) tests.insert(one.test());
  for (const std::string_view test : {test_loops, test_brazilian, test_bending, test_half_disc, test_shear}) {
    for (SeriesCase& item : of_the_trade(rock, test)) {
      if (tests.size() > 1) item.id = std::string(test) + "_" + item.id;
      all.push_back(std::move(item));
    }
  }
  if (const auto pulled = swept_by_test(rock, test_tension); !pulled.empty()) {
    all.push_back(pulled.front());
    all.back().label = tension_label(rock, pulled.front());
    all.back().id = "tension";
  }
  std::ranges::move(minerals_alone(study), std::back_inserter(all));
  for (std::size_t i = 0; i < all.size(); ++i) {
    const bool tension = all[i].id == "tension";
    all[i].colour = tension ? render::Colour{0.35, 0.35, 0.35} : render::palette(i);
    all[i].line = render::line_style(i);
  }
  return all;
}

void add_missing_failed(FigureContent& content, const StudyResult& study) {
  for (const std::string_view test : breaking) add_missing(content, study, {test});
}

int pictures_per_row(const std::vector<SeriesCase>& cases) {
  const bool wide = std::ranges::any_of(cases, [](const SeriesCase& item) {
    const Size size = size_of(*item.record);
    return size.diameter > 1.5 * size.height;
  });
  return wide ? 2 : cases.size() <= 3 ? 3 : 4;
}

bool is_of_cylinder(const dem::Record& record) {
  const std::string test = record.text("test");
  return test == test_compression || test == test_tension || test == test_loops || test == test_genesis;
}

render::Outline outline_of(const dem::Record& record) {
  const Size size = size_of(record);
  const double half = 0.5 * size.diameter, top = size.z_low + size.height;
  if (is_of_cylinder(record)) return {render::Outline::Shape::cylinder, {-half, -half, size.z_low}, {half, half, top}};
  const dem::Table& particles = record.table("particles");
  const auto position = particles.real("position"), radius = particles.real("radius");
  double reach = 0;
  for (std::size_t i = 0; i < radius.size(); ++i) reach = std::max(reach, std::abs(position[3 * i + 1]) + radius[i]);
  const auto shape = record.text("test") == test_brazilian ? render::Outline::Shape::disc : render::Outline::Shape::box;
  return {shape, {-half, -reach, size.z_low}, {half, reach, top}};
}

std::string_view load_words(const dem::Record& record) {
  return record.text("test") == test_shear ? "the shear is along x, the normal stress along z" : "the load is along z";
}

}  // namespace reports::texture
