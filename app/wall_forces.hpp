// The mean forces of the walls on the grains after the transient, with error bars that heed that
// the momentum of a flow is bounded.
#pragma once

#include "app/cumulative.hpp"
#include "engine/state.hpp"
#include "io/run_file.hpp"
#include "io/summary.hpp"

#include <cstddef>
#include <optional>
#include <vector>

namespace riesel::app {

enum class Axis { across, along };

/// m/s, from row `first` on: the mean velocity of the grains, each weighed by its mass; across the
/// tube that since the start. Walls and gravity alone change it.
std::vector<double> velocities_by_mass(const io::RunFile& file, const State& state,
                                       std::size_t first, Axis axis);

/// N, on the grains.
struct WallForces {
  io::Measured both;
  io::Measured left;
  std::optional<io::Measured> right;  ///< none for a chute, which has only its bottom
};

/// `velocities`: by mass along the same axis, `interval` (s) apart.
WallForces wall_forces(const CumulativeSeries& series, const State& state, Axis axis,
                       const std::vector<double>& velocities, double interval);

}  // namespace riesel::app
