#include "engine/present_forces.hpp"

#include "engine/encounter.hpp"

#include <cstddef>
#include <cstdint>

namespace riesel {

namespace {

std::vector<std::int64_t> slots_by_id(const Grains& grains) {
  std::vector<std::int64_t> slots(grains.size());
  for (std::size_t slot = 0; slot < grains.size(); ++slot)
    slots[static_cast<std::size_t>(grains.id[slot])] = static_cast<std::int64_t>(slot);
  return slots;
}

/// The two bodies of contacts, found by name.
class Partners {
public:
  explicit Partners(const State& state)
      : state_(state), units_(state), slots_(slots_by_id(state.grains)) {}

  const StepUnits& units() const { return units_; }
  double x(const ContactName& name) const {
    return state_.box.metres_x(state_.grains.x[index(slot(name.grain))]);
  }
  Encounter encounter(const ContactName& name) const {
    return name.wall == no_wall ? of_grains(slot(name.grain), slot(name.partner))
                                : at_wall(slot(name.grain), name);
  }

private:
  static std::size_t index(std::int64_t slot) { return static_cast<std::size_t>(slot); }
  std::int64_t slot(std::int32_t id) const { return slots_[static_cast<std::size_t>(id)]; }

  Encounter of_grains(std::int64_t i, std::int64_t j) const {
    const Grains& g = state_.grains;
    const double a = g.mass[index(i)], b = g.mass[index(j)];
    return riesel::encounter(relative_motion(bodies(g), i, j),
                             g.radius[index(i)] + g.radius[index(j)], a * b / (a + b), units_);
  }

  Encounter at_wall(std::int64_t i, const ContactName& name) const {
    const Grains& g = state_.grains;
    const WallLattice& wall = state_.walls[static_cast<std::size_t>(name.wall)];
    const RelativeMotion motion = relative_motion(bodies(g), i, state_.box.fixed_x(wall.line),
                                                  wall.place(name.partner), units_);
    return riesel::encounter(motion, g.radius[index(i)] + wall.radius, g.mass[index(i)], units_);
  }

  const State& state_;
  StepUnits units_;
  std::vector<std::int64_t> slots_;
};

}  // namespace

std::vector<PresentForce> present_forces(const State& state, const ContactModel& model) {
  const Partners partners(state);
  const auto touch_of = [&](const Encounter& e) {
    return std::visit(
        [&](const auto& normal, const auto& slip) {
          return touch(e, normal, slip, model.friction, model.attraction, partners.units().dt);
        },
        model.normal, model.slip);
  };
  std::vector<PresentForce> forces;
  forces.reserve(state.contacts.size());
  for (const Contact& contact : state.contacts) {
    const Encounter e = partners.encounter(contact.name);
    const Touch t = touch_of(e);
    forces.push_back({.x = partners.x(contact.name),
                      .branch_x = -e.x,
                      .branch_y = -e.y,
                      .fx = t.fx,
                      .fy = t.fy});
  }
  return forces;
}

}  // namespace riesel
