#include "tests/support/golden.h"
#include "render/compare.h"

#include <doctest/doctest.h>

#include <cstdlib>

#include "render/png.h"

namespace golden {
namespace {

namespace fs = std::filesystem;

const render::Provenance facts{{"Title", "golden picture"}, {"Engine", "test"}};

/// Differences, four times as strong, dark on white.
void write_difference(const fs::path& a, const fs::path& b, const fs::path& to) {
  const render::Image one = render::read_png(a), two = render::read_png(b);
  render::Image difference(one.width, one.height);
  for (std::size_t i = 0; i < one.rgb.size(); ++i)
    difference.rgb[i] = static_cast<std::uint8_t>(255 - std::min(255, 4 * std::abs(int{one.rgb[i]} - int{two.rgb[i]})));
  render::write_png(difference, to, {}, render::Content::drawing);
}

void compare(const std::string& name, const fs::path& candidate, const Threshold& threshold) {
  const fs::path baseline = fs::path(DEM_GOLDEN_BASELINES) / (name + ".png");
  if (!fs::exists(baseline)) {
    FAIL_CHECK("no baseline " << baseline.string() << "; the candidate is " << candidate.string()
                              << ": look at it, then copy it there");
    return;
  }
  const render::ImageDifference found = render::compare_png(baseline, candidate);
  if (found.same_size && found.mean <= threshold.mean && found.worst <= threshold.worst) {
    fs::remove(candidate);
    return;
  }
  const fs::path difference = candidate.parent_path() / (name + ".difference.png");
  if (found.same_size) write_difference(baseline, candidate, difference);
  FAIL_CHECK(name << " differs from " << baseline.string() << (found.same_size ? "" : " in size") << ": mean "
                  << found.mean << " (allowed " << threshold.mean << "), worst block " << found.worst << " (allowed "
                  << threshold.worst << "); candidate " << candidate.string() << ", difference "
                  << difference.string());
}

fs::path candidate_of(const std::string& name) { return fs::path(DEM_GOLDEN_OUT) / (name + ".png"); }

}  // namespace

render::Canvas& canvas() {
  static render::Canvas one;
  return one;
}

const fs::path& scratch() {
  static const fs::path folder = [] {
    const fs::path made = fs::path(DEM_GOLDEN_OUT) / "scratch";
    fs::remove_all(made);
    fs::create_directories(made);
    return made;
  }();
  return folder;
}

void picture(const std::string& name, const render::Chart& chart, Threshold threshold) {
  canvas().draw(chart, candidate_of(name), {}, facts);
  compare(name, candidate_of(name), threshold);
}

void picture(const std::string& name, const render::Scene& scene, Threshold threshold) {
  canvas().draw(scene, candidate_of(name), facts);
  compare(name, candidate_of(name), threshold);
}

}  // namespace golden
