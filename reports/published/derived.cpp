#include "reports/published/derived.h"

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "engine/analysis/breaking.h"
#include "engine/analysis/cracking.h"
#include "engine/analysis/orientation.h"
#include "engine/analysis/softening.h"
#include "reports/granite.h"

namespace reports {
namespace {

using Json = nlohmann::json;
using dem::Record;

// The place of a word in a list; -1 without one.
template <std::size_t N>
int place_in(const std::array<std::string_view, N>& words, const Json& which, const char* member) {
  if (!which.contains(member)) return -1;
  const std::string word = which.at(member).get<std::string>();
  for (std::size_t i = 0; i < N; ++i) {
    if (words[i] == word) return static_cast<int>(i);
  }
  throw std::invalid_argument("there is no " + std::string(member) + " '" + word + "'");
}

double cracks(const Record& record, const Json& which) {
  constexpr std::array<std::string_view, 8> members{"place", "mode",  "minerals", "without",
                                                    "pair",  "after", "until",    "by"};
  for (const auto& [name, value] : which.items()) {
    if (std::find(members.begin(), members.end(), name) == members.end())
      throw std::invalid_argument("cracks have no '" + name + "'");
  }
  const auto minerals = [&](const char* member) { return which.value(member, std::vector<std::string>()); };
  constexpr std::array<std::string_view, 2> places{"intra", "inter"}, modes{"tension", "shear"};
  constexpr std::array<std::string_view, 4> measures{"number", "contacts", "area", "exposure"};
  const dem::analysis::CrackChoice choice{place_in(places, which, "place"),
                                          place_in(modes, which, "mode"),
                                          minerals("minerals"),
                                          minerals("without"),
                                          minerals("pair"),
                                          which.value("after", ""),
                                          which.value("until", "")};
  const int by = place_in(measures, which, "by");
  return dem::analysis::cracks_of(record, choice, static_cast<dem::analysis::CrackMeasure>(by < 0 ? 0 : by));
}

double result_of(const Record& record, const char* id) {
  const double* found = record.find_result(id);
  if (!found) throw std::out_of_range(std::string("no result ") + id);
  return *found;
}

// Of the lattice: what the readings are named, and how they are read.
struct Reading {
  std::string_view name;
  double (*read)(const Record& record);
};
using namespace dem::analysis;
double peak_time(const Record& record) {
  const auto stress = record.table("history").real("axial_stress");
  if (stress.empty()) throw std::out_of_range("no history");
  return record.table("history").real(
      "time")[static_cast<std::size_t>(std::ranges::max_element(stress) - stress.begin())];
}
// Of a block that parts.
double parted(const Record& record, const char* id) {
  if (pieces_of(record) < 2) throw std::out_of_range("the block stays in one part");
  return 100 * result_of(record, id);
}
double c1(const Record& record) { return result_of(record, "sliding_start"); }
double c2(const Record& record) { return c1(record) + result_of(record, "sliding_duration"); }
Fall a1_of(const Record& record) { return fall_at(record, result_of(record, "a1_time")); }
constexpr std::array lattice{
    Reading{"parting_time", [](const Record& r) { return parted(r, "failure_time"); }},  // in 10⁻² s
    Reading{"friction_at_parting", [](const Record& r) { return parted(r, "frictional_share_at_parting"); }},  // %
    Reading{"a1_stress", [](const Record& r) { return 1e-6 * a1_of(r).stress; }},                              // MPa
    Reading{"a1_stress_after", [](const Record& r) { return 1e-6 * a1_of(r).low_stress; }},
    Reading{"kinetic_over_work", [](const Record& r) { return 100 * kinetic_over_work(r, peak_time(r)); }},
    Reading{"viscous_share", [](const Record& r) { return 100 * viscous_share(r); }},
    Reading{"pieces", [](const Record& r) { return static_cast<double>(pieces_of(r)); }},
    Reading{"first_at_boundary", [](const Record& r) { return first_at_boundary(r); }},
    Reading{"opened_below_theory",
            [](const Record& r) { return 100 * opened_below(r, 1e6 * result_of(r, "opening_stress_theory")); }},
    Reading{"fall_before_a1", [](const Record& r) { return 100 * largest_fall(r, 0, a1_of(r).time); }},
    Reading{"fall_before_peak",
            [](const Record& r) {
              const double end = peak_time(r), a1 = a1_of(r).time;
              return 100 * largest_fall(r, a1 + 0.5 * (end - a1), end);
            }},
    Reading{"straightness_to_a1", [](const Record& r) { return straightness(r, a1_of(r).time); }},
    Reading{"elastic_left", [](const Record& r) { return 100 * elastic_left(r, result_of(r, "failure_time")); }},
    Reading{"kinetic_left", [](const Record& r) { return 100 * kinetic_left(r, result_of(r, "failure_time")); }},
    Reading{"breaking_after_sliding", [](const Record& r) { return 100 * breaking_after(r, c2(r)); }},
    Reading{"breaking_while_sliding", [](const Record& r) { return 100 * breaking_between(r, c1(r), c2(r)); }},
    Reading{"shear_heat_while_sliding", [](const Record& r) { return 100 * shear_breaking_between(r, c1(r), c2(r)); }},
    Reading{"elastic_loss_at_a1",
            [](const Record& r) {
              const Fall fall = a1_of(r);
              return 100 * elastic_loss(r, fall.time, fall.low_time);
            }},
    Reading{"heat_before_a1", [](const Record& r) { return 100 * heat_until(r, a1_of(r).time); }},
    Reading{"heat_at_a1",
            [](const Record& r) {
              const Fall fall = a1_of(r);
              return 100 * (heat_until(r, fall.low_time) - heat_until(r, fall.time));
            }},
    Reading{"elastic_as_stress",  // from the origin to A1, the end of its drop, A2, A3
            [](const Record& r) {
              const Fall fall = a1_of(r);
              const double peak = peak_time(r);
              const std::array times{0.0, fall.time, fall.low_time, peak, time_of_least_elastic(r, peak)};
              return static_cast<double>(steps_alike(r, times));
            }},
    Reading{"breaking_at_parting",
            [](const Record& r) {
              const double d1 = result_of(r, "failure_time");
              return 100 * breaking_over_elastic(r, d1, d1 + result_of(r, "crack_duration"));
            }},
};

}  // namespace

std::optional<analysis::Estimate> fitted_value(const StudyResult& study, std::string_view name,
                                               std::string_view mineral) {
  return texture::envelopes_of(study, mineral).find(name);
}

double derived_value(const StudyResult& study, const Record& record, std::string_view name, const Json& which) {
  if (name == "cracks") return cracks(record, which);
  if (name == "lateral_strain") return 100 * lateral_strain_at(record, 0.01 * which.at("at").get<double>());
  if (name == "crack_angle") return orientation_of(record.table("cracks"), 0).mean;
  if (name == "stress_after_peak") {
    const auto cases = texture::of_mineral(study, "").cases;
    const auto series = series_of(cases, texture::test_compression, texture::parameter::confining_pressure);
    (void)record.table("history");
    return stress_after_peak(common_reach(series))(record);
  }
  for (const Reading& one : lattice) {
    if (one.name == name) return one.read(record);
  }
  throw std::invalid_argument("unknown derived value '" + std::string(name) + "'");
}

}  // namespace reports
