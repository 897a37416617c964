// The start of a flow from the last state of another run, so that a steady state can be followed
// along a setting: each run from its neighbour's end, up and down again, shows hysteresis.
//
// What carries over are the grains with their places and velocities. Places are integers in quanta
// of the same box and stay as they are. Velocities are quanta per time step, and the time step
// follows from the contact settings, so they go through SI units. Contacts that last keep their
// beginning, overlap and, for half a step, their force; from the first step on the new contact law
// acts on them. What they did so far stays in the books of the earlier run: the clock and all
// tallies begin at zero. The energy stored in them is that of the new law at the same overlap,
// which counts as there from the start.
#pragma once

#include "engine/contact_law.hpp"
#include "engine/state.hpp"
#include "io/settings.hpp"

#include <string>
#include <vector>

namespace riesel::scenarios {

/// The last state of the run at `start.from`. Rejects what cannot be read, a run in another box or
/// of other grains than the settings say, and a state that has not as many walls as `empty`.
State earlier_state(const io::Settings& settings, const State& empty);

/// Rejects walls that would have to jump across, into their grains: those of `state` must be shaken
/// as far in that direction as those of `earlier`.
void reject_other_swing_across(const io::Settings& settings, const State& earlier,
                               const State& state);

/// The grains of `earlier`, with the velocities and spins that a state with this time step (s) is
/// to hold for them: half a step before, as the forces of the last step are not yet in them.
std::vector<Grain> half_a_step_before(const State& earlier, double time_step);

/// Moves grains and contacts of `earlier` to `state`, whose box, walls, gravity and time step are
/// set and which has no grains yet. Walls go on from where they were and at the phase of their
/// oscillation.
void take_over(const State& earlier, const ContactModel& model, State& state);

/// Whether runs may follow each other along this setting: not where it is about the grains, the
/// box or the start, which the earlier run gives.
bool can_continue_along(const std::string& key);

}  // namespace riesel::scenarios
