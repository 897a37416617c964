// The courses of grains: the straight paths, in the falling frame, on which they are expected.
//
// While flights go on the store (Grains) holds the course of each grain: where it was when the
// course was set, and its displacement per step since. A flying grain keeps to its course exactly.
// A deflected one, which takes part in a contact, does not; where it is stands elsewhere
// (DeflectedGrains), at a place that is noted here.
#pragma once

#include "engine/aligned.hpp"
#include "engine/cells.hpp"
#include "engine/fixed_point.hpp"
#include "engine/state.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>

namespace riesel {

/// Position, displacement per step and kick of one grain, in quanta; as in Grains.
struct Motion {
  Fixed x, y, ux, uy, kick_x, kick_y, spin, spin_kick;
};

class Courses {
public:
  /// The place of a grain that keeps to its course.
  static constexpr std::int32_t flying = -1;

  explicit Courses(State& state)
      : grains_(state.grains),
        fall_(fall_per_step(state)),
        since_(grains_.size()),
        place_(grains_.size()) {}

  /// The grains have just been sorted; all are at `step`. To be called once for all.
  void start_over(std::int64_t step) { sorted_at_ = step; }
  /// These grains fly. A course must be set anew, or all be started over, within 2^31 steps.
  void start_over(SlotRange slots) {
    std::fill_n(since_.begin() + static_cast<std::ptrdiff_t>(slots.begin), slots.size(), 0);
    std::fill_n(place_.begin() + static_cast<std::ptrdiff_t>(slots.begin), slots.size(), flying);
  }
  std::int64_t sorted_at() const { return sorted_at_; }  ///< step
  const Fall& fall() const { return fall_; }             ///< in a step

  /// When the course was set, in steps after sorted_at().
  std::int32_t since(std::uint32_t slot) const { return since_[slot]; }
  /// Where the grain is in `step` if it keeps to its course.
  Fixed x(std::uint32_t slot, std::int64_t step) const {
    return along(grains_.x[slot], grains_.ux[slot], fall_.x, steps(slot, step), step);
  }
  Fixed y(std::uint32_t slot, std::int64_t step) const {
    return along(grains_.y[slot], grains_.uy[slot], fall_.y, steps(slot, step), step);
  }
  Motion motion(std::uint32_t slot, std::int64_t step) const {
    return {.x = x(slot, step),
            .y = y(slot, step),
            .ux = grains_.ux[slot],
            .uy = grains_.uy[slot],
            .kick_x = grains_.kick_x[slot],
            .kick_y = grains_.kick_y[slot],
            .spin = grains_.spin_of(slot),
            .spin_kick = grains_.spin_kick_of(slot)};
  }

  /// From `step` on the grain is expected to go on like this.
  void set(std::uint32_t slot, const Motion& m, std::int64_t step) {
    grains_.x[slot] = m.x;
    grains_.y[slot] = m.y;
    grains_.ux[slot] = m.ux;
    grains_.uy[slot] = m.uy;
    grains_.kick_x[slot] = m.kick_x;
    grains_.kick_y[slot] = m.kick_y;
    if (grains_.rotate()) {
      grains_.spin[slot] = m.spin;
      grains_.spin_kick[slot] = m.spin_kick;
    }
    since_[slot] = static_cast<std::int32_t>(step - sorted_at_);
  }

  /// Where the deflected grain stands, or `flying`.
  std::int32_t place(std::uint32_t slot) const { return place_[slot]; }
  bool deflected(std::uint32_t slot) const { return place_[slot] != flying; }
  const std::int32_t* places() const { return place_.data(); }  ///< by slot
  void set_place(std::uint32_t slot, std::int32_t place) { place_[slot] = place; }

private:
  /// Along one axis, after the last n steps before `step`.
  static Fixed along(Fixed from, Fixed u, Fixed fall, std::int64_t n, std::int64_t step) {
    return wrapped_sum(from, wrapped_sum(wrapped_product(n, u),
                                         wrapped_product(sum_of_steps(step - n, step), fall)));
  }
  std::int64_t steps(std::uint32_t slot, std::int64_t step) const {
    return step - sorted_at_ - since_[slot];
  }

  Grains& grains_;
  const Fall fall_;
  std::int64_t sorted_at_ = 0;
  AlignedVector<std::int32_t> since_;  // steps after sorted_at_
  AlignedVector<std::int32_t> place_;
};

}  // namespace riesel
