// The forces of the contacts of a state at its step.
//
// A state keeps the lives of its contacts, but no forces. Between two advances these are computed
// anew, by the law that also steps the contacts. The velocities that damping and friction need are
// taken from the kicks of this step, which stepping does not know yet: a difference of second order
// in the time step.
#pragma once

#include "engine/contact_law.hpp"
#include "engine/state.hpp"

#include <vector>

namespace riesel {

/// The first body is the free grain that names the contact, the second its partner.
struct PresentForce {
  double x;                   ///< m, of the centre of the first body
  double branch_x, branch_y;  ///< m, centre of the first body minus centre of the second
  double fx, fy;              ///< N, on the first body
};

/// The forces of state.contacts, in their order. As in stepping, that of a contact which begins or
/// ends within half a step of now is a mean over the step.
std::vector<PresentForce> present_forces(const State& state, const ContactModel& model);

}  // namespace riesel
