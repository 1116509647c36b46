#pragma once
// What the figures of the spring sheet share: cases, the sheet as drawn, maps of fractures as vectors.
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "engine/sheet/quantities.h"
#include "reports/figures/parts.h"

namespace reports::sheet {

namespace parameter = dem::sheet::parameter;
namespace quantity = dem::sheet::quantity;

/// The records of the study, in report order, of each kind of specimen that of its first seed; the first is the scenario's own.
std::vector<const dem::Record*> records_of(const StudyResult& study);
const dem::Record* main_record(const StudyResult& study);
/// Those of every seed of that kind, this one first.
std::vector<const dem::Record*> seeds_of(const StudyResult& study, const dem::Record& record);
/// "spread 0.6", "spread 0.6, historical", "seed 1": what sets a case apart from the others of its study; "this run" alone.
std::string label_of(const dem::Record& record, const StudyResult& study);
/// The same without the seed; "" alone.
std::string kind_of(const dem::Record& record, const StudyResult& study);

/// A value over the seeds of that kind.
analysis::Estimate over_seeds(const StudyResult& study, const dem::Record& record, const ValueOf& value);
/// " Over 3 seeds the share is 31 % (95 % interval 28 to 34).", of each run that has several; "" where none has.
/// `what`: "the share is".
std::string over_seeds_said(const StudyResult& study, const std::vector<const dem::Record*>& runs, const ValueOf& value,
                            std::string_view what, std::string_view unit = "%");

/// The sheet as it was laid: columns, rows and radius, in box widths.
struct Layout {
  int columns = 0, rows = 0;
  double radius = 0;
  double height = 0;
};
Layout layout_of(const dem::Record& record);

/// What a colour of a drawing means.
struct KeyItem {
  std::string colour, text;
  bool line = false;  ///< of a line; else of an area
};

/// Drawing on a box of `width` pixels: places in box widths, y upwards.
class Drawing {
 public:
  Drawing(double x0, double y0, double x1, double y1, double width);
  void polygon(const std::vector<std::array<double, 2>>& points, std::string_view fill, std::string_view stroke,
               double stroke_width);
  void line(double x0, double y0, double x1, double y1, std::string_view colour, double width);
  void circle(double x, double y, double radius, std::string_view fill, std::string_view stroke, double stroke_width);
  void text(double x, double y, std::string_view words, double size, std::string_view anchor = "middle");
  void raw(std::string_view svg) { body_ += svg; }
  [[nodiscard]] double px(double x) const { return (x - x0_) * scale_; }
  [[nodiscard]] double py(double y) const { return (y1_ - y) * scale_; }
  [[nodiscard]] double scale() const { return scale_; }
  [[nodiscard]] std::string finish(double extra_below = 0) const;
  /// With what its colours mean below it.
  [[nodiscard]] std::string finish_with_key(const std::vector<KeyItem>& key);

 private:
  double x0_, y1_, scale_, width_, height_;
  std::string body_;
};

/// A colour of each grain, of which no two that touch have the same; pale grey for the matrix of a layer.
std::vector<std::string> grain_fills(const dem::Record& record);
/// Fill of grains that grow, or of the layer.
constexpr std::string_view marked_fill = "#e9d9a8";
constexpr std::string_view intra_colour = "#bd4300", inter_colour = "#0b3c5d";
constexpr std::string_view edge_colour = "#008585", matrix_colour = "#000000";

/// The outlines of a record's grains, each as points, where they lie under the particles.
std::vector<std::vector<std::array<double, 2>>> outlines_of(const dem::Record& record);

/// True for a layer in a matrix.
bool layered(const dem::Record& record);

/// The part of the sheet that is shown: the layer with matrix on either side, as thick as the layer but no more than `beside`,
/// where there is one; else all of it.
std::array<double, 2> heights_shown(const dem::Record& record, double beside = 1);
/// Cracks up to a strain over the grain outlines, by colour where they lie.
std::string fracture_map(const dem::Record& record, double strain, double width);
/// "13 broken springs inside grains, 2 at boundaries" up to a strain, in the words of the sheet's own map.
std::string crack_words(const dem::Record& record, double strain);
/// True for a layer that is not made of grains: nothing in it is a boundary between grains.
bool uniform_layer(const dem::Record& record);
/// "a strain of 0.400 %", "a growth of 0.400 %": how far a run had come.
std::string at_strain(const dem::Record& record, double strain);
/// Agrees above a half, disagrees below what chance gives; with an interval, where all of it does.
Agreement mainly(const analysis::Estimate& share, double chance);
/// What verdicts of several runs say together, at least one: undecided where they differ.
Agreement together(std::span<const Agreement> verdicts);
/// Where a broken spring lies. A sheet without a layer has the first two places only; in one with a layer they are those of
/// springs between two particles of the layer.
enum class CrackPlace { inside, boundary, edge, matrix };
constexpr std::size_t crack_places = 4;
/// Of each broken spring, by the grains of its two particles.
std::vector<CrackPlace> places_of(const dem::Record& record);
/// Number of cracks up to a strain, by place.
std::array<int, crack_places> crack_counts(const dem::Record& record, double strain);
int sum_of(const std::array<int, crack_places>& counts);

/// Share of all cracks that lie between grains; not a number without any.
double between_share(const dem::Record& record);
/// Share of the springs that lie between grains: what that of the cracks would be by chance.
double between_by_chance(const dem::Record& record);

/// Names of a record's snapshot tables, and their strains.
std::vector<std::pair<std::string, double>> snapshots_of(const dem::Record& record);

}  // namespace reports::sheet
