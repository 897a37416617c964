// The start of a flow: grains at random places without overlap.
//
// Up to an area fraction of about 0.7 the grains are placed on a staggered lattice with random
// vacancies, wide enough for the largest of them. Above, the lattice is too narrow: large grains
// overlap at first, and the engine itself pushes them apart until nothing overlaps any more, with
// contacts so inelastic that the energy is lost at once. Grains of very unequal size do not come
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

/// Places for grains of the given radii (m), in their order, between the two walls of `empty`, a
/// state without grains. Nothing if no places without overlap were found.
std::optional<std::vector<Place>> pack(const State& empty, const std::vector<double>& radii,
                                       std::uint64_t seed);

}  // namespace riesel::scenarios
