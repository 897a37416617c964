// Profiles across the tube: means over time of what the strips hold, with error bars.
//
// The means are over the samples after a transient. Their errors are taken from the eight slowest
// variations of blocks of time (estimate_mean), and so include correlations in time; for a ratio or
// a difference of squares, the error is that of its linear part.
//
// Temperatures and sigma_yy leave out the profile of the velocity: v_y counts relative to a
// straight line across each strip, also where strips are taken together. A line, as a strip of
// constant shear rate would otherwise have rate^2 width^2 / 12 too much. Temperatures leave out,
// too, what all grains do together at a moment.
//
// Stresses are momentum fluxes, positive in compression: an ideal gas has sigma_xx = density times
// temperature_x. The kinetic part is what flying grains carry, the contact part what forces carry.
// v_x counts in full there, as walls keep its mean at zero: a common sway of the grains is a
// stress. The contact stresses sigma_xy and sigma_yx may differ, as contacts exert torques on the
// grains.
#pragma once

#include "engine/estimate.hpp"
#include "engine/strips.hpp"
#include "engine/time_blocks.hpp"

#include <cstdint>
#include <string_view>
#include <vector>

namespace riesel {

/// Strips that are taken together, by index.
using Zone = std::vector<std::size_t>;

/// A zone for each strip.
std::vector<Zone> each_strip(const Strips& strips);
/// The middle half of the width, as nearly as whole strips allow; of one or two strips, all.
Zone core_of(const Strips& strips);
/// The strips at the walls: the first, and also the last if there are two walls.
Zone wall_layers_of(const Strips& strips, std::size_t walls);

struct TubeProfile {
  std::string_view name, unit, meaning;
  std::vector<Estimate> zones;
};

/// All profiles, from `blocks` of sum_over_strips() over the samples from `first` on, for each of
/// `zones`. In a zone where no grain was seen, means over grains are unknown; where no contact was,
/// the errors of stresses; if the transient leaves no complete block, all is.
std::vector<TubeProfile> tube_profiles(const TimeBlocks& blocks, const Strips& strips,
                                       const std::vector<Zone>& zones, std::int64_t first);

}  // namespace riesel
