// Which pairs may touch before the next sorting: sorting, candidate pairs, and how long they hold.
//
// The pairs listed are those closer than the sum of radii plus a skin. They hold (no other pair can
// touch) as long as no grain has moved by half the skin relative to the common motion of all
// grains, which brings no two of them together: so the common fall never triggers a new listing.
// Instead of measuring all grains in every step, a bound on the largest speed is kept (only
// contacts raise it) and added up; only when this sum exceeds half the skin are the true
// displacements measured.
//
// Slices may be ahead of each other by some steps (Askew). No sorting is possible meanwhile, and
// that the candidates hold for so long is only expected. A grain that goes farther is a stray:
// plain stepping searches for whatever it overlaps one by one, flights end the run if there is
// anything.
//
// The common motion does bring grains closer to walls, if gravity has a component across them. So
// grains are listed as near a wall up to half a skin farther away, and the candidates hold only
// until the common fall has used that up.
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

/// m, the largest sum of radii of two bodies of `state`, which must have grains.
double largest_reach(const State& state);

/// Quanta per step along y, half-way between the slowest and the fastest grain (in the falling
/// frame). There must be a grain.
Fixed middle_velocity(const Grains& grains);

class Candidates {
public:
  /// What depends on how the grains are stepped.
  struct Purpose {
    /// Skin over the mean diameter. A larger one means more pairs, a smaller one more sortings.
    double skin_per_diameter;
    bool searched;  ///< as CandidatePairs::searched
  };
  static constexpr Purpose plain_stepping{.skin_per_diameter = 0.35, .searched = true};
  /// Over the mean diameter: a period that leaves no room for such a skin is rejected.
  static constexpr double least_skin = 0.25;

  /// Sorts `state` and takes over its contacts. Throws std::invalid_argument if the box is too
  /// short for the nearest image to be unique, wall grains are too close together, or a contact of
  /// the state is between bodies that are no candidates, and RunFailure as as_a_team() does.
  Candidates(State& state, const SlipLaw& slip, int threads, const Purpose& purpose,
             std::size_t slices_per_thread);

  /// Starts anew, as the constructor does, from a `state` that has changed: another one of the same
  /// system or of a part of it. If `drift` is given (quanta per step along y), it is the common
  /// motion from which displacements are measured from now on. Throws as the constructor.
  void start_from(State& state, std::optional<Fixed> drift);

  /// About how many rows of cells plain stepping has.
  static double rows(const State& state);

  std::vector<Slice>& slices() { return slices_; }
  const std::vector<Slice>& slices() const { return slices_; }
  /// The slices of thread number `member`.
  std::span<Slice> share(std::size_t member) {
    const std::size_t each = slices_.size() / team_.members();
    return std::span(slices_).subspan(member * each, each);
  }
  /// Where the threads wait for each other.
  TeamBarrier& team() { return team_; }
  /// Whether there are three slices or more, and the second grain of each pair is in the slice of
  /// the first or in the next.
  bool slices_are_thick() const { return slices_are_thick_; }
  CoarseUnits units() const { return units_; }
  /// Whether the run cannot go on.
  bool in_trouble() const;

  /// Tells the inner lists of `share` the use that all slices have made of theirs. To be called
  /// before the barrier of a step, while no thread searches.
  void compare_inner_lists(std::span<Slice> share) const;

  /// Adds a step to the bound on the displacements of `mine`: its grains have just moved.
  static void count_motion(Slice& mine) { mine.gone += std::sqrt(mine.fastest2); }
  /// m per step, bound on the speed of any grain relative to the drift.
  double fastest() const;
  /// Adds the step of `units`, by which the grains of `mine` have moved, to the bounds on how far
  /// they may have gone past the walls. The one across the tube leaves out the motion of the walls:
  /// WallLattice::extent() covers it.
  void count_way_past_walls(Slice& mine, const StepUnits& units) const;

  /// Returns for how many steps, 1 ... `wanted`, the candidates may be used before this is called
  /// again. The first of them is `step` itself, for which they hold for sure. Measures the true
  /// displacements if need be, and sorts anew if they are too large. If the answer is more than 1,
  /// slices_are_thick(), and catch_strays() must be called before each search, as nothing else
  /// finds a grain that becomes faster than expected meanwhile. The grains of `state`, and their
  /// positions in `coarse`, must be those of `step`. To be called by all threads of the team after
  /// a barrier; all get the same answer, and what it changes is complete when it returns.
  std::int64_t ready_for(State& state, PackedPositions& coarse, std::span<Slice> share,
                         std::int64_t step, std::int64_t wanted);

