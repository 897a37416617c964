// What crosses the borders between the slices of flights.
//
// A pair belongs to the slice of its first grain. The second grain may be foreign: of another
// slice, which alone changes its course, place and motion. Once per step each slice announces what
// others need to know of its grains, and reports (as deeds) what its contacts did to foreign ones.
// "Slices before this one" have grains of this one in their pairs, and deeds for them; grains of
// "slices after this one" are foreign here. If slices are thick (Candidates) that is one slice on
// either side, else each other slice is both.
#pragma once

#include "engine/aligned.hpp"
#include "engine/courses.hpp"
#include "engine/deflected_grains.hpp"
#include "engine/slice.hpp"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace riesel {

/// What contacts of one slice did to a grain of another: a kick, or the beginning or end of a
/// contact.
struct Deed {
  std::uint32_t slot;
  BodyKick kick;
  std::int32_t contacts;  ///< change of its number of contacts
};

/// A grain for which the candidates do not hold any more from this step on.
struct Stray {
  std::uint32_t slot;
  std::int64_t step;
};

/// What one slice tells the others. What they read in each step is on cache lines that are written
/// to only if there is news, as a line has to come from another core only after it was written.
struct alignas(cache_line) Announcement {
  std::vector<std::uint32_t> foreign;     ///< slots that are foreign to this slice, increasing
  std::vector<std::uint32_t> border;      ///< own slots that are foreign to another, increasing
  AlignedVector<std::uint8_t> deflected;  ///< whether each of the border is, after the last step
  AlignedVector<Motion> motions;          ///< by index in `border`; set for those that are
  static_assert(sizeof(Motion) == cache_line);  // each may be written while others are read

  alignas(cache_line) std::vector<Deed> deeds;

  /// Grains of `border` that got a new course in the last step.
  alignas(cache_line) std::vector<std::uint32_t> new_courses;
  std::int64_t hold_until = 0;  ///< step until which the candidates hold for sure
  double fastest2 = 0.0;        ///< (m per step)^2, as SkinGuard::fastest2()
  bool trouble = false;         ///< the run cannot go on
  std::size_t contacts = 0;     ///< that the slice had when the candidates were listed
  std::vector<Stray> strays;    ///< while slices are askew
};

/// Sets `told` to `now`, but writes only if that is a change: see Announcement.
template <class T>
void tell_news(T& told, const T& now) {
  if (told != now) told = now;
}

/// The borders of one slice.
class Border {
public:
  /// `announcements` are of all slices, in their order. Keeps references.
  Border(const Slice& slice, const Courses& courses, std::vector<Announcement>& announcements,
         std::size_t index)
      : slice_(slice), courses_(courses), announcements_(announcements), index_(index) {}

  bool owns(std::uint32_t slot) const { return slice_.owns(slot); }

  /// To be called when the candidates have been listed: finds the slices before and after this one.
  void find_neighbours(bool slices_are_thick);
  /// Likewise: lists the slots that are foreign to this slice.
  void list_foreign();
  /// After all slices have called list_foreign(): lists the own grains that are foreign to others.
  void list_border();

  const std::vector<std::uint32_t>& foreign() const { return mine().foreign; }
  bool is_foreign(std::uint32_t slot) const;
  /// Numbers the own slots 0, 1, ..., and after them the foreign ones.
  std::size_t number(std::uint32_t slot) const {
    return owns(slot) ? slot - slice_.begin : number_of_foreign(slot);
  }
  std::size_t numbered() const { return slice_.end - slice_.begin + foreign().size(); }

  /// Announces the motion of the own grains of the border after `step`.
  void announce_motion(const DeflectedGrains& deflected, std::int64_t step);
  /// The motion of a foreign grain at `step`, which must be the step announced last or the next
  /// one. `fallen` is StepUnits::fallen of `step`.
  Motion foreign_motion(std::uint32_t slot, std::int64_t step, const FixedVector& fallen) const;

  Announcement& mine() { return announcements_[index_]; }
  const Announcement& mine() const { return announcements_[index_]; }
  /// Whether an own grain is at the border: foreign to another slice.
  bool is_at_border(std::uint32_t slot) const;
  /// Announces that an own grain has a new course, if it is at the border.
  void announce_course(std::uint32_t slot);

  /// Calls visit(announcement) for those of the slices before this one, or after it.
  template <class Visit>
  void for_each_before(Visit visit) const {
    for (const std::size_t i : before_) visit(static_cast<const Announcement&>(announcements_[i]));
  }
  template <class Visit>
  void for_each_after(Visit visit) const {
    for (const std::size_t i : after_) visit(static_cast<const Announcement&>(announcements_[i]));
  }

  const std::vector<std::size_t>& after() const { return after_; }

private:
  std::size_t number_of_foreign(std::uint32_t slot) const;

  const Slice& slice_;
  const Courses& courses_;
  std::vector<Announcement>& announcements_;
  const std::size_t index_;
  std::vector<std::size_t> before_, after_;
  std::int64_t announced_ = 0;  // step of the last announcement; the same for the slices after
};

}  // namespace riesel
