// Verdicts, and ways on, in plain words, for the screen and for the report.
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

/// "riesel resume runs/e09", or "riesel sweep" alone, for a shell: by the name under which this
/// program runs, as programs of others have the same command.
std::string call_of(std::string_view subcommand, const std::filesystem::path& path);
std::string call_of(std::string_view subcommand);

/// What the state of the flow means and, where it is too short, what is missing.
std::string explanation_of_state(const io::FlowSummary& summary);

/// Whether a longer run may end in a steady mean, or in one as precise as was asked for.
bool asks_for_more(const io::FlowSummary& summary);

/// s, for how long such a run might have to last at least, by what is known of it.
double sufficient_duration(const io::FlowSummary& summary);

/// Why a run came to its end: "duration", "precision" or "at_most".
std::string explanation_of_end(const std::string& ended_by);

/// "1.534 ± 0.050 m/s": an error bar of `error_digits` digits, and a value that ends where it does.
/// Without a bar, which may be not known or none, the value has `digits` digits. `unit` may be
/// empty; the screen has "+-" for the `sign`.
std::string with_error(const io::Measured& measured, std::string_view unit,
                       std::string_view sign = "±", int digits = 4, int error_digits = 2);

/// What speaks against a run: the value, the threshold it passed, what it means and what helps.
std::string explanation(const Finding& finding);

/// "1 thread", "4 threads"
std::string so_many(std::int64_t count, std::string_view noun);

/// Adds to "3 steady" that there are so many of another kind: "3 steady, 1 too_short". Nothing for
/// none.
void add_count(std::string& text, std::int64_t count, std::string_view name);
std::string counted(const std::map<std::string, int>& counts);

/// "40 valid, 2 suspect, 18 unphysical", of the points of a curve.
std::string count_of_verdicts(const io::CurveSummary& summary);
std::string count_of_verdicts(const io::ColumnSummary& summary);

/// Impacts that are left out of the means of a curve: through the wall, or never away from it.
struct LeftOut {
  int passed = 0, stuck = 0;
};
LeftOut left_out_of(const io::CurveSummary& summary);

/// Why points of a curve are not valid.
struct CurveReason {
  Validity verdict;
  std::string text;                 ///< the finding, what it means and what helps
  std::vector<std::string> places;  ///< for each v_x how many points, and from which v_y
};

/// Of each verdict and cause that there are, the worst verdict last.
std::vector<CurveReason> reasons_of(const io::CurveSummary& summary);

/// What hard beads would do.
std::string description_of(const RigidColumn& rigid);

/// From which gap on the drops are valid, and what t_col that asks for.
std::string where_hard(const io::ColumnSummary& summary);

}  // namespace riesel::app
