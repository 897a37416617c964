#include "engine/skin_guard.hpp"

#include "engine/free_flight.hpp"

#include <algorithm>
#include <cmath>

namespace riesel {

double room_in_skin(const Box& box, double skin, double tolerance) {
  const double resolution = box.metres_x(from_upper(1)) + box.metres_y(from_upper(1));
  return (0.5 * skin - tolerance - resolution) / generous;
}

SkinGuard::SkinGuard(const State& state, const Candidates& candidates, const Courses& courses,
                     double room)
    : state_(state),
      candidates_(candidates),
      courses_(courses),
      room_(room) {}

std::int64_t SkinGuard::hold_until(SlotRange slots) {
  fastest2_ = 0.0;
  const Grains& g = state_.grains;
  for (std::size_t slot = slots.begin; slot < slots.end; ++slot)
    fastest2_ = std::max(fastest2_, candidates_.squared_speed(state_.box, g.ux[slot], g.uy[slot]));
  return std::min(candidates_.hold_until(),
                  courses_.sorted_at() + Forecast::whole_steps(room_ / std::sqrt(fastest2_)) - 1);
}

std::int64_t SkinGuard::hold_until(std::uint32_t slot, const Motion& course,
                                   std::int64_t now) {
  const Box& box = state_.box;
  const auto common = candidates_.common_motion(now);
  const CoarsePositions& then = candidates_.when_sorted();
  const auto& drift = candidates_.drift();
  const double x = box.metres_x(
      wrapped_difference(wrapped_difference(course.x, from_upper(then.x[slot])), common.x));
  const double y = box.metres_y(
      wrapped_difference(wrapped_difference(course.y, from_upper(then.y[slot])), common.y));
  const double ux = box.metres_x(wrapped_difference(course.ux, drift.x));
  const double uy = box.metres_y(wrapped_difference(course.uy, drift.y));

  const double speed2 = ux * ux + uy * uy;
  fastest2_ = std::max(fastest2_, speed2);
  // The first s with |(x, y) + s (ux, uy)| = room
  const double left = room_ * room_ - x * x - y * y;
  if (left <= 0.0) return now;
  const double outward = x * ux + y * uy;
  const double steps_left = left / (outward + std::sqrt(outward * outward + speed2 * left));
  return now + Forecast::whole_steps(steps_left) - 1;
}

}  // namespace riesel
