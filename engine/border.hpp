// What crosses the borders between the slices of flights.
//
// A pair belongs to the slice of its first grain; the second may be foreign: of another slice,
// where alone its course, its place and its motion are changed. What others need to know of a grain
// its slice announces once per step, and what the contacts of others do to it is told to its slice.
// Slices before this one have grains of it in their pairs and do things to them; of those after it
// this one has grains in its pairs. If slices are thick (Candidates) that is one on either side,
// else all others are both.
#pragma once

#include "engine/aligned.hpp"
#include "engine/courses.hpp"
#include "engine/deflected_grains.hpp"
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

/// A grain for which the candidates do not hold any more from this step on.
struct Stray {
  std::uint32_t slot;
  std::int64_t step;
};

/// What one slice tells the others. What they read in each step stands on lines that are written to
/// only if there is news, for then alone they have to come from another core.
struct alignas(cache_line) Announcement {
  std::vector<std::uint32_t> foreign;     ///< slots that are foreign here, increasing
  std::vector<std::uint32_t> border;      ///< own grains that are foreign elsewhere, increasing
  AlignedVector<std::uint8_t> deflected;  ///< whether each of the border is, after the last step
  AlignedVector<Motion> motions;          ///< of those that are
  static_assert(sizeof(Motion) == cache_line);  // each may be written while others are read

  alignas(cache_line) std::vector<Deed> deeds;

  alignas(cache_line) std::vector<std::uint32_t> new_courses;  ///< own grains of the border
  std::int64_t hold_until = 0;  ///< step until which the candidates hold for sure
  double fastest2 = 0.0;        ///< (m per step)^2, as SkinGuard::fastest2()
  bool trouble = false;         ///< the run cannot go on
  std::size_t contacts = 0;     ///< that the slice had when the candidates were listed
  std::vector<Stray> strays;    ///< while slices are askew
};

/// Writes it if it is news.
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

  /// After the candidates have been listed: who is before and who after this slice.
  void find_neighbours(bool slices_are_thick);
  /// Likewise: which slots are foreign here.
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

  /// Announces what the grains of the border do after `step`. All slices announce the same step.
  void announce_motion(const DeflectedGrains& deflected, std::int64_t step);
  /// Of a foreign grain in `step`, that of the announcements or the next; `fallen` is the fall in
  /// this step.
  Motion foreign_motion(std::uint32_t slot, std::int64_t step, const FixedVector& fallen) const;

  Announcement& mine() { return announcements_[index_]; }
  const Announcement& mine() const { return announcements_[index_]; }
  /// Whether an own grain is at the border: foreign elsewhere.
  bool is_at_border(std::uint32_t slot) const;
  /// Announces it if it is.
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
  std::int64_t announced_ = 0;  // the last step of which motion was announced, by all slices
};

}  // namespace riesel
