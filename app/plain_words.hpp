// Verdicts, and ways on, in plain words, for the screen and for the report.
#pragma once

#include "engine/validity.hpp"
#include "io/summary.hpp"

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace riesel::app {

/// "riesel resume runs/e09", for a shell: by the name under which this program runs, as programs
/// of others have the same command.
std::string call_of(std::string_view subcommand, const std::filesystem::path& path);

/// What the state of the flow means and, where it is too short, what is missing.
std::string explanation_of_state(const io::FlowSummary& summary);

/// Whether a longer run may end in a steady mean, or in one as precise as was asked for.
bool asks_for_more(const io::FlowSummary& summary);

/// s, for how long such a run might have to last at least, by what is known of it.
double sufficient_duration(const io::FlowSummary& summary);

/// Why a run came to its end: "duration", "precision" or "at_most".
std::string explanation_of_end(const std::string& ended_by);

/// "1.534" and "0.050": an error bar of `error_digits` digits, and a value that ends where it does.
/// Where the bar is not known or none, the value has `digits` digits, and no bar is told.
struct Digits {
  std::string value, error;
};
Digits digits_of(const io::Measured& measured, int digits = 4, int error_digits = 2);

/// What speaks against a run: the value, the threshold it passed, what it means and what helps.
std::string explanation(const Finding& finding);

/// "40 valid, 2 suspect, 18 unphysical", of the points of a curve.
std::string count_of_verdicts(const io::CurveSummary& summary);
std::string count_of_verdicts(const io::ColumnSummary& summary);

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
