// Profiles across the tube: means over time of what the strips hold, with error bars.
//
// The means are over the samples after a transient. Their errors come from blocks of time by way of
// the eight slowest motions (estimate_mean), so that they know of correlations in time; where a
// quantity is a ratio or a difference of squares, its linear part is what scatters.
//
// Stresses are momentum fluxes, positive in compression: an ideal gas has sigma_xx = density times
// temperature_x. The kinetic part is what flying grains carry, the contact part what forces carry.
// v_x counts in full, as walls keep its mean at zero: where the grains sway together it is a
// stress. v_y counts relative to its mean in the strip, also where strips are taken together: what
// differs from strip to strip is the profile of the velocity, and nothing random. Contacts may have
// sigma_xy unlike sigma_yx: grains that do not rotate take any torque, and others hand it on.
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

std::vector<Zone> each_strip(const Strips& strips);
/// The middle half of the width, as nearly as whole strips make it; all of one or two.
Zone core_of(const Strips& strips);
/// The strips at the walls, of which there is at least the left one.
Zone wall_layers_of(const Strips& strips, std::size_t walls);

struct TubeProfile {
  std::string_view name, unit, meaning;
  std::vector<Estimate> zones;
};

/// All profiles, of blocks of sum_over_strips(), from sample `first` on. In a zone where no grain
/// was seen, means over grains are not known; after a transient that leaves no block, nothing is.
std::vector<TubeProfile> tube_profiles(const TimeBlocks& blocks, const Strips& strips,
                                       const std::vector<Zone>& zones, std::int64_t first);

}  // namespace riesel
