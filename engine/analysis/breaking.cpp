#include "engine/analysis/breaking.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <set>
#include <span>
#include <utility>
#include <vector>

namespace dem::analysis {
namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();

std::size_t at(std::int32_t i) { return static_cast<std::size_t>(i); }

// The first row of a history at a time or later; the last one where there is none.
std::size_t row_at(std::span<const double> time, double wanted) {
  const auto found = std::ranges::lower_bound(time, wanted);
  return static_cast<std::size_t>(std::min(found - time.begin(), static_cast<std::ptrdiff_t>(time.size()) - 1));
}

std::size_t peak_of(std::span<const double> stress) {
  return static_cast<std::size_t>(std::ranges::max_element(stress) - stress.begin());
}

std::vector<double> sum_of(const Table& history, std::initializer_list<const char*> columns) {
  std::vector<double> sum(history.rows(), 0.0);
  for (const char* name : columns) {
    const auto values = history.real(name);
    for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += values[i];
  }
  return sum;
}

std::vector<double> elastic_of(const Table& history) {
  return sum_of(history, {"elastic_normal", "elastic_shear", "elastic_planes"});
}
std::vector<double> breaking_of(const Table& history) {
  return sum_of(history, {"breaking_heat_normal", "breaking_heat_shear"});
}
std::vector<double> heat_of(const Table& history) {
  return sum_of(history, {"viscous_heat", "breaking_heat_normal", "breaking_heat_shear", "frictional_heat"});
}

// What of a heat comes between two times, over all of it; 0 where there is none at all.
double share_between(const Table& history, const std::vector<double>& heat, double from, double to) {
  if (heat.empty()) return none;
  const auto time = history.real("time");
  const double part = heat[row_at(time, to)] - heat[row_at(time, from)];
  return heat.back() > 0 ? part / heat.back() : 0;
}

}  // namespace

int pieces_of(const Record& record, double least) {
  const Table &cracks = record.table("cracks"), &contacts = record.table("contacts");
  const auto element = cracks.integer("element"), way = cracks.integer("direction");
  std::set<std::pair<std::int32_t, std::int32_t>> broken;  // by the element that owns the bond, and its direction
  for (std::size_t i = 0; i < element.size(); ++i) broken.emplace(element[i], way[i]);
  const auto pair = contacts.integer("pair"), direction = contacts.integer("direction");
  std::vector<std::int32_t> root(record.table("particles").rows());
  std::iota(root.begin(), root.end(), 0);
  const auto find = [&](std::int32_t i) {
    while (root[at(i)] != i) i = root[at(i)] = root[at(root[at(i)])];
    return i;
  };
  for (std::size_t c = 0; c < direction.size(); ++c) {
    if (!broken.contains({pair[2 * c], direction[c]})) root[at(find(pair[2 * c]))] = find(pair[2 * c + 1]);
  }
  std::vector<double> size(root.size(), 0.0);
  for (std::size_t i = 0; i < root.size(); ++i) ++size[at(find(static_cast<std::int32_t>(i)))];
  const double limit = least * static_cast<double>(root.size());
  return static_cast<int>(std::ranges::count_if(size, [&](double n) { return n > 0 && n >= limit; }));
}

double first_at_boundary(const Record& record) {
  const auto position = record.table("particles").real("position"), radius = record.table("particles").real("radius");
  std::array<double, 3> low, high;
  low.fill(std::numeric_limits<double>::infinity());
  high.fill(-std::numeric_limits<double>::infinity());
  for (std::size_t i = 0; i < position.size(); ++i) {
    low[i % 3] = std::min(low[i % 3], position[i]);
    high[i % 3] = std::max(high[i % 3], position[i]);
  }
  const auto outside = [&](std::int32_t e) {
    const double near = 0.6 * radius[at(e)];  // rows of the faces are not quite plane
    for (std::size_t k = 0; k < 3; ++k) {
      const double x = position[3 * at(e) + k];
      if (x - low[k] < near || high[k] - x < near) return true;
    }
    return false;
  };
  const Table& contacts = record.table("contacts");
  const auto pair = contacts.integer("pair"), direction = contacts.integer("direction");
  std::set<std::pair<std::int32_t, std::int32_t>> boundary;
  for (std::size_t c = 0; c < direction.size(); ++c) {
    if (outside(pair[2 * c]) || outside(pair[2 * c + 1])) boundary.emplace(pair[2 * c], direction[c]);
  }
  const auto element = record.table("cracks").integer("element"), way = record.table("cracks").integer("direction");
  const std::size_t first = std::min(element.size(), std::max<std::size_t>(10, element.size() / 100));
  if (first == 0) return none;
  double there = 0;
  for (std::size_t i = 0; i < first; ++i) there += boundary.contains({element[i], way[i]});
  const double share = static_cast<double>(boundary.size()) / static_cast<double>(direction.size());
  return there / static_cast<double>(first) / share;
}

double opened_below(const Record& record, double limit) {
  const auto stress = record.table("history").real("axial_stress"), opening = record.table("history").real("opening");
  if (stress.empty()) return none;
  const std::size_t peak = peak_of(stress);
  std::size_t i = 0;
  while (i < peak && stress[i] < limit) ++i;
  return opening[peak] > 0 ? opening[i] / opening[peak] : none;
}

