#pragma once
// What the figures of the close-packed lattice share: cases by their choices, windows of a history, marks.
#include <string>
#include <string_view>
#include <vector>

#include "engine/lattice/quantities.h"
#include "reports/figures/parts.h"

namespace reports::lattice {

namespace parameter = dem::lattice::parameter;
namespace quantity = dem::lattice::quantity;

/// The first record of a test, that of the scenario's own choices; nullptr when there is none.
const dem::Record* main_record(const StudyResult& study, std::string_view test);
/// All records of a test, in report order.
std::vector<const dem::Record*> records_of(const StudyResult& study, std::string_view test);
/// Those along the number of elements, with the choices of the main record but whatever size of loading step; by size.
std::vector<const dem::Record*> by_size(const StudyResult& study, std::string_view test);

/// Whether the moments of a failure are known: D1 and D2 in tension, A1, C1 and C2 in compression. A test that was given
/// up before has none.
bool has_failure(const dem::Record& record);
/// "tension of 82 elements did not end in failure, so that its moments are not known"
std::string no_failure_words(const dem::Record& record);

/// How its planes hold the end elements: "elastic", "rigid" or "plate".
std::string planes_of(const dem::Record& record);
/// What sets a record apart from the main one: "rigid planes", "loading steps × 5"; "as the series" when nothing does.
std::string choice_words(const dem::Record& record, const dem::Record& main);

/// Part of a history column between two times (s); x is the time since `zero`, in microseconds.
render::Series window(const dem::Table& history, const std::string& column, double from, double to, double zero,
                      double factor);
/// Sum of columns over the same rows.
render::Series window_sum(const dem::Table& history, const std::vector<std::string>& columns, double from, double to,
                          double zero, double factor);
/// A whole column against another.
render::Series whole(const dem::Table& history, const std::string& x, double x_factor,
                     const std::vector<std::string>& columns, double factor);

render::Series styled(render::Series series, const std::string& label, std::size_t colour,
                      render::Line line = render::Line::solid, double width = 1.8);
render::Mark upright(double x, const std::string& label);
render::Mark dot(double x, double y, const std::string& label);

/// "A; b." of {"a", "b"}; "" of nothing.
std::string sentence(const std::vector<std::string>& parts);

/// From light to dark with `share` 0 ... 1, for times: apart in grey print too.
render::Colour time_colour(double share);

/// Names of the energy columns that together are a term.
const std::vector<std::string>& elastic_columns();
const std::vector<std::string>& heat_columns();

/// The first time (s) at which a column reaches its extreme after `from`.
double time_of_least(const dem::Table& history, const std::vector<std::string>& columns, double from);

}  // namespace reports::lattice
