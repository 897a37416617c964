#include "engine/present_forces.hpp"

#include "engine/meeting.hpp"

#include <cstddef>
#include <cstdint>

namespace riesel {

std::vector<PresentForce> present_forces(const State& state, const ContactModel& model) {
  const StepUnits units(state);
  const std::vector<std::size_t> slots = slots_by_id(state.grains);
  const Bodies b = bodies(state.grains);
  const auto touch_of = [&](const Contact& contact, const Meeting& meeting, const Encounter& e) {
    return std::visit(
        [&](const auto& normal, const auto& slip) {
          const Stretch spring{.spring = contact.spring, .time = 0.0};
          const auto touch_of_turning = [&](const auto& turn) {
            return touch(e, turn, spring, normal, slip, model.friction, model.attraction, units.dt);
          };
          return b.rotate() ? touch_of_turning(turning(meeting, b, model.rolling_friction, units))
                            : touch_of_turning(NoTurning{});
        },
        model.normal, model.slip);
  };
  const auto x = [&](std::int32_t id) {
    return state.box.metres_x(state.grains.position[slots[static_cast<std::size_t>(id)]].x);
  };
  std::vector<PresentForce> forces;
  forces.reserve(state.contacts.size());
  for (const Contact& contact : state.contacts) {
    const Meeting meeting = meeting_of(contact.name, state, contact_slots(contact.name, slots));
    const Encounter e = encounter(meeting, b, units);
    const Touch t = touch_of(contact, meeting, e);
    forces.push_back(
        {.x = x(contact.name.grain), .branch_x = -e.x, .branch_y = -e.y, .fx = t.fx, .fy = t.fy});
  }
  return forces;
}

}  // namespace riesel
