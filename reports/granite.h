#pragma once
// What figures and published numbers of the grain texture model both read: its tests, the cases of one mineral, envelopes.
#include <string>
#include <string_view>

#include "engine/analysis/envelopes.h"
#include "engine/texture/quantities.h"
#include "reports/figure.h"

namespace reports::texture {

namespace parameter = dem::texture::parameter;
namespace quantity = dem::texture::quantity;

inline constexpr std::string_view test_compression = "compression";
inline constexpr std::string_view test_tension = "direct_tension";
inline constexpr std::string_view test_brazilian = "brazilian";
inline constexpr std::string_view test_bending = "bending";
inline constexpr std::string_view test_half_disc = "semicircular_bending";
inline constexpr std::string_view test_shear = "direct_shear";
inline constexpr std::string_view test_loops = "unloading_loops";
inline constexpr std::string_view test_genesis = "genesis";

/// The cases of one mineral alone, by its name, or of the rock ("").
StudyResult of_mineral(const StudyResult& study, std::string_view mineral);
/// Minerals that are tested alone, in the order of their cases.
std::vector<std::string> minerals_tested(const StudyResult& study);
/// Of the compression tests of one mineral, or of the rock (""), that agree in all but confining pressure and seed.
analysis::Envelopes envelopes_of(const StudyResult& study, std::string_view mineral = "");

/// What the specimen of a case is: "cylinder of 6.25 mm × 12.5 mm" (diameter and height), "disc of 50 mm × 25 mm", "block of 25 mm",
/// "bar of 40 mm × 10 mm", "half disc of 50 mm"; ""
/// where its record does not say.
std::string specimen_words(const StudyResult& study, const CaseResult& result);

}  // namespace reports::texture
