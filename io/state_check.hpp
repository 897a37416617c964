// What must be true of every State that is kept, whoever wrote it: the invariants of
// engine/state.hpp, and that there are grains and walls, as in every flow.
#pragma once

#include "engine/state.hpp"

#include <cstddef>
#include <span>
#include <string>

namespace riesel::io {

/// What is wrong with the state first of all, as in "the mass of grain 17 is not positive"; empty
/// if nothing is.
std::string flaw_of(const State& state);

/// Whether a contact of this name may be, between these.
bool names_bodies(const ContactName& name, std::size_t grains, std::span<const WallLattice> walls);

}  // namespace riesel::io
