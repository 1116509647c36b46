#pragma once
// Colours, crack classes and scenes of the grain texture model, as its figures share them.
#include <array>
#include <limits>
#include <string>
#include <vector>

#include "reports/figures/parts.h"
#include "reports/granite.h"

namespace reports::texture {

/// The parameter that the scenario sweeps: the one of aspect ratio, dip and confining pressure with most values.
const dem::Parameter& swept_axis(const StudyResult& study);
/// Cases of a test along it.
std::vector<SeriesCase> swept(const StudyResult& study, std::string_view test);
/// The same for figures of several tests: where nothing else differs, the label is that of the test.
std::vector<SeriesCase> swept_by_test(const StudyResult& study, std::string_view test);
/// The first specimen of a scenario that makes them without loading; nullptr when there is none.
const dem::Record* first_specimen(const StudyResult& study);
/// The four classes of cracks, in the order of every legend. Their colours stay apart for every reader and in grey print
/// (lightness 45, 0, 33, 60), from each other and from those of the minerals.
struct CrackClass {
  std::string_view id, name;
  int place, mode;  ///< as in the table cracks
  render::Colour colour;
  dem::Quantity number;  ///< of the record's results
};
const std::array<CrackClass, 4>& crack_classes();

/// "at AR 2"; "in compression", where the label is that of the test.
std::string at_case(const SeriesCase& item);
/// A direct tension beside compressions: "direct tension, AR 1"; without its place where the pressure is swept, which it has not.
std::string tension_label(const StudyResult& study, const SeriesCase& item);

/// Names of the minerals of a record by index.
std::vector<std::string> minerals_of(const dem::Record& record);
/// Its colour: the scenario's mineral[].colour, else by its place in the scenario's list: for Lac du Bonnet granite those
/// of the paper.
render::Colour mineral_colour(const StudyResult& study, std::string_view mineral);

struct Size {
  double diameter = 0, height = 0;  ///< m
  double z_low = 0;                 ///< where the specimen stands
};
Size size_of(const dem::Record& record);

/// Bounds of the specimen, for cameras.
std::array<render::Point, 2> frame_of(const Size& size);
double mean_diameter(const dem::Record& record);  ///< of the particles, m

/// Particles as spheres, a tone a grain so that grains of one mineral can be told apart.
render::Spheres particles_by_mineral(const StudyResult& study, const dem::Record& record);

/// A scene of the whole specimen, seen along y, with the frame fixed to its size so that cases share one scale.
render::Scene specimen_scene(const StudyResult& study, const dem::Record& record, int width);
/// The same, cut by the plane y = 0 of its axis.
render::Scene section_scene(const StudyResult& study, const dem::Record& record, int width);

/// The first `count` cracks of a record as discs `scale` times their size, or as traces on the
/// plane y = 0: cracks within half a mean particle diameter of it.
std::vector<render::Discs> crack_discs(const dem::Record& record, std::size_t count, double scale);
std::vector<render::Polyline> crack_traces(const dem::Record& record, std::size_t count, double width);
std::array<std::size_t, 4> crack_numbers(const dem::Record& record, std::size_t count);
/// The classes of cracks with their numbers.
std::vector<LegendEntry> crack_legend(const std::array<std::size_t, 4>& numbers);

/// Two pictures of the first `count` cracks: discs in the transparent specimen, traces on the section.
inline constexpr std::size_t all_cracks = std::numeric_limits<std::size_t>::max();
Picture transparent_cracks(const dem::Record& record, std::size_t count, const std::string& label, int width,
                           double scale);
/// How large to draw the discs, 0.2 to 1: at full size the nearest of some thousand cracks would hide all others.
double legible_disc_scale(const dem::Record& record);
Picture section_cracks(const StudyResult& study, const dem::Record& record, std::size_t count, const std::string& label,
                       int width);

/// Crack area per volume (1/mm) on the plane y = 0, each crack spread over a grain: a Gaussian with the mean radius of the
/// grains, over the volume that the same Gaussian finds in the specimen.
struct CrackDensity {
  std::vector<render::Point> at;
  std::vector<double> value;
  double spacing = 0;  ///< of the points, m
  [[nodiscard]] double largest() const;
};
CrackDensity crack_density(const dem::Record& record, std::size_t count);
/// A round number, not below the largest value: a colour bar to there has a number at its end.
double end_of_bar(double largest);
/// Its picture, colours from zero to `high`.
Picture density_picture(const dem::Record& record, const CrackDensity& density, double high, const std::string& label,
                        int width);
/// "1 204 inter tension, 12 inter shear, ..."
std::string crack_words(const std::array<std::size_t, 4>& numbers);

/// What a case reads otherwise than its scenario does: "grain diameters × 1, growth by most contacts"; "" for nothing.
std::string reading_of(const dem::Record& record, const StudyResult& study);

std::vector<LegendEntry> mineral_legend(const StudyResult& study, const dem::Record& record);

/// Of platens, jaws and strips.
inline constexpr render::Colour steel{0.35, 0.38, 0.42};
/// A body at the end of loading, cut, with the cracks near the section; `load` adds what loads it to the scene.
Panel cracks_at_end(const StudyResult& study, const SeriesCase& item, std::string caption, int width,
                    const std::function<void(render::Scene&)>& load = {});
/// ", first seed" of pictures and curves, where numbers beside them are of several; "" else.
std::string first_seed(const std::vector<SeriesCase>& cases);
/// Of a mean over specimens with a published range: undecided where it has no interval, or where that crosses an end.
Agreement agreement_within(const analysis::Estimate& mean, double low, double high);
/// A curve of each case from zero, its legend below.
render::Chart load_curves(const std::vector<SeriesCase>& cases, const CurveOf& of, const std::string& x_title,
                          const std::string& y_title);
/// Where cracks, fragments, events and energies are given, as crosses on the curves of a chart: the tests go on from there for
/// their strengths after the peak alone. False, and no mark, where none goes on.
bool mark_end_of_loading(render::Chart& chart, const std::vector<SeriesCase>& cases, const CurveOf& of);

}  // namespace reports::texture
