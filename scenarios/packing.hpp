// The start of a flow: grains at random places without overlap.
//
// Up to an area fraction of about 0.7 the grains stand on a staggered lattice with vacancies at
// random, wide enough for the largest of them. Beyond its reach the lattice is too narrow: large
// grains overlap at first and the engine itself pushes them apart, with contacts so inelastic that
// the heat goes at once, until nothing overlaps any more. Grains of very unequal size do not find
// apart that way: they begin so small that nothing overlaps, and grow.
#pragma once

#include "engine/state.hpp"

#include <cstdint>
#include <optional>
#include <vector>

namespace riesel::scenarios {

struct Place {
  double x, y;  ///< m
};

/// Places for grains of the given radii (m) between the two walls of `empty`, a state without
/// grains. Nothing if they do not fit.
std::optional<std::vector<Place>> pack(const State& empty, const std::vector<double>& radii,
                                       std::uint64_t seed);

}  // namespace riesel::scenarios
