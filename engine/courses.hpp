// The courses of grains: the straight paths, in the falling frame, on which they are expected.
//
// While flights go on the store (Grains) holds the course of each grain: its displacement per step,
// and where it would have been in one step for all, the origin, had it always gone like this. So
// two courses differ by a straight line in any step, whenever they were set: gravity and the time
// since then do not enter. Integers make the detour over the origin exact. Kicks that the store has
// mean nothing meanwhile. A flying grain keeps to its course. A deflected one, which takes part in
// a contact, does not; where it is stands elsewhere (DeflectedGrains), at a place that is noted
// here.
#pragma once

#include "engine/aligned.hpp"
#include "engine/cells.hpp"
#include "engine/fixed_point.hpp"
#include "engine/state.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>

namespace riesel {

/// Position, displacement per step and kick of one grain, in quanta; as in Grains.
struct Motion {
  FixedVector position, u, kick;
  Fixed spin, spin_kick;

  /// As the next step does first.
  void take_up_kick() {
    u = wrapped_sum(u, kick);
    spin = wrapped_sum(spin, spin_kick);
  }
};

class Courses {
public:
  /// The place of a grain that keeps to its course.
  static constexpr std::int32_t flying = -1;

  explicit Courses(State& state)
      : grains_(state.grains), fall_(fall_per_step(state)), place_(grains_.size()) {}

  /// There are more grains, or fewer.
  void resize() { place_.resize(grains_.size()); }
  /// The grains have just been sorted; all are at `step`. To be called once for all.
  void start_over(std::int64_t step) {
    sorted_at_ = step;
    set_origin(step);
  }
  /// The store holds all grains as they are in `step`, which is the origin from now on. To be
  /// called once for all.
  void set_origin(std::int64_t step) { origin_ = step; }
  /// These grains fly.
  void start_over(SlotRange slots) {
    std::fill_n(place_.begin() + static_cast<std::ptrdiff_t>(slots.begin), slots.size(), flying);
  }
  std::int64_t sorted_at() const { return sorted_at_; }  ///< step
  std::int64_t origin() const { return origin_; }        ///< step
  const FixedVector& fall() const { return fall_; }      ///< in a step

  /// Where the grain is in `step` if it keeps to its course.
  FixedVector position(std::uint32_t slot, std::int64_t step) const {
    return wrapped_sum(grains_.position[slot], way(grains_.u[slot], step));
  }
  /// Without kicks, which a grain that keeps to its course does not get.
  Motion motion(std::uint32_t slot, std::int64_t step) const {
    return {.position = position(slot, step),
            .u = grains_.u[slot],
            .kick = {},
            .spin = grains_.spin_of(slot),
            .spin_kick = 0};
  }

  /// From `step` on the grain is expected to go on like this, with no more kicks.
  void set(std::uint32_t slot, const Motion& m, std::int64_t step) {
    grains_.position[slot] = wrapped_difference(m.position, way(m.u, step));
    grains_.u[slot] = m.u;
    if (grains_.rotate()) grains_.spin[slot] = m.spin;
  }
  /// The grain is like this in the step that is about to become the origin.
  void put(std::uint32_t slot, const Motion& m) {
    grains_.position[slot] = m.position;
    grains_.u[slot] = m.u;
    grains_.kick[slot] = m.kick;
    if (!grains_.rotate()) return;
    grains_.spin[slot] = m.spin;
    grains_.spin_kick[slot] = m.spin_kick;
  }

  /// Where the deflected grain stands, or `flying`.
  std::int32_t place(std::uint32_t slot) const { return place_[slot]; }
  bool deflected(std::uint32_t slot) const { return place_[slot] != flying; }
  std::span<const std::int32_t> places() const { return place_; }  ///< by slot
  void set_place(std::uint32_t slot, std::int32_t place) { place_[slot] = place; }

private:
  /// From the origin to `step`.
  FixedVector way(const FixedVector& u, std::int64_t step) const {
    return way_of_flight(u, fall_, origin_, step);
  }

  Grains& grains_;
  const FixedVector fall_;
  std::int64_t sorted_at_ = 0, origin_ = 0;  // steps
  AlignedVector<std::int32_t> place_;
};

}  // namespace riesel
