// The contact loop: every contact of a slice in one step, its force, its life and its kicks.
#pragma once

#include "engine/contact_law.hpp"
#include "engine/slice.hpp"
#include "engine/state.hpp"

namespace riesel {

/// Finds which candidates of the slice overlap among `hits` and at the walls, and writes the kicks
/// of the contacts to slice.kicks and their lives to its contact books. Reads the state, changes
/// only the slice. A contact whose force is not a usable number is left in slice.trouble.
void resolve_contacts(Slice& slice, const State& state, const ContactModel& model);

}  // namespace riesel
