// What the lasting contacts of a state do to their bodies at this moment.
//
// A state keeps the lives of its contacts, but no forces: they are worked out anew, by the law that
// steps them, for whoever looks between two advances.
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

/// In the order of the contacts of `state`. Where a contact begins or ends within half a step from
/// now, its force is the mean over the step, as in stepping.
std::vector<PresentForce> present_forces(const State& state, const ContactModel& model);

}  // namespace riesel
