// What crosses the borders between the slices of flights.
//
// A pair belongs to the slice of its first grain; the second may be foreign: of another slice,
// where alone its course, its place and its motion are changed. What others need to know of a grain
// its slice announces once per step, and what the contacts of others do to it is told to its slice.
// There are two barriers in a step: announcements are written between the first and the second and
// read after the second, what was done to foreign grains is written after the second and read
// between the first and the second. Courses in the store are set between the first and the second
// and may be read by all after the second.
#pragma once

#include "engine/aligned.hpp"
#include "engine/courses.hpp"
#include "engine/slice.hpp"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace riesel {

/// What contacts of one slice do to a grain of another: a kick, a beginning, an end.
struct Deed {
  std::uint32_t slot;
  BodyKick kick;
  std::int32_t contacts;  ///< this many more
};

/// A grain that is foreign in pairs of other slices, after a step.
struct BorderGrain {
  std::uint32_t slot;
  bool deflected;
  Motion motion;  ///< if deflected
};

/// What one slice tells the others.
struct alignas(cache_line) Announcement {
  std::vector<Deed> deeds;

  std::vector<std::uint32_t> foreign;      ///< slots that are foreign here, increasing
  std::vector<BorderGrain> border;         ///< own grains that are foreign elsewhere, increasing
  std::int64_t step = 0;                   ///< that of their motion
  std::vector<std::uint32_t> new_courses;  ///< own grains of the border that have one
  std::int64_t hold_until = 0;             ///< step until which the candidates hold for sure
  bool trouble = false;                    ///< the run cannot go on
};

/// The borders of one slice.
class Border {
public:
  /// `announcements` are of all slices, in their order. Keeps references.
  Border(const Slice& slice, const Courses& courses, std::vector<Announcement>& announcements,
         std::size_t index)
      : slice_(slice), courses_(courses), announcements_(announcements), index_(index) {}

  bool owns(std::uint32_t slot) const { return slice_.owns(slot); }

  /// After the candidates have been listed: which slots are foreign here.
  void list_foreign();
  /// After all slices have: which own grains are foreign elsewhere.
  void list_border();

  const std::vector<std::uint32_t>& foreign() const { return mine().foreign; }
  bool is_foreign(std::uint32_t slot) const;
  /// Numbers the slots of the slice, 0 ..., and after them those that are foreign here.
  std::size_t number(std::uint32_t slot) const {
    return owns(slot) ? slot - slice_.begin : number_of_foreign(slot);
  }
  std::size_t numbered() const { return slice_.end - slice_.begin + foreign().size(); }

  /// Of a foreign grain in `step`, that of the announcement or the next; `fallen` is the fall in
  /// this step.
  Motion foreign_motion(std::uint32_t slot, std::int64_t step, const Fall& fallen) const;

  Announcement& mine() { return announcements_[index_]; }
  const Announcement& mine() const { return announcements_[index_]; }
  /// Announces it if it is at the border.
  void announce_course(std::uint32_t slot);

  /// Calls visit(announcement) for those of the other slices.
  template <class Visit>
  void for_each_other(Visit visit) const {
    for (std::size_t i = 0; i < announcements_.size(); ++i)
      if (i != index_) visit(static_cast<const Announcement&>(announcements_[i]));
  }

private:
  std::size_t number_of_foreign(std::uint32_t slot) const;

  const Slice& slice_;
  const Courses& courses_;
  std::vector<Announcement>& announcements_;
  const std::size_t index_;
};

}  // namespace riesel
