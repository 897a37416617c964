// What must be true of every State that is stepped or kept, wherever it came from: the invariants
// of engine/state.hpp.
#pragma once

#include "engine/state.hpp"

#include <cmath>
#include <cstddef>
#include <span>
#include <string>

namespace riesel {

/// The first flaw found in the state, such as "the mass of grain 17 is not positive"; empty if
/// there is none. Having no walls is no flaw.
std::string flaw_of(const State& state);

/// Whether `value` is positive and finite.
inline bool is_positive(double value) { return std::isfinite(value) && value > 0.0; }

/// Whether both bodies that the name tells of exist among this many grains and these walls, in the
/// order that ContactName asks for.
bool names_bodies(const ContactName& name, std::size_t grains, std::span<const WallLattice> walls);

}  // namespace riesel
