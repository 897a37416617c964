// Strays of flights: grains that have gone farther than the candidates hold for while slices are
// askew.
//
// For that a grain must become faster, within a few steps, than resolved contacts make it. Its
// contacts with candidates are found as ever, any other one ends the run. So nothing here is made
// for speed.
#include "engine/flight_region.hpp"

namespace riesel {

void FlightRegion::watch_strays(std::int64_t step) {
  for (const Stray& stray : border_.mine().strays) {
    const Motion course = airspace_.courses.motion(stray.slot, step);
    if (airspace_.candidates.is_beyond_search(skin_guard_.gone(stray.slot, course, step)))
      lose(stray, step);
    look_around(stray, {slice_.begin, slice_.end}, step);
    for (const std::size_t after : border_.after()) {
      const Slice& next = airspace_.candidates.slices()[after];
      look_around(stray, {next.begin, next.end}, step);
    }
    look_at_walls(stray, step);
  }
  border_.for_each_after([&](const Announcement& other) {
    for (const Stray& stray : other.strays) look_around(stray, {slice_.begin, slice_.end}, step);
  });
}

void FlightRegion::lose(const Stray& stray, std::int64_t step) {
  const std::int32_t id = airspace_.state.grains.id[stray.slot];
  slice_.lost = first_of(slice_.lost, LostGrain{step, id, true});
}

/// Ends the run if the stray may touch a grain of `among` with which it forms no candidate. Tests
/// courses, as these are known of all grains, and none is farther from its own than the tolerance.
void FlightRegion::look_around(const Stray& stray, SlotRange among, std::int64_t step) {
  if (step < stray.step) return;
  const Courses& courses = airspace_.courses;
  const Grains& g = airspace_.state.grains;
  const FixedVector there = courses.position(stray.slot, step);
  for (auto slot = static_cast<std::uint32_t>(among.begin); slot < among.end; ++slot) {
    const double reach = g.radius[stray.slot] + g.radius[slot] + 2.0 * leeway_.tolerance;
    if (slot != stray.slot
        && overlapping(wrapped_difference(courses.position(slot, step), there), reach, units_)
        && !slice_.pairs.has(stray.slot, slot))
      lose(stray, step);
  }
}

void FlightRegion::look_at_walls(const Stray& stray, std::int64_t step) {
  if (step < stray.step) return;
  const State& state = airspace_.state;
  const double x = state.box.metres_x(airspace_.courses.position(stray.slot, step).x);
  const double radius = state.grains.radius[stray.slot];
  for (std::int32_t wall = 0; wall < static_cast<std::int32_t>(state.walls.size()); ++wall)
    if (!slice_.has_near(stray.slot, wall)
        && state.wall(wall).is_near(x, radius, leeway_.tolerance))
      lose(stray, step);
}

}  // namespace riesel
