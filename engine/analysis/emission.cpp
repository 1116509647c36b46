#include "engine/analysis/emission.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>

namespace dem::analysis {
namespace {

double distance(const std::array<double, 3>& a, const std::array<double, 3>& b) {
  return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}

// The heat of one mode between samples, shared by the area of the cracks of that mode there. The last sample that a crack can
// belong to takes what comes after it, too.
void share_heat(const dem::Table& history, const dem::Table& cracks, std::string_view column, std::int32_t mode,
                std::vector<Hit>& hits) {
  const auto time = history.real("time"), heat = history.real(column), area = cracks.real("area");
  const auto modes = cracks.integer("mode");
  std::size_t from = 0;
  double given = 0;
  for (std::size_t row = 0; row < time.size() && from < hits.size(); ++row) {
    std::size_t to = from;
    double sum = 0;
    for (; to < hits.size() && (hits[to].time <= time[row] || row + 1 == time.size()); ++to)
      if (modes[to] == mode) sum += area[to];
    for (std::size_t i = from; i < to && sum > 0; ++i)
      if (modes[i] == mode) hits[i].energy = (heat[row] - given) * area[i] / sum;
    if (sum > 0) given = heat[row];
    from = to;
  }
}

}  // namespace

Hits hits_of(const dem::Record& record) {
  const dem::Table& cracks = record.table("cracks");
  const dem::Table& history = record.table("history");
  const auto time = cracks.real("time"), place = cracks.real("position");
  Hits hits;
  for (std::size_t i = 0; i < cracks.rows(); ++i)
    hits.all.push_back({.time = time[i], .place = {place[3 * i], place[3 * i + 1], place[3 * i + 2]}});
  hits.own_energies = cracks.has("released") || cracks.has("heat_normal");
  if (cracks.has("released")) {
    const auto released = cracks.real("released");
    for (std::size_t i = 0; i < released.size(); ++i) hits.all[i].energy = released[i];
  } else if (cracks.has("heat_normal")) {  // a lattice
    const auto normal = cracks.real("heat_normal"), shear = cracks.real("heat_shear");
    for (std::size_t i = 0; i < normal.size(); ++i) hits.all[i].energy = normal[i] + shear[i];
  } else {
    share_heat(history, cracks, "bond_tension", 0, hits.all);
    share_heat(history, cracks, "bond_shear", 1, hits.all);
  }
  hits.forces = cracks.has("force");
  if (!hits.forces) return hits;
  const auto force = cracks.real("force"), normal = cracks.real("normal");
  const auto contact = cracks.integer("contact"), pair = record.table("contacts").integer("pair");
  const auto at = record.table("particles").real("position");
  for (std::size_t i = 0; i < hits.all.size(); ++i) {
    const auto c = static_cast<std::size_t>(contact[i]);
    const auto one = 3 * static_cast<std::size_t>(pair[2 * c]), two = 3 * static_cast<std::size_t>(pair[2 * c + 1]);
    const double length = std::hypot(at[two] - at[one], at[two + 1] - at[one + 1], at[two + 2] - at[one + 2]);
    const auto f = force.subspan(3 * i, 3), n = normal.subspan(3 * i, 3);
    const auto part = [&](std::size_t a, std::size_t b) { return -0.5 * length * (f[a] * n[b] + f[b] * n[a]); };
    hits.all[i].moment = {part(0, 0), part(1, 1), part(2, 2), part(0, 1), part(0, 2), part(1, 2)};
  }
  return hits;
}

double Event::magnitude() const { return energy_magnitude(energy); }

double energy_magnitude(double energy) { return (std::log10(energy) - 4.8) * 2 / 3; }

std::vector<Event> events_of(std::span<const Hit> hits, const Window& window) {
  struct Open {
    std::size_t event;
    std::array<double, 3> place;  // of its first crack
    double last;
  };
  std::vector<Event> events;
  std::vector<Open> open;
  for (const Hit& hit : hits) {
    std::erase_if(open, [&](const Open& o) { return hit.time > o.last + window.time; });
    Open* nearest = nullptr;
    double reach = window.length;
    for (Open& o : open) {
      const double d = distance(o.place, hit.place);
      if (d <= reach) nearest = &o, reach = d;
    }
    if (!nearest) {
      open.push_back({events.size(), hit.place, hit.time});
      nearest = &open.back();
      events.push_back({.time = hit.time});
    }
    Event& event = events[nearest->event];
    nearest->last = hit.time;
    event.duration = hit.time - event.time;
    ++event.hits;
    event.energy += hit.energy;
    for (std::size_t k = 0; k < 3; ++k) event.centre[k] += hit.energy * hit.place[k];
    for (std::size_t k = 0; k < 6; ++k) event.moment[k] += hit.moment[k];
  }
  for (Event& event : events)
    for (double& c : event.centre) c /= event.energy;
  return events;
}

std::optional<SourceType> source_of(const SymmetricTensor& m) {
  Eigen::Matrix3d tensor;
  tensor << m[0], m[3], m[4], m[3], m[1], m[5], m[4], m[5], m[2];
  const Eigen::Vector3d principal =
      Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(tensor, Eigen::EigenvaluesOnly).eigenvalues();
  const double trace = principal.sum(), deviator = (principal.array() - trace / 3).abs().sum();
  const double size = std::abs(trace) + deviator;
  if (!(size > 0)) return std::nullopt;
  return SourceType{100 * trace / size, std::sqrt(0.5) * principal.norm()};
}

}  // namespace dem::analysis
