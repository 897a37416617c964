// How long the candidates of flights hold.
//
// They hold until a grain has gone half the skin from where it was listed, relative to the common
// motion (Candidates). As courses are straight, the step in which that may happen is known when a
// course is set.
#pragma once

#include "engine/candidates.hpp"
#include "engine/courses.hpp"
#include "engine/state.hpp"

#include <cmath>
#include <cstdint>

namespace riesel {

/// m, how far a course may lead from the coarse position where the grain was listed while the
/// candidates hold, if grains may be off their courses by `tolerance` (m). 0 in a box so large that
/// coarse positions do not resolve the skin: then each step begins with a sorting.
double room_in_skin(const Box& box, double skin, double tolerance);

class SkinGuard {
public:
  /// Keeps references.
  SkinGuard(const State& state, const Candidates& candidates, const Courses& courses);

  /// To be called when these grains have just been listed; `room` (m) is that of room_in_skin().
  void start_over(SlotRange slots, double room);
  /// Notes that the grain has this course from step `now` on. Returns the step until which the
  /// candidates hold for it.
  std::int64_t note_course(std::uint32_t slot, const Motion& course, std::int64_t now);

  /// The step until which the candidates hold for sure as far as these grains are concerned, if all
  /// stay within the tolerance of the courses noted so far.
  std::int64_t hold_until() const { return hold_until_; }

  /// m, how far the grain in `slot`, which moves like this at step `now`, has gone since it was
  /// listed.
  double gone(std::uint32_t slot, const Motion& course, std::int64_t now) const {
    const auto [x, y] = displacement(slot, course, now);
    return std::hypot(x, y);
  }

  /// (m per step)^2, relative to the drift, of the fastest course since the grains were listed.
  double fastest2() const { return fastest2_; }

private:
  struct Metres {
    double x, y;
  };
  Metres displacement(std::uint32_t slot, const Motion& course, std::int64_t now) const;

  const State& state_;
  const Candidates& candidates_;
  const Courses& courses_;
  double room_ = 0.0;  // m
  double fastest2_ = 0.0;
  std::int64_t hold_until_ = 0;
};

}  // namespace riesel
