// Verdicts, and commands to go on with, in plain words, for the screen and for the report.
#pragma once

#include "engine/validity.hpp"
#include "io/summary.hpp"

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace riesel::app {

/// "riesel resume runs/e09", or "riesel sweep" alone, quoted for a shell. Has the name under which
/// this program was called, as other programs may provide the same command.
std::string call_of(std::string_view subcommand, const std::filesystem::path& path);
std::string call_of(std::string_view subcommand);

/// What the state of the flow means and, if the run is too short, what is missing.
std::string explanation_of_state(const io::FlowSummary& summary);

/// Whether a longer run may yield a steady mean, or one as precise as was asked for.
bool asks_for_more(const io::FlowSummary& summary);

/// s, an estimate of the simulated time that a longer run needs.
double sufficient_duration(const io::FlowSummary& summary);

/// Why a run came to its end.
std::string_view explanation_of_end(io::EndedBy ended_by);

/// "1.534 ± 0.050 m/s": the error with `error_digits` significant digits, and the value rounded to
/// the same place. If the error is not known (NaN) or 0, the value has `digits` significant digits.
/// `unit` may be empty; on the screen `sign` is "+-".
std::string with_error(const io::Measured& measured, std::string_view unit,
                       std::string_view sign = "±", int digits = 4, int error_digits = 2);

/// A finding that speaks against a run: its value, the threshold passed, what it means and what
/// helps.
std::string explanation(const Finding& finding);

/// "1 thread", "4 threads"
std::string so_many(std::int64_t count, std::string_view noun);

/// Appends a count to a list: "3 steady" becomes "3 steady, 1 too_short". Does nothing if `count`
/// is 0.
void add_count(std::string& text, std::int64_t count, std::string_view name);
/// All counts as such a list, sorted by name.
std::string counted(const std::map<std::string, int>& counts);

/// "40 valid, 2 suspect, 18 unphysical", of the points of a curve.
std::string count_of_verdicts(const io::CurveSummary& summary);
std::string count_of_verdicts(const io::ColumnSummary& summary);

/// Impacts that are left out of the means of a curve: the grain went through the wall (passed), or
/// did not come away from it (stuck).
struct LeftOut {
  int passed = 0, stuck = 0;
};
LeftOut left_out_of(const io::CurveSummary& summary);

/// Why points of a curve are not valid.
struct CurveReason {
  Validity verdict;
  std::string text;                 ///< the finding, what it means and what helps
  std::vector<std::string> places;  ///< for each v_x how many points, and the first v_y
};

/// One for each verdict and cause that occur, the worst verdict last.
std::vector<CurveReason> reasons_of(const io::CurveSummary& summary);

/// What a column of hard beads would do.
std::string description_of(const RigidColumn& rigid);

/// For which gaps t_col is short enough that the drops are valid, and what helps for the others.
std::string where_hard(const io::ColumnSummary& summary);

}  // namespace riesel::app
