// Who may touch whom before the grains have moved by the skin: sorting, candidate pairs, and the
// guarantee.
//
// The pairs listed are those closer than the sum of radii plus a skin. They hold as long as no
// grain has moved by half the skin, measured from the common motion of all grains, which brings no
// two of them together: the common fall never triggers a renewal. Instead of looking at all grains
// in every step, a bound is kept on the largest speed (only contacts raise it), and how far it may
// have brought a grain is added up; when that is too far, the true displacements are looked at.
//
// Slices may be ahead of each other by some steps (Askew). Nobody can sort meanwhile, and that the
// candidates hold for so long is only expected. A grain that goes farther is a stray: plain
// stepping looks for whoever it overlaps by itself, flights end the run if there is somebody.
//
// To walls the common motion does bring grains, if gravity is not along them: what is listed as
// near a wall has half a skin more for it, and holds as long as the common fall takes no more.
#pragma once

#include "engine/cells.hpp"
#include "engine/contact_law.hpp"
#include "engine/pair_search.hpp"
#include "engine/slice.hpp"
#include "engine/state.hpp"
#include "engine/team_barrier.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace riesel {

/// m, between the centres of the largest bodies that touch.
double largest_reach(const State& state);

/// Quanta per step along y, half-way between the slowest and the fastest grain.
Fixed middle_velocity(const Grains& grains);

class Candidates {
public:
  /// What serves those who use the candidates.
  struct Purpose {
    /// More means more pairs to look at, less means more sortings.
    double skin_per_diameter;
    bool searched;  ///< as CandidatePairs::searched
  };
  static constexpr Purpose plain_stepping{.skin_per_diameter = 0.35, .searched = true};
  /// As a part of the mean diameter: a period that leaves no room for this skin is too short.
  static constexpr double least_skin = 0.25;

  /// Sorts `state` and takes over its contacts. Throws std::invalid_argument if the box is too
  /// short for the nearest image to be unique, wall grains are too close together, or a contact of
  /// the state cannot be one.
  Candidates(State& state, const SlipLaw& slip, int threads, const Purpose& purpose,
             std::size_t slices_per_thread = 1);

  /// The state has become another one, of the same system or of a part of it: starts from it anew,
  /// as the constructor does. With a `drift` (quanta per step along y) displacements are counted
  /// from that from now on.
  void start_from(State& state, std::optional<Fixed> drift);

  /// How many rows of cells plain stepping has, about.
  static double rows(const State& state);

  std::vector<Slice>& slices() { return slices_; }
  const std::vector<Slice>& slices() const { return slices_; }
  /// The slices of one thread.
  std::span<Slice> share(std::size_t member) {
    const std::size_t each = slices_.size() / team_.members();
    return std::span(slices_).subspan(member * each, each);
  }
  /// Where the threads wait for each other.
  TeamBarrier& team() { return team_; }
  /// There are three slices or more, and the second grain of each pair is in the slice of the first
  /// or in the next.
  bool slices_are_thick() const { return slices_are_thick_; }
  CoarseUnits units() const { return units_; }
  /// The run cannot go on.
  bool in_trouble() const;

  /// Tells the inner lists of `share` how all have been used: before the barrier of a step, when
  /// nobody searches.
  void compare_inner_lists(std::span<Slice> share) const;

  /// The grains of `mine` have moved by a step.
  static void count_motion(Slice& mine) { mine.gone += std::sqrt(mine.fastest2); }
  /// m per step, of any grain, relative to the drift.
  double fastest() const;
  /// The grains of `mine` have moved by the step of `units`. Across, what walls do themselves does
  /// not count.
  void count_way_past_walls(Slice& mine, const StepUnits& units) const;

  /// For how many steps the candidates may be used before this is called again: at least `step`
  /// itself, for which they hold for sure, at most `wanted`. Looks at the true displacements if
  /// need be, and sorts anew if they are too large. If it is more than one step, the second grain
  /// of a pair is in the slice of the first or in the next, and catch_strays() must be called
  /// before each search: no look finds a grain that becomes faster than expected meanwhile. The
  /// grains of `state` and `coarse`, their positions, must be those of `step`. To be called by all
  /// threads of a team after a barrier; all get the same answer, and what it changes is complete
  /// when it returns.
  std::int64_t ready_for(State& state, PackedPositions& coarse, std::span<Slice> share,
                         std::int64_t step, std::int64_t wanted);

  /// The same for `step` and those after it before anybody has moved to it: without a look, and 0
  /// if that is needed. All must have completed the step before.
  std::int64_t steps_ahead(std::int64_t step, std::int64_t wanted) const;

  /// Adds to the candidates of `mine` whoever overlaps a grain that has gone farther than they hold
  /// for. The grains of `mine` and of `next`, the slice after it, are at this step.
  void catch_strays(const State& state, const PackedPositions& coarse, Slice& mine,
                    const Slice& next, std::int64_t step) const;

  /// Sorts and lists all candidates anew. The grains of `state` are at this step. The coarse
  /// positions are those of when_sorted() then. To be called by all threads of a team; what it
  /// changes is complete when it returns.
  void sort_anew(State& state, std::span<Slice> share, std::int64_t step);