double largest_fall(const Record& record, double from, double to) {
  const Table& history = record.table("history");
  const auto time = history.real("time"), stress = history.real("axial_stress"), opening = history.real("opening"),
             sliding = history.real("sliding");
  double most = 0, top = 0, broken = -1;
  for (std::size_t i = row_at(time, from); i < time.size() && time[i] <= to; ++i) {
    if (stress[i] >= top) {
      top = stress[i];
      broken = opening[i] + sliding[i];
    } else if (opening[i] + sliding[i] > broken) {
      most = std::max(most, 1 - stress[i] / top);
    }
  }
  return most;
}

Fall fall_at(const Record& record, double wanted) {
  const Table& history = record.table("history");
  const auto time = history.real("time"), strain = history.real("axial_strain"), stress = history.real("axial_stress");
  if (time.empty()) return {none, none, none, none, none};
  const std::size_t now = row_at(time, wanted);
  const auto top = static_cast<std::size_t>(
      std::max_element(stress.begin(), stress.begin() + static_cast<std::ptrdiff_t>(now) + 1) - stress.begin());
  std::size_t low = top;
  for (std::size_t i = top; i < stress.size() && (i <= now || stress[i] < stress[top]); ++i) {
    if (stress[i] < stress[low]) low = i;
  }
  return {time[top], strain[top], stress[top], time[low], stress[low]};
}

double kinetic_over_work(const Record& record, double time) {
  const Table& history = record.table("history");
  const auto kinetic = history.real("kinetic"), work = history.real("work");
  if (kinetic.empty()) return none;
  std::size_t most = row_at(history.real("time"), time);
  for (std::size_t i = most; i < kinetic.size(); ++i) {
    if (kinetic[i] > kinetic[most]) most = i;
  }
  return kinetic[most] / work[most];
}

double viscous_share(const Record& record) {
  const Table& history = record.table("history");
  const auto heat = heat_of(history);
  return heat.empty() ? none : history.real("viscous_heat").back() / heat.back();
}

double straightness(const Record& record, double wanted) {
  const auto time = record.table("history").real("time"), strain = record.table("history").real("axial_strain"),
             stress = record.table("history").real("axial_stress");
  if (time.empty()) return none;
  const std::size_t end = row_at(time, wanted);
  std::size_t third = 0;
  while (third < end && strain[third] < strain[end] / 3) ++third;
  return stress[end] / strain[end] / (stress[third] / strain[third]);
}

double elastic_left(const Record& record, double time) {
  const Table& history = record.table("history");
  const auto elastic = elastic_of(history);
  if (elastic.empty()) return none;
  const std::size_t from = row_at(history.real("time"), time);
  return *std::min_element(elastic.begin() + static_cast<std::ptrdiff_t>(from), elastic.end()) / elastic[from];
}

double time_of_least_elastic(const Record& record, double from) {
  const Table& history = record.table("history");
  const auto elastic = elastic_of(history);
  if (elastic.empty()) return none;
  const auto time = history.real("time");
  const auto begin = elastic.begin() + static_cast<std::ptrdiff_t>(row_at(time, from));
  return time[static_cast<std::size_t>(std::min_element(begin, elastic.end()) - elastic.begin())];
}

double kinetic_left(const Record& record, double time) {
  const auto kinetic = record.table("history").real("kinetic");
  if (kinetic.empty()) return none;
  const auto rest = kinetic.subspan(row_at(record.table("history").real("time"), time));
  return kinetic.back() / *std::ranges::max_element(rest);
}

double breaking_after(const Record& record, double time) {
  const Table& history = record.table("history");
  const auto heat = breaking_of(history);
  if (heat.empty()) return none;
  return 1 - heat[row_at(history.real("time"), time)] / heat.back();
}

double elastic_loss(const Record& record, double from, double to) {
  const Table& history = record.table("history");
  const auto elastic = elastic_of(history);
  if (elastic.empty()) return none;
  const auto time = history.real("time");
  return 1 - elastic[row_at(time, to)] / elastic[row_at(time, from)];
}

double heat_until(const Record& record, double time) {
  const Table& history = record.table("history");
  const auto heat = heat_of(history);
  return heat.empty() ? none : heat[row_at(history.real("time"), time)] / heat.back();
}

double breaking_between(const Record& record, double from, double to) {
  const Table& history = record.table("history");
  return share_between(history, breaking_of(history), from, to);
}

double shear_breaking_between(const Record& record, double from, double to) {
  const Table& history = record.table("history");
  return share_between(history, sum_of(history, {"breaking_heat_shear"}), from, to);
}

double breaking_over_elastic(const Record& record, double from, double to) {
  const Table& history = record.table("history");
  const auto elastic = elastic_of(history), breaking = breaking_of(history);
  if (elastic.empty()) return none;
  const auto time = history.real("time");
  return (breaking[row_at(time, to)] - breaking[row_at(time, from)]) / elastic[row_at(time, from)];
}

int steps_alike(const Record& record, std::span<const double> times) {
  const Table& history = record.table("history");
  const auto time = history.real("time"), stress = history.real("axial_stress");
  const auto elastic = elastic_of(history);
  if (elastic.empty()) return 0;
  int alike = 0;
  for (std::size_t i = 1; i < times.size(); ++i) {
    const std::size_t from = row_at(time, times[i - 1]), to = row_at(time, times[i]);
    alike += (stress[to] - stress[from]) * (elastic[to] - elastic[from]) > 0;
  }
  return alike;
}

}  // namespace dem::analysis
