#include "engine/analysis/cracking.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <stdexcept>
#include <tuple>

namespace dem::analysis {
namespace {

std::string spaced(std::string_view name) {
  std::string text(name);
  std::ranges::replace(text, '_', ' ');
  return text;
}

std::vector<std::string> names_of(const Table& particles) {
  std::vector<std::string> names;
  const std::string list = particles.attribute("minerals");
  for (std::size_t at = 0; at <= list.size() && !list.empty();) {
    const std::size_t end = std::min(list.find(',', at), list.size());
    names.push_back(spaced(std::string_view(list).substr(at, end - at)));
    at = end + 1;
  }
  return names;
}

// Cracks of the table, which is in order of time, that there are at a moment.
std::size_t cracks_at(const Record& record, const std::string& moment) {
  for (const Table& table : record.tables) {
    if (table.name.starts_with("snapshots/") && table.attribute("moment") == moment)
      return std::min<std::size_t>(std::stoull(table.attribute("cracks")), record.table("cracks").rows());
  }
  throw std::out_of_range("the test has no moment " + moment);
}

// A choice with its minerals by index.
class Ends {
 public:
  Ends(const CrackChoice& choice, const std::vector<std::string>& names)
      : minerals_(indices(choice.minerals, names)),
        without_(indices(choice.without, names)),
        pair_(indices(choice.pair, names)) {
    if (!pair_.empty() && pair_.size() != 2) throw std::invalid_argument("a pair has two minerals");
  }
  [[nodiscard]] bool holds(std::int32_t a, std::int32_t b) const {
    if (!minerals_.empty() && !in(minerals_, a) && !in(minerals_, b)) return false;
    if (in(without_, a) || in(without_, b)) return false;
    return pair_.empty() || std::minmax(a, b) == std::minmax(pair_[0], pair_[1]);
  }

 private:
  static bool in(const std::vector<std::int32_t>& some, std::int32_t one) {
    return std::ranges::find(some, one) != some.end();
  }
  static std::vector<std::int32_t> indices(const std::vector<std::string>& wanted,
                                           const std::vector<std::string>& names) {
    std::vector<std::int32_t> found;
    for (const std::string& name : wanted) {
      const auto at = std::ranges::find(names, spaced(name));
      if (at == names.end()) throw std::invalid_argument("there is no mineral '" + name + "'");
      found.push_back(static_cast<std::int32_t>(at - names.begin()));
    }
    return found;
  }
  std::vector<std::int32_t> minerals_, without_, pair_;
};

}  // namespace

double cracks_of(const Record& record, const CrackChoice& choice, CrackMeasure measure) {
  const Table &cracks = record.table("cracks"), &particles = record.table("particles");
  const Ends ends(choice, names_of(particles));
  const auto place = cracks.integer("place"), mode = cracks.integer("mode"), a = cracks.integer("mineral_a"),
             b = cracks.integer("mineral_b"), contact = cracks.integer("contact");
  const auto area = cracks.real("area");
  const std::size_t first = choice.after.empty() ? 0 : cracks_at(record, choice.after),
                    last = choice.until.empty() ? cracks.rows() : cracks_at(record, choice.until);
  double number = 0, sum = 0;
  std::set<std::int32_t> broken;
  for (std::size_t i = first; i < last; ++i) {
    if ((choice.place >= 0 && place[i] != choice.place) || (choice.mode >= 0 && mode[i] != choice.mode)) continue;
    if (!ends.holds(a[i], b[i])) continue;
    ++number;
    sum += area[i];
    broken.insert(contact[i]);
  }
  if (measure == CrackMeasure::number) return number;
  if (measure == CrackMeasure::area) return sum;
  if (measure == CrackMeasure::contacts) return static_cast<double>(broken.size());
  const auto mineral = particles.integer("mineral"), pair = record.table("contacts").integer("pair"),
             where = record.table("contacts").integer("place");
  double all = 0;
  for (std::size_t c = 0; c < where.size(); ++c) {
    if (choice.place >= 0 && where[c] != choice.place) continue;
    all +=
        ends.holds(mineral[static_cast<std::size_t>(pair[2 * c])], mineral[static_cast<std::size_t>(pair[2 * c + 1])]);
  }
  return static_cast<double>(broken.size()) / all;
}

Cracking cracking_until(const Record& record, const std::string& until) {
  const Table &cracks = record.table("cracks"), &contacts = record.table("contacts");
  const auto place = cracks.integer("place"), mode = cracks.integer("mode"), contact = cracks.integer("contact");
  const auto area = cracks.real("area");
  const auto mineral = record.table("particles").integer("mineral"), pair = contacts.integer("pair"),
             where = contacts.integer("place");
  std::map<std::tuple<std::int32_t, std::int32_t, std::int32_t>, Cracking::Group> groups;
  const auto group_of = [&](std::size_t c) -> Cracking::Group& {
    const auto [a, b] = std::minmax(
        {mineral[static_cast<std::size_t>(pair[2 * c])], mineral[static_cast<std::size_t>(pair[2 * c + 1])]});
    Cracking::Group& group = groups[{where[c], a, b}];
    group.place = where[c];
    group.first = a;
    group.second = b;
    return group;
  };
  for (std::size_t c = 0; c < where.size(); ++c) ++group_of(c).contacts;
  Cracking found;
  std::set<std::int32_t> broken;
  const std::size_t last = until.empty() ? cracks.rows() : cracks_at(record, until);
  for (std::size_t i = 0; i < last; ++i) {
    Cracking::Class& of = found.classes.at(static_cast<std::size_t>(place[i])).at(static_cast<std::size_t>(mode[i]));
    ++of.number;
    of.area += area[i];
    if (!broken.insert(contact[i]).second) continue;
    ++of.contacts;
    ++group_of(static_cast<std::size_t>(contact[i])).cracked;
  }
  for (const auto& [key, group] : groups) found.groups.push_back(group);
  return found;
}

Cracking::Class Cracking::all() const {
  Class sum;
  for (const auto& modes : classes) {
    for (const Class& one : modes) {
      sum.number += one.number;
      sum.contacts += one.contacts;
      sum.area += one.area;
    }
  }
  return sum;
}

double Cracking::contacts() const {
  double sum = 0;
  for (const Group& group : groups) sum += group.contacts;
  return sum;
}

double Cracking::exposure(const Group& group) const {
  const double cracked = all().contacts;
  if (!(cracked > 0)) return std::numeric_limits<double>::quiet_NaN();
  return (group.cracked / cracked) / (group.contacts / contacts());
}

double lateral_strain_at(const Record& record, double axial_strain) {
  const Table& history = record.table("history");
  const auto axial = history.real("axial_strain"), lateral = history.real("lateral_strain"),
             stress = history.real("axial_stress");
  const auto peak = static_cast<std::size_t>(std::ranges::max_element(stress) - stress.begin());
  for (std::size_t i = 1; i <= peak && i < axial.size(); ++i) {
    if (axial[i] < axial_strain) continue;
    const double part = (axial_strain - axial[i - 1]) / (axial[i] - axial[i - 1]);
    return lateral[i - 1] + part * (lateral[i] - lateral[i - 1]);
  }
  return std::numeric_limits<double>::quiet_NaN();
}

}  // namespace dem::analysis
