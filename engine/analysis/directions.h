#pragma once
// Directions of cracks over the whole sphere: density of their poles as structural geologists contour it, its maximum, and
// the strikes that a horizontal section shows. A pole and its opposite are one; directions are unit vectors, z the loading
// axis; weights are areas (m^2), of which only the proportions count.
#include <array>
#include <span>
#include <vector>

#include "engine/core/record.h"

namespace dem::analysis {

using Direction = std::array<double, 3>;

struct Poles {
  std::vector<Direction> direction;
  std::vector<double> weight;
  /// As many poles of one weight scatter as much (Kish 1965): the square of the sum over the sum of squares.
  [[nodiscard]] double effective() const;
};

/// Normals of the cracks of one class (-1: any), weighted by area. What broke of one contact in one mode is one pole: the three
/// elements of a joint lie in one plane, and would look like three cracks that agree.
Poles poles_of(const dem::Table& cracks, int place = -1, int mode = -1);

/// Density of poles over the sphere by the kernel exp(f (|cos| - 1)) (Vollmer 1995), f = 2 (1 + n / 9): the counting circle of
/// Kamb (1959), in which a uniform distribution has its expected number three standard deviations above zero. The circle stays
/// above 2 % of the hemisphere: thousands of cracks would else be contoured one by one.
class PoleDensity {
 public:
  explicit PoleDensity(Poles poles);  ///< of at least one
  /// In multiples of the density of as much spread over all directions.
  [[nodiscard]] double times_uniform(const Direction& at) const;
  /// Standard deviations of uniform poles with these weights by which that is above 1.
  [[nodiscard]] double deviations(double times_uniform) const { return (times_uniform - 1) / scatter_; }
  [[nodiscard]] double from_deviations(double deviations) const { return 1 + deviations * scatter_; }
  [[nodiscard]] double concentration() const { return f_; }

 private:
  Poles poles_;
  double f_ = 0, scatter_ = 0, scale_ = 0;
};

/// Where the density is largest: pole of the plane that most cracks lie near, pointing down.
struct Maximum {
  Direction pole{};
  double times_uniform = 0, deviations = 0;
  [[nodiscard]] double dip() const;            ///< of the plane, degrees from the horizontal
  [[nodiscard]] double dip_direction() const;  ///< degrees from x towards y, 0 to 360
  [[nodiscard]] double to_axis() const { return 90 - dip(); }
};
Maximum maximum_of(const PoleDensity& density);

/// Shares of the trace length on horizontal sections by strike, in classes of equal width from x towards y, 0 to 180 degrees:
/// a crack of area A that dips by d adds A sin(d), its trace summed over all heights. NaN without any.
std::vector<double> strikes_of(const Poles& poles, std::size_t classes);

/// Equal-area (Schmidt) projection of the lower hemisphere on the unit disc, x to the right, y up, and back; beyond the disc
/// lies the upper hemisphere.
std::array<double, 2> schmidt(Direction pole);
Direction from_schmidt(double x, double y);

}  // namespace dem::analysis
