#include "engine/skin_guard.hpp"

#include "engine/free_flight.hpp"

#include <algorithm>
#include <cmath>

namespace riesel {

namespace {

/// For how many steps a point at (x, y) that moves by (ux, uy) in each stays within `room` of the
/// origin for sure: fewer than the first s with |(x, y) + s (ux, uy)| = room.
std::int64_t steps_within(double room, double x, double y, double ux, double uy) {
  const double left = room * room - x * x - y * y;
  if (left <= 0.0) return 0;
  const double speed2 = ux * ux + uy * uy;
  const double outward = x * ux + y * uy;
  const double root = std::sqrt(outward * outward + speed2 * left);
  // Two forms of the same root; the one chosen does not cancel.
  const double steps = outward < 0.0 ? (root - outward) / speed2 : left / (outward + root);
  return Forecast::whole_steps(steps) - 1;
}

}  // namespace

double room_in_skin(const Box& box, double skin, double tolerance) {
  const double resolution = box.metres_x(from_upper(1)) + box.metres_y(from_upper(1));
  return std::max(0.0, 0.5 * skin - tolerance - resolution) / generous;
}

SkinGuard::SkinGuard(const State& state, const Candidates& candidates, const Courses& courses)
    : state_(state), candidates_(candidates), courses_(courses) {}

void SkinGuard::start_over(SlotRange slots, double room) {
  room_ = room;
  fastest2_ = 0.0;
  const Grains& g = state_.grains;
  const auto speed = candidates_.speedometer(state_.box);
  for (std::size_t slot = slots.begin; slot < slots.end; ++slot)
    fastest2_ = std::max(fastest2_, speed.squared(lanes_of(g.u[slot])));
  const std::int64_t steps = room_ > 0.0 ? Forecast::whole_steps(room_ / std::sqrt(fastest2_)) : 0;
  hold_until_ = std::min(candidates_.hold_until(), courses_.sorted_at() + steps - 1);
}

/// Displacement from the coarse position where it was listed, relative to the common motion.
SkinGuard::Metres SkinGuard::displacement(std::uint32_t slot, const Motion& course,
                                          std::int64_t now) const {
  const CoarsePositions& then = candidates_.when_sorted();
  const FixedVector listed{from_upper(then.x[slot]), from_upper(then.y[slot])};
  const FixedVector way = wrapped_difference(wrapped_difference(course.position, listed),
                                             candidates_.common_motion(now));
  return {state_.box.metres_x(way.x), state_.box.metres_y(way.y)};
}

std::int64_t SkinGuard::note_course(std::uint32_t slot, const Motion& course, std::int64_t now) {
  const auto [x, y] = displacement(slot, course, now);
  const Box& box = state_.box;
  const FixedVector u = wrapped_difference(course.u, candidates_.drift());
  const double ux = box.metres_x(u.x), uy = box.metres_y(u.y);

  fastest2_ = std::max(fastest2_, ux * ux + uy * uy);
  const std::int64_t hold_until = now + steps_within(room_, x, y, ux, uy);
  hold_until_ = std::min(hold_until_, hold_until);
  return hold_until;
}

}  // namespace riesel
