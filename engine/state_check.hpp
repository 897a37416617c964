// What must be true of every State that is stepped or kept, whoever made it: the invariants of
// engine/state.hpp.
#pragma once

#include "engine/state.hpp"

#include <cmath>
#include <cstddef>
#include <span>
#include <string>

namespace riesel {

/// What is wrong with the state first of all, as in "the mass of grain 17 is not positive"; empty
/// if nothing is. It may have no walls.
std::string flaw_of(const State& state);

inline bool is_positive(double value) { return std::isfinite(value) && value > 0.0; }

/// Whether a contact of this name may be, between these.
bool names_bodies(const ContactName& name, std::size_t grains, std::span<const WallLattice> walls);

}  // namespace riesel