  /// Until the next sorting nobody asks for cells: gives their memory to others.
  void forget_cells() { cells_.forget(); }

  /// The candidates hold until this step, and while no grain has moved by half the skin from where
  /// it was when they were listed, relative to a common motion: free fall with a displacement per
  /// step of drift() in the falling frame.
  std::int64_t hold_until() const { return hold_until_; }
  double skin() const { return skin_; }                       ///< m
  double range() const { return 2.0 * max_radius_ + skin_; }  ///< m, the least height of a row
  const CoarsePositions& when_sorted() const { return when_sorted_; }
  const FixedVector& drift() const { return drift_; }    ///< per step
  std::int64_t sorted_at() const { return sorted_at_; }  ///< step
  /// m, no grain has been farther from where it was when the first were listed, relative to the
  /// drift that start_from() was given.
  double wandered() const;
  /// From when they were listed to `step`.
  FixedVector common_motion(std::int64_t step) const;

  /// Tells speeds relative to the drift.
  struct Speedometer {
    FixedVector drift;
    double metre_x, metre_y;  ///< m per quantum

    /// (m per step)^2, of a displacement per step (quanta).
    double squared(const FixedVector& u) const {
      const FixedVector relative = wrapped_difference(u, drift);
      const double vx = real(relative.x) * metre_x;
      const double vy = real(relative.y) * metre_y;
      return vx * vx + vy * vy;
    }
  };
  Speedometer speedometer(const Box& box) const {
    return {drift_, box.quantum_x(), box.quantum_y()};
  }

  /// Calls visit(contact) for the contacts of all slices.
  template <class Visit>
  void for_each_contact(Visit visit) const {
    for (const Slice& slice : slices_)
      for (const LiveContacts* live : {&slice.pair_contacts, &slice.wall_contacts})
        for (std::size_t i = 0; i < live->size(); ++i) visit(live->contact(i));
  }
  /// Of all slices, ordered by name.
  std::vector<Contact> contacts() const;

private:
  std::size_t member_with(std::span<const Slice> share) const {
    return static_cast<std::size_t>(share.data() - slices_.data()) / share.size();
  }
  void wait(std::span<const Slice> share) { team_.arrive_and_wait(member_with(share)); }
  /// How many steps slices may go askew, and how far grains may go after the first of them (m).
  struct Lead {
    std::int64_t steps;
    double way;
  };
  Lead lead(std::int64_t wanted) const;
  void look_again(State& state, PackedPositions& coarse, std::span<Slice> share, std::int64_t step,
                  double ahead);
  void renew(State& state, std::span<Slice> share, std::int64_t step);
  void start_over(const State& state, std::int64_t step);
  void list_pairs(const State& state, Slice& mine, std::vector<SlotPair>& close) const;
  void list_near_walls(const State& state, Slice& mine) const;
  static void list_kicked(const Grains& grains, Slice& mine);
  void measure_displacements(const PackedPositions& coarse, Slice& mine, std::int64_t step) const;
  CoarsePoint coarse_motion(std::int64_t step) const {
    const FixedVector common = common_motion(step);
    return {upper_half(common.x), upper_half(common.y)};
  }
  /// m^2, from where the grain was when sorted, relative to the common motion.
  float squared_displacement(CoarsePoint now, std::size_t slot, CoarsePoint common) const {
    const std::int32_t x = coarse_difference(now.x, when_sorted_.x[slot]);
    const std::int32_t y = coarse_difference(now.y, when_sorted_.y[slot]);
    return units_.square(coarse_difference(x, common.x), coarse_difference(y, common.y));
  }
  double distance(float squared_displacement) const;
  template <class Place>
  double farthest(const Slice& mine, std::int64_t step, Place place) const;
  void note_wandering(const State& state, Slice& mine, std::int64_t step) const;
  void measure_speeds(const State& state, Slice& mine) const;

  // kept_contacts.cpp
  static void set_contacts_aside(Slice& mine);
  ContactSlots after_sorting(ContactSlots before) const {
    return {new_slot_[before.grain], new_slot_[before.partner]};
  }
  void keep(const State& state, std::span<Slice> share, std::span<const ContactSlots> before,
            std::span<const Contact> contacts) const;
  std::size_t kept() const;
  void end_lost_contacts(const State& state, std::int64_t step);

  SlipLaw slip_;       // of the contacts that end in a sorting
  double skin_;        // m
  double max_radius_;  // m
  bool one_size_;      // all grains have this radius
  CoarseUnits units_;
  Cells cells_;
  CoarsePositions when_sorted_;
  TeamBarrier team_;
  std::vector<Slice> slices_;
  bool slices_are_thick_ = false;
  std::vector<std::uint32_t> new_slot_;  // by slots before the last sorting

  FixedVector fall_;                  // in a step
  std::int64_t steps_to_walls_ = 0;   // that the common fall takes for the room it has at walls
  std::optional<Fixed> given_drift_;  // along y, for all listings
  FixedVector drift_{};               // across the tube: at rest when the candidates were listed
  std::int64_t sorted_at_ = 0, hold_until_ = 0;  // steps
};

}  // namespace riesel
