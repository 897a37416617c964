// When to look at which candidate: the appointments of one slice.
//
// An appointment is the step before which a candidate (a pair, or a grain near a wall) cannot touch
// as long as the grains keep to their courses. Most are made with a tolerance: they hold as long as
// both grains stay that close to their courses, in contact or not. Those of pairs that are too
// close for that are exact: they must be made anew when one of the two grains is deflected.
#pragma once

#include "engine/border.hpp"
#include "engine/calendar.hpp"
#include "engine/close_watch.hpp"
#include "engine/courses.hpp"
#include "engine/deflected_grains.hpp"
#include "engine/encounter.hpp"
#include "engine/free_flight.hpp"
#include "engine/selection.hpp"
#include "engine/slice.hpp"
#include "engine/state.hpp"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace riesel {

/// The step in which a candidate is due, and whether that is exact, in one word of 32 bits, as
/// there are many.
class Appointment {
public:
  static constexpr std::int32_t never = -1;

  /// `step` is counted since the candidates were listed: 0 <= step < 2^30, or `never`.
  Appointment(std::int32_t step, bool exact) : word_(2 * step + (exact ? 1 : 0)) {}
  /// Of pair number i of the CloseWatch; exact.
  static Appointment watched(std::size_t i) {
    return {first_watched - static_cast<std::int32_t>(i), true};
  }
  /// Of a pair in contact, which is not looked at.
  static Appointment in_contact() { return {touching, false}; }

  bool is_for(std::int32_t step) const { return word_ >> 1 == step; }
  bool is_in_contact() const { return word_ >> 1 == touching; }
  bool is_watched() const { return word_ >> 1 <= first_watched; }
  std::size_t watched_as() const { return static_cast<std::size_t>(first_watched - (word_ >> 1)); }
  bool exact() const { return (word_ & 1) != 0; }
  void cancel() { *this = {never, exact()}; }
  /// Becomes `other` if `mask` is -1, stays as it is if `mask` is 0. Bit operations, because GCC
  /// makes a branch of ?:.
  void replace_by(Appointment other, std::int32_t mask) {
    word_ = (word_ & ~mask) | (other.word_ & mask);
  }

private:
  static constexpr std::int32_t touching = -2, first_watched = -3;

  std::int32_t word_;
};

class Appointments {
public:
  /// Keeps references.
  Appointments(const State& state, const Slice& slice, const Courses& courses, const Border& border)
      : state_(state), slice_(slice), courses_(courses), border_(border), close_watch_(courses) {}

  /// To be called when the candidates of the slice have just been listed: none has an appointment.
  /// Deflected grains may be off their courses by `tolerance` (m) from now on.
  void start_over(double tolerance);

  /// These note candidates for a new appointment by the next make(): all of a grain; those of a
  /// grain with an exact appointment; a pair, or a grain near a wall, by its index in the slice.
  void reconsider(std::uint32_t slot);
  void reconsider_exact(std::uint32_t slot);
  void reconsider_pair(std::uint32_t pair) { reconsidered_.add(pair); }
  void reconsider_near_wall(std::uint32_t near_wall) {
    reconsidered_.add(pair_count() + near_wall);
  }

  /// To be called when the pair begins to touch, and when it ends: then it is noted for a new
  /// appointment.
  void begin_contact(std::uint32_t pair) { due_[pair] = Appointment::in_contact(); }
  void end_contact(std::uint32_t pair) {
    due_[pair] = {Appointment::never, false};
    reconsider_pair(pair);
  }
  /// For a pair so close that nothing can be foreseen; `deflected` (1 or 2) of its grains may be
  /// off their courses.
  void make_for_next_step(std::uint32_t pair, std::int64_t now, int deflected);
  /// Has the pair watched from the next step on: see CloseWatch::add().
  void watch(std::uint32_t pair, std::uint32_t first, std::uint32_t second, double reach,
             double far, std::int64_t step);
  /// Makes the appointments of all candidates that were noted, from their courses at step `now`:
  /// none before `earliest`, and none after `hold_until` (or `earliest` if that is later).
  void make(std::int64_t now, std::int64_t earliest, std::int64_t hold_until);
  /// The same for those of them without a foreign grain; the others stay noted.
  void make_inside(std::int64_t now, std::int64_t earliest, std::int64_t hold_until);
  /// The same for all candidates of the slice, right after start_over().
  void make_all(std::int64_t now, std::int64_t earliest, std::int64_t hold_until);

  /// Calls look_at_pair(index) and look_at_near_wall(index) for the candidates that are due, whose
  /// appointment or watch is over then. `units` and `deflected` must be those of `step`.
  template <class LookAtPair, class LookAtNearWall>
  void keep(std::int64_t step, const StepUnits& units, const DeflectedGrains& deflected,
            LookAtPair look_at_pair, LookAtNearWall look_at_near_wall) {
    for (const std::uint32_t pair : close_watch_.due_in(units, deflected)) {
      end_watch(pair);
      look_at_pair(pair);
    }
    const auto today = calendar_.due_in(step);
    const std::int32_t now = since_sorted(step);
    for (const std::uint32_t candidate : today) {
      if (!due_[candidate].is_for(now)) continue;  // it has another appointment since
      due_[candidate].cancel();
      if (candidate < pair_count())
        look_at_pair(candidate);
      else
        look_at_near_wall(candidate - pair_count());
    }
  }

  /// Loads what is known of the candidates into the caches.
  void fetch() const;

private:
  void link();
  template <class Wanted>
  void reconsider_if(std::uint32_t slot, Wanted wanted);
  bool is_watched_on(std::uint32_t pair);
  void end_watch(std::uint32_t pair);
  struct Period {
    std::int64_t now, earliest, latest;  // steps
  };
  void enter_pairs(std::span<const std::uint32_t> pairs, const Forecast& forecast,
                   const Period& period);
  void enter(std::uint32_t candidate, std::int64_t free_steps, bool exact, const Period& period);
  double free_steps_at_wall(const NearWall& near, std::int64_t now) const;

  /// Candidates are numbered: the pairs first, then the grains near walls.
  std::uint32_t pair_count() const { return static_cast<std::uint32_t>(slice_.pairs.size()); }
  std::int32_t since_sorted(std::int64_t step) const {
    return static_cast<std::int32_t>(step - courses_.sorted_at());
  }

  const State& state_;
  const Slice& slice_;
  const Courses& courses_;
  const Border& border_;
  double tolerance_ = 0.0;  // m

  Calendar calendar_;
  std::vector<Appointment> due_;  // of each candidate
  /// Where the candidates of a grain begin: those pairs of which it is the first grain (consecutive
  /// indices), and the others in links_.
  struct First {
    std::uint32_t pair = 0, link = 0;
  };
  std::vector<First> first_;          // by Border::number(), and one more for the end
  std::vector<std::uint32_t> links_;  // candidates; like due_, with some room to read at the end
  Selection reconsidered_;            // candidates
  Selection put_off_;                 // candidates, scratch of make_inside()
  CloseWatch close_watch_;
};

}  // namespace riesel
