// The start of a flow from the last state of another run, so that a steady state can be followed
// along a setting. If each run starts from its neighbour's end, along the setting and back again,
// the two ways show whether there is hysteresis.
//
// Grains keep their places and velocities. Places are integers in quanta of the same box and stay
// as they are. Velocities are in quanta per time step, which depends on the contact settings, so
// they are converted by way of SI units. Contacts that last keep their beginning, overlap and, for
// half a step, their force; from the first step on the new contact law acts. What they did before
// is not counted: the clock and all tallies begin at zero. Their stored energy is that of the new
// law at the same overlap, and is part of the initial energy.
#pragma once

#include "engine/contact_law.hpp"
#include "engine/state.hpp"
#include "io/checkpoint.hpp"
#include "io/settings.hpp"
#include "scenarios/scenario.hpp"

#include <string>
#include <vector>

namespace riesel::scenarios {

/// The run at `start.from`, with its last state. Throws io::SettingsError if it cannot be read, if
/// its scenario, grains or box are not those of the settings, or its walls not those of `empty`.
io::Checkpoint earlier_run(const io::Settings& settings, const State& empty);

/// m, of each wall
std::vector<double> swings_across(const State& state);

/// What a flow that continues this run must fit.
Flow::Earlier to_be_continued(const io::Checkpoint& earlier);

/// Rejects walls of `state` that are shaken across (along x) with other amplitudes (m) than those
/// of the run to be continued: they would have to jump, perhaps into the grains.
void reject_other_swing_across(const io::Settings& settings, const std::vector<double>& earlier,
                               const State& state);

/// Rejects a contact law so much stiffer than the earlier one that the overlaps which `state` has
/// taken over hold more additional energy than there was in overlaps and random motion: the flow
/// would be thrown apart, and heated by what no balance shows.
void reject_released_energy(const io::Settings& settings, const Flow::Earlier& earlier,
                            const State& state);

/// The grains of `earlier`, with the velocities and spins that a state with this time step (s)
/// holds for them: those of half a step earlier, as the last kicks are not yet in them.
std::vector<Grain> half_a_step_before(const State& earlier, double time_step);

/// Copies grains and contacts of `earlier` to `state`, whose box, walls, gravity and time step are
/// set and which has no grains yet. Walls go on from their places and from the phase of their
/// oscillation.
void take_over(const State& earlier, const ContactModel& model, State& state);

/// Whether runs may continue each other along this setting. Not if it sets the grains, the box or
/// the start, which come from the earlier run.
bool can_continue_along(const std::string& key);

}  // namespace riesel::scenarios
