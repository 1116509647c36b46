#pragma once
// What several parts of the page say of cases.
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "engine/analysis/statistics.h"
#include "reports/published/published.h"

namespace reports {

using analysis::Repeats;  // a column of the results

/// Cases with a record, by test, in report order.
std::vector<std::pair<std::string, std::vector<const CaseResult*>>> by_test(const StudyResult& study);
/// Of all repeats that have the result.
std::vector<double> values_of(const Repeats& repeats, std::string_view id);
/// In its shown unit, without it; in powers of ten where another value of its row needs them.
std::string shown_result(const dem::Quantity& quantity, double value, bool powers = false);
/// Of ours from what is published: "−5.2 %", "+0.011", "within" a range; "–" where it is not compared.
std::string deviation_text(const Comparison& row);
/// Ids of the results that a finding begins with, of all models, the most telling first.
std::span<const std::string_view> telling_results();
/// Sentences one after the other; empty ones leave no gap.
std::string joined_notes(const std::vector<std::string>& notes);

}  // namespace reports