  /// The same before any grain has moved to `step`, from the bounds alone; 0 if these do not
  /// suffice. All slices must have completed the step before.
  std::int64_t steps_ahead(std::int64_t step, std::int64_t wanted) const;

  /// Adds to the candidates of `mine` the pairs that overlap and have a stray: a grain that has
  /// gone so far that the candidates do not hold for it. The grains of `mine` and of `next`, the
  /// slice after it, must be at `step`.
  void catch_strays(const State& state, const PackedPositions& coarse, Slice& mine,
                    const Slice& next, std::int64_t step) const;

  /// Sorts, and lists all candidates anew. The grains of `state` must be at `step`; when_sorted()
  /// has their coarse positions afterwards. To be called by all threads of the team; what it
  /// changes is complete when it returns.
  void sort_anew(State& state, std::span<Slice> share, std::int64_t step);

  /// Frees the memory of the cells, which nothing needs before the next sorting.
  void forget_cells() { cells_.forget(); }

  /// The step until which the candidates hold, provided that no grain moves by half the skin from
  /// where it was when they were listed, relative to the common motion: free fall with a
  /// displacement per step of drift() in the falling frame.
  std::int64_t hold_until() const { return hold_until_; }
  double skin() const { return skin_; }                       ///< m
  double range() const { return 2.0 * max_radius_ + skin_; }  ///< m, the least height of a row
  /// Whether a stray that has gone this far (m) may be past the slices that are searched for it.
  bool is_beyond_search(double gone) const { return gone > range(); }
  const CoarsePositions& when_sorted() const { return when_sorted_; }
  const FixedVector& drift() const { return drift_; }    ///< quanta per step
  std::int64_t sorted_at() const { return sorted_at_; }  ///< step
  /// m, bound on how far any grain has been from where it was at start_from(), relative to the
  /// drift given there.
  double wandered() const;
  /// Quanta, the common motion from when the candidates were listed to `step`.
  FixedVector common_motion(std::int64_t step) const;

  /// Measures speeds relative to the drift.
  struct Speedometer {
    FixedVector drift;
    double metre_x, metre_y;  ///< m per quantum

    /// (m per step)^2, of the displacement per step `u` (quanta).
    [[gnu::always_inline]] double squared(Lanes u) const {
      using Signed = Fixed __attribute__((vector_size(sizeof(Lanes))));
      using Reals = double __attribute__((vector_size(sizeof(Lanes))));
      const auto relative = reinterpret_cast<Signed>(u - lanes_of(drift));
      const Reals way = __builtin_convertvector(relative, Reals) * Reals{metre_x, metre_y};
      const Reals squares = way * way;
      return squares[0] + squares[1];
    }
  };
  Speedometer speedometer(const Box& box) const {
    return {drift_, box.quantum_x(), box.quantum_y()};
  }

  /// Calls visit(contact) for the present contacts of all slices.
  template <class Visit>
  void for_each_contact(Visit visit) const {
    for (const Slice& slice : slices_)
      for (const LiveContacts* live : {&slice.pair_contacts, &slice.wall_contacts})
        for (std::size_t i = 0; i < live->size(); ++i) visit(live->contact(i));
  }
  /// The present contacts of all slices, ordered by name.
  std::vector<Contact> contacts() const;

private:
  std::size_t member_with(std::span<const Slice> share) const {
    return static_cast<std::size_t>(share.data() - slices_.data()) / share.size();
  }
  void wait(std::span<const Slice> share) { team_.arrive_and_wait(member_with(share)); }
  /// How many steps slices may go askew, and how far grains are granted to go after the first (m).
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

  FixedVector fall_;                  // quanta per step^2
  std::int64_t steps_to_walls_ = 0;   // until the common fall has used up its room at walls
  std::optional<Fixed> given_drift_;  // along y, for all listings
  FixedVector drift_{};               // its x is that of a grain at rest when last sorted
  std::int64_t sorted_at_ = 0, hold_until_ = 0;  // steps
};

}  // namespace riesel
