#pragma once
// Cracks of a granite record counted by class, by the minerals at their ends and by the part of the test in which they
// formed, and how much of what could crack they are.
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/core/record.h"

namespace dem::analysis {

/// Which cracks. Moments are those of the record's snapshots: "crack_initiation", "damage", "peak", "post_peak" (the stress
/// has fallen to 0.9 of the peak), "end"; "" is the first load, or the end of the test.
struct CrackChoice {
  int place = -1, mode = -1;               ///< as in the table of cracks; -1: any
  std::vector<std::string> minerals = {};  ///< one of them is at one end at least; empty: any
  std::vector<std::string> without = {};   ///< none of them is at either end
  std::vector<std::string> pair = {};      ///< two: one at each end
  std::string after = {}, until = {};
};

/// What is counted of them.
enum class CrackMeasure {
  number,    ///< broken elements of flat joints (three a joint) and broken bonds
  contacts,  ///< contacts with at least one
  area,      ///< m^2
  exposure,  ///< contacts with at least one over all contacts of that place between such minerals
};

/// Throws std::out_of_range where the record lacks a table or the moment, std::invalid_argument for a mineral that it has not.
double cracks_of(const Record& record, const CrackChoice& choice, CrackMeasure measure);

/// What has cracked up to a moment (as in CrackChoice::until), by class and by group of contacts.
struct Cracking {
  /// Of a class. A contact belongs to the class of its first crack alone, so that shares add up.
  struct Class {
    double number = 0, contacts = 0, area = 0;
  };
  /// Contacts of one place between two minerals, and those with at least one crack.
  struct Group {
    std::int32_t place = 0, first = 0, second = 0;
    double contacts = 0, cracked = 0;
  };
  std::array<std::array<Class, 2>, 2> classes{};  ///< by place and mode, as in the table of cracks
  std::vector<Group> groups;                      ///< inside grains first, then by minerals
  [[nodiscard]] Class all() const;
  [[nodiscard]] double contacts() const;
  /// Share of the cracked contacts that are of the group, over its share of all contacts: 1 where it cracks as contacts do in
  /// the mean. NaN without cracks.
  [[nodiscard]] double exposure(const Group& group) const;
};
/// Throws as cracks_of().
Cracking cracking_until(const Record& record, const std::string& until);

/// Lateral strain at the first row with so large an axial strain before the peak; NaN where the peak comes before.
double lateral_strain_at(const Record& record, double axial_strain);

}  // namespace dem::analysis
