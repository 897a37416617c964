// Figures of a flow's report: series, profiles, the energy budget, visits to walls. The state is
// drawn by state_figure.hpp.
#pragma once

#include "io/plot.hpp"
#include "io/run_reader.hpp"
#include "io/summary.hpp"
#include "io/svg.hpp"

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace riesel::app {

/// Marks in the figure of a series.
struct SeriesMarks {
  double transient_end = 0.0;        ///< s
  std::optional<io::Measured> mean;  ///< after the transient; drawn without a band if its error
                                     ///< is not known
};

/// Shades what lies before `end` (s), on an axis of time.
void mark_transient(double end, io::Plot& plot);

/// `time` must be as long as `series`.
io::Svg draw_series(const io::Series& time, const io::Series& series, const SeriesMarks& marks);

/// The profiles of these names across the flow, on a common axis labelled `label`.
io::Svg draw_profiles(const io::Profiles& profiles, const std::vector<std::string>& names,
                      const std::string& label);

/// A part of the energy budget.
struct EnergyPart {
  std::string name;
  double value;  ///< J
  bool came_in;  ///< energy at the start or work since; otherwise where the energy is at the end
};

std::vector<EnergyPart> parts_of(const io::FlowSummary::Energy& energy);

/// A bar for each part; all values must be finite.
io::Svg draw_energy(const std::vector<EnergyPart>& parts);

/// How many visits to walls had 1, 2, ... contacts; the last bar includes visits with more.
io::Svg draw_visits(std::span<const std::int64_t> of_contacts);

}  // namespace riesel::app
