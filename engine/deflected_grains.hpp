// The deflected grains of a slice: those in contact while all others fly, stepped by vector
// instructions.
//
// As long as a grain is deflected its motion is here, at a fixed index, its place. The store
// meanwhile holds its course, for which its appointments were made (Courses).
#pragma once

#include "engine/aligned.hpp"
#include "engine/courses.hpp"
#include "engine/encounter.hpp"
#include "engine/fixed_point.hpp"
#include "engine/lane_masks.hpp"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace riesel {

class DeflectedGrains {
public:
  using Place = std::uint32_t;

  /// `inertia` as in Grains.
  explicit DeflectedGrains(double inertia) : inertia_(inertia) {}

  /// Adds a grain that is on its course, and moves like this. Returns its place.
  Place take(std::uint32_t slot, const Motion& motion);
  /// Sets the motion of the grain at `place`, which is on its course now.
  void put(Place place, const Motion& motion);
  /// Removes the grain; its place may be given to another.
  void release(Place place);
  void clear();

  /// One past the last place in use; some before it may be free.
  Place end() const { return static_cast<Place>(slots_.size()); }
  bool in_use(Place place) const { return slots_[place] != no_slot; }
  std::uint32_t slot(Place place) const { return slots_[place]; }
  Motion motion(Place place) const;
  const FixedVector& position(std::int64_t place) const {
    return position_[static_cast<std::size_t>(place)];
  }
  Bodies bodies() const;
  /// The number of contacts that the grain has.
  std::int32_t& contacts(Place place) { return contacts_[place]; }

  /// Moves all grains to the next step: velocities take up the kicks. `fallen` (quanta per step) is
  /// StepUnits::fallen of that step.
  void move(const FixedVector& fallen);
  void clear_kicks();
  void add_kick(std::int64_t place, const BodyKick& kick) {
    const auto at = static_cast<std::size_t>(place);
    kick_[at] = wrapped_sum(kick_[at], kick.by);
    if (kick.spin != 0) spin_kick_[at] = wrapped_sum(spin_kick_[at], kick.spin);
  }

  /// To be called when the grain gets a new course: the present motion, the kick included.
  void set_course(Place place);
  /// The grains that will be farther from their courses than the tolerance along an axis (quanta)
  /// in the next step. Must be called exactly once in each step, when all kicks have been added.
  const std::vector<Place>& off_course(Fixed tolerance_x, Fixed tolerance_y);

private:
  static constexpr std::uint32_t no_slot = UINT32_MAX;
  using OffCourse = LaneMasks<std::uint64_t>;

  template <class Visit>
  void for_each_vector(Visit visit) {
    for (auto* vectors : {&position_, &u_, &kick_, &off_, &off_u_}) visit(*vectors);
  }
  bool rotate() const { return inertia_ > 0.0; }
  std::size_t padded_size() const { return OffCourse::padded(slots_.size()); }

  std::vector<std::uint32_t> slots_;
  std::vector<std::int32_t> contacts_;
  // By place; u, kick and off_... are 0 at free places and in the padding, whose positions mean
  // nothing. off_...: actual motion minus course.
  AlignedVector<FixedVector> position_, u_, kick_, off_, off_u_;
  OffCourse masks_;  // of places
  std::vector<Place> free_, off_course_;
  const double inertia_;
  AlignedVector<Fixed> spin_, spin_kick_;  // likewise; empty if grains do not rotate
};

}  // namespace riesel
