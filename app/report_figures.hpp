// Figures of a flow's report but the state (state_figure.hpp): series, profiles, the budget of
// energy, visits to walls.
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

/// What a series is marked with.
struct SeriesMarks {
  double transient_end = 0.0;        ///< s
  std::optional<io::Measured> mean;  ///< of what comes after it; without a band if the error is
                                     ///< not known
};

/// Shades what lies before `end` (s), on an axis of time.
void mark_transient(double end, io::Plot& plot);

/// `time` is as long as `series`.
io::Svg draw_series(const io::Series& time, const io::Series& series, const SeriesMarks& marks);

/// Profiles across the flow that share an axis, which is labelled `label`.
io::Svg draw_profiles(const io::Profiles& profiles, const std::vector<std::string>& names,
                      const std::string& label);

/// A part of the budget of energy.
struct EnergyPart {
  std::string name;
  double value;  ///< J
  bool came_in;  ///< otherwise it is where the energy is now
};

std::vector<EnergyPart> parts_of(const io::FlowSummary::Energy& energy);

/// A bar for each part; all are finite.
io::Svg draw_energy(const std::vector<EnergyPart>& parts);

/// How many visits to walls had one contact, two, ...; the last bar stands for more, too.
io::Svg draw_visits(std::span<const std::int64_t> of_contacts);

}  // namespace riesel::app
