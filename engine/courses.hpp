// The courses of grains: the paths, straight in the falling frame, on which they are expected.
//
// During flights the store (State::grains) holds the course of each grain: its displacement per
// step, and the position that it would have had at one step common to all, the origin, had it
// always moved like this. So the relative path of two grains is a straight line through the
// difference of the stored positions, whenever their courses were set; gravity cancels. Integers
// make this extrapolation to the origin exact. The kicks in the store have no meaning meanwhile.
// A flying grain keeps to its course. A deflected one, which takes part in a contact, does not: its
// motion is in DeflectedGrains, at a place that is noted here.
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

  /// What the next step does first.
  void take_up_kick() {
    u = wrapped_sum(u, kick);
    spin = wrapped_sum(spin, spin_kick);
  }
};

class Courses {
public:
  /// place() of a grain that keeps to its course.
  static constexpr std::int32_t flying = -1;

  explicit Courses(State& state)
      : grains_(state.grains), fall_(fall_per_step(state)), place_(grains_.size()) {}

  /// To be called when the number of grains has changed.
  void resize() { place_.resize(grains_.size()); }
  /// The grains have just been sorted; all are at `step`. To be called by one thread only.
  void start_over(std::int64_t step) {
    sorted_at_ = step;
    set_origin(step);
  }
  /// The store holds all grains as they are in `step`, which is the origin from now on. To be
  /// called by one thread only.
  void set_origin(std::int64_t step) { origin_ = step; }
  /// Marks these grains as flying. To be called by the thread that has them.
  void start_over(SlotRange slots) {
    std::fill_n(place_.begin() + static_cast<std::ptrdiff_t>(slots.begin), slots.size(), flying);
  }
  std::int64_t sorted_at() const { return sorted_at_; }  ///< step
  std::int64_t origin() const { return origin_; }        ///< step
  const FixedVector& fall() const { return fall_; }      ///< quanta per step^2

  /// Where the grain is in `step` if it keeps to its course.
  FixedVector position(std::uint32_t slot, std::int64_t step) const {
    return wrapped_sum(grains_.position[slot], way(grains_.u[slot], step));
  }
  /// The motion in `step` of a grain that keeps to its course; it gets no kicks.
  Motion motion(std::uint32_t slot, std::int64_t step) const {
    return {.position = position(slot, step),
            .u = grains_.u[slot],
            .kick = {},
            .spin = grains_.spin_of(slot),
            .spin_kick = 0};
  }

  /// Gives the grain a new course: as `m` at `step`, and without further kicks.
  void set(std::uint32_t slot, const Motion& m, std::int64_t step) {
    grains_.position[slot] = wrapped_difference(m.position, way(m.u, step));
    grains_.u[slot] = m.u;
    if (grains_.rotate()) grains_.spin[slot] = m.spin;
  }
  /// Writes the motion at the step that is about to become the origin, kicks included: at landing.
  void put(std::uint32_t slot, const Motion& m) {
    grains_.position[slot] = m.position;
    grains_.u[slot] = m.u;
    grains_.kick[slot] = m.kick;
    if (!grains_.rotate()) return;
    grains_.spin[slot] = m.spin;
    grains_.spin_kick[slot] = m.spin_kick;
  }

  /// Index of a deflected grain in the DeflectedGrains of its slice, or `flying`.
  std::int32_t place(std::uint32_t slot) const { return place_[slot]; }
  bool deflected(std::uint32_t slot) const { return place_[slot] != flying; }
  std::span<const std::int32_t> places() const { return place_; }  ///< by slot
  void set_place(std::uint32_t slot, std::int32_t place) { place_[slot] = place; }

private:
  /// Displacement from the origin to `step`.
  FixedVector way(const FixedVector& u, std::int64_t step) const {
    return way_of_flight(u, fall_, origin_, step);
  }

  Grains& grains_;
  const FixedVector fall_;
  std::int64_t sorted_at_ = 0, origin_ = 0;  // steps
  AlignedVector<std::int32_t> place_;
};

}  // namespace riesel
