// How long the candidates of flights hold.
//
// They do until a grain has gone half the skin from where it was listed, relative to the common
// motion (Candidates). As courses are straight, the step in which that may happen is known when a
// course is set.
#pragma once

#include "engine/candidates.hpp"
#include "engine/courses.hpp"
#include "engine/state.hpp"

#include <cmath>
#include <cstddef>
#include <cstdint>

namespace riesel {

/// m, how far a course may lead from where the grain was listed, coarsely, before the candidates
/// fail, if a grain may be off its course by `tolerance`.
double room_in_skin(const Box& box, double skin, double tolerance);

class SkinGuard {
public:
  /// Keeps references.
  SkinGuard(const State& state, const Candidates& candidates, const Courses& courses);

  /// These grains have just been listed; `room` as room_in_skin().
  void start_over(SlotRange slots, double room);
  /// A grain goes on like this from step `now` on. Returns the step until which the candidates hold
  /// for it.
  std::int64_t note_course(std::uint32_t slot, const Motion& course, std::int64_t now);

  /// The step until which the candidates hold for sure, as far as these grains are concerned, if
  /// they keep to the courses noted so far.
  std::int64_t hold_until() const { return hold_until_; }

  /// m, how far such a grain has gone by `now` since it was listed.
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
