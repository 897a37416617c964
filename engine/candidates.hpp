// Who may touch whom before the grains have moved by the skin: sorting, candidate pairs, and the
// guarantee.
//
// The pairs listed are those closer than the sum of radii plus a skin. They hold as long as no
// grain has moved by half the skin, measured from the common motion of all grains, which brings no
// two of them together: the common fall never triggers a renewal. Instead of looking at all grains
// in every step, a bound is kept on the largest speed (only contacts raise it) and subtracted from
// a budget of displacement; when the budget is used up, the true displacements are looked at.
//
// To walls the common motion does bring grains, if gravity is not along them: what is listed as
// near a wall has half a skin more for it, and holds as long as the common fall takes no more.
#pragma once

#include "engine/cells.hpp"
#include "engine/contact_law.hpp"
#include "engine/pair_search.hpp"
#include "engine/slice.hpp"
#include "engine/state.hpp"

#include <algorithm>
#include <cstdint>
#include <optional>
#include <vector>

namespace riesel {

class Candidates {
public:
  /// The skin as a part of the mean diameter: more means more pairs to look at, less means more
  /// sortings. This one serves plain stepping.
  static constexpr double short_skin = 0.35;
  /// A period that leaves no room for this one is too short.
  static constexpr double least_skin = 0.25;

  /// Sorts `state` and takes over its contacts. Throws std::invalid_argument if the box is too
  /// short for the nearest image to be unique, wall grains are too close together, or a contact of
  /// the state cannot be one.
  Candidates(State& state, const SlipLaw& slip, int threads, double skin_per_diameter);

  std::vector<Slice>& slices() { return slices_; }
  const std::vector<Slice>& slices() const { return slices_; }
  CoarseUnits units() const { return units_; }

  /// Tells the inner list of `mine` how all have been used: before the barrier of a step, when
  /// nobody searches.
  void compare_inner_lists(Slice& mine) const;

  /// Spends the motion of `step` of the budget. True if the candidates hold for sure; else
  /// look_again() must be called before they are used. All threads of a team, called after a
  /// barrier, get the same answer.
  bool spend_step(Slice& mine, std::int64_t step) const;

  /// Looks at the true displacements, and sorts anew if they are too large: then true. `state` and
  /// `coarse`, the positions of its grains, must be those of step `step`. To be called by all
  /// threads of a team; what it changes is complete when it returns.
  bool look_again(State& state, CoarsePositions& coarse, Slice& mine, std::int64_t step);

  /// Sorts and lists all candidates anew; else as look_again(). The coarse positions are those of
  /// when_sorted() then.
  void sort_anew(State& state, Slice& mine, std::int64_t step);

  /// The candidates hold until this step, and while no grain has moved by half the skin from where
  /// it was when they were listed, relative to a common motion: free fall with a displacement per
  /// step of drift() in the falling frame.
  std::int64_t hold_until() const { return hold_until_; }
  double skin() const { return skin_; }  ///< m
  const CoarsePositions& when_sorted() const { return when_sorted_; }
  struct Displacement {
    Fixed x, y;  ///< quanta
  };
  const Displacement& drift() const { return drift_; }  ///< per step
  /// From when they were listed to `step`.
  Displacement common_motion(std::int64_t step) const;

  /// (m per step)^2, of a displacement per step (quanta) relative to the drift.
  double squared_speed(const Box& box, Fixed ux, Fixed uy) const {
    const double vx = box.metres_x(wrapped_difference(ux, drift_.x));
    const double vy = box.metres_y(wrapped_difference(uy, drift_.y));
    return vx * vx + vy * vy;
  }

  /// A grain of `mine` has a new velocity: keeps the bound on the speeds.
  void note_speed(const State& state, Slice& mine, std::uint32_t slot) const {
    const Grains& g = state.grains;
    mine.fastest2 = std::max(mine.fastest2, squared_speed(state.box, g.ux[slot], g.uy[slot]));
  }

  /// Contacts of all slices, ordered by name.
  std::vector<Contact> contacts() const;

private:
  void renew(State& state, Slice& mine, std::int64_t step);
  void start_over(const State& state, std::int64_t step);
  void list_pairs(const State& state, Slice& mine);
  void list_near_walls(const State& state, Slice& mine) const;
  static void list_received(const Grains& grains, Slice& mine);
  void measure_displacements(const CoarsePositions& coarse, Slice& mine, std::int64_t step) const;
  void measure_speeds(const State& state, Slice& mine) const;

  std::optional<std::uint32_t> candidate_in(const Slice& slice, const Contact& contact) const;
  void keep(const State& state, Slice& mine, const std::vector<Contact>& contacts) const;
  std::size_t kept() const;
  void end_lost_contacts(const State& state);

  SlipLaw slip_;  // of the contacts that end in a sorting
  double skin_;   // m
  double max_radius_;
  CoarseUnits units_;
  Cells cells_;
  CoarsePositions when_sorted_;
  std::vector<Slice> slices_;
  std::vector<std::uint32_t> slot_of_;  // by id

  Fall fall_;                        // in a step
  std::int64_t steps_to_walls_ = 0;  // that the common fall takes for the room it has at walls
  Displacement drift_{};             // across the tube: at rest when the candidates were listed
  std::int64_t sorted_at_ = 0, hold_until_ = 0;  // steps
};

}  // namespace riesel
