#include "engine/present_forces.hpp"

#include "engine/encounter.hpp"

#include <cstddef>
#include <cstdint>

namespace riesel {

std::vector<PresentForce> present_forces(const State& state, const ContactModel& model) {
  const StepUnits units(state);
  const std::vector<std::size_t> slots = slots_by_id(state.grains);
  const auto touch_of = [&](const Encounter& e) {
    return std::visit(
        [&](const auto& normal, const auto& slip) {
          return touch(e, normal, slip, model.friction, model.attraction, units.dt);
        },
        model.normal, model.slip);
  };
  const auto x = [&](std::int32_t id) {
    return state.box.metres_x(state.grains.x[slots[static_cast<std::size_t>(id)]]);
  };
  std::vector<PresentForce> forces;
  forces.reserve(state.contacts.size());
  for (const Contact& contact : state.contacts) {
    const Encounter e = encounter(contact.name, state, slots, units);
    const Touch t = touch_of(e);
    forces.push_back(
        {.x = x(contact.name.grain), .branch_x = -e.x, .branch_y = -e.y, .fx = t.fx, .fy = t.fy});
  }
  return forces;
}

}  // namespace riesel
