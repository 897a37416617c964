// How long the candidates of flights hold.
//
// They do until a grain has gone half the skin from where it was listed, relative to the common
// motion (Candidates). As courses are straight, the step in which that may happen is known when a
// course is set.
#pragma once

#include "engine/candidates.hpp"
#include "engine/courses.hpp"
#include "engine/state.hpp"

#include <cstddef>
#include <cstdint>

namespace riesel {

class SkinGuard {
public:
  /// A grain may be farther from its course than that by `tolerance` (m). Keeps references.
  SkinGuard(const State& state, const Candidates& candidates, const Courses& courses,
            double tolerance);

  /// The candidates hold for this step for sure if all of these grains, which have just been
  /// listed, keep to their courses.
  std::int64_t hold_until(SlotRange slots) const;
  /// The same for one grain that goes on like this from step `now` on.
  std::int64_t hold_until(std::uint32_t slot, const Motion& course, std::int64_t now) const;

private:
  const State& state_;
  const Candidates& candidates_;
  const Courses& courses_;
  const double room_;  // m
};

}  // namespace riesel
