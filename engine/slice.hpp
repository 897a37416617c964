// A range of slots and all that is derived from it between two sortings: the share of one thread,
// or a part of it.
#pragma once

#include "engine/aligned.hpp"
#include "engine/candidate_pairs.hpp"
#include "engine/fixed_point.hpp"
#include "engine/inner_pairs.hpp"
#include "engine/live_contacts.hpp"
#include "engine/meeting.hpp"
#include "engine/profile.hpp"
#include "engine/selection.hpp"
#include "engine/tally.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace riesel {

/// m, bounds on how far a grain may have moved relative to the walls: across the tube, and in any
/// direction.
struct WayPastWalls {
  double across = 0.0, any = 0.0;
};

/// A grain that can touch a wall before the next sorting.
struct NearWall {
  std::uint32_t slot;
  std::int32_t wall;
  std::uint64_t partners = 0;  ///< the wall grains that it touches: WallLattice::bit_of
  /// For plain stepping: it touches no other wall grain before the way_past_walls of its slice has
  /// reached one of these.
  WayPastWalls clear_until = {};

  bool is_clear(const WayPastWalls& way) const {
    return clear_until.across > way.across || clear_until.any > way.any;
  }
  void end_contact(std::uint64_t wall_bit) {
    partners &= ~wall_bit;
    clear_until = {};
  }
};

/// What one contact adds to the velocity of one grain in one step.
struct Kick {
  std::uint32_t slot;
  BodyKick by;
};

/// The contacts of a slice while the grains are sorted. Each thread looks through those of all
/// slices for its own, by slots; these are stored apart from the contacts, as lines from other
/// cores are expensive.
struct ContactsSetAside {
  std::vector<ContactSlots> slots;  ///< before the sorting
  std::vector<Contact> contacts;

  std::size_t size() const { return contacts.size(); }
  void add(const Contact& contact, ContactSlots of_it) {
    slots.push_back(of_it);
    contacts.push_back(contact);
  }
};

/// A grain that cannot be followed any more.
struct LostGrain {
  std::int64_t step;
  std::int32_t id;
  bool thrown;  ///< past the slices where it is searched for; else out of the space of Box

  auto operator<=>(const LostGrain&) const = default;
};

/// A slice. The members that other threads read in each step start on a cache line of their own, so
/// that a thread that writes to the others does not take these lines away (except inner.use()).
struct alignas(cache_line) Slice {
  std::size_t begin = 0, end = 0;  ///< slots
  CandidatePairs pairs;            ///< their first grain is in the slice, the second anywhere
  InnerPairs inner;                ///< those of the pairs that plain stepping tests
  std::vector<SlotPair> close;     ///< scratch of a thread that lists pairs; in its first slice
  std::vector<NearWall> near_walls;
  WayPastWalls way_past_walls;  ///< bound for all own grains since near_walls was listed

  Selection hits;  ///< indices of inner pairs that may overlap in this step
  LiveContacts pair_contacts{Partner::grain};
  LiveContacts wall_contacts{Partner::wall};
  std::vector<std::uint32_t> kicked;  ///< own grains, by any contact in this step; some repeatedly
  ContactsSetAside set_aside;         ///< the contacts of the slice, while the grains are sorted
  std::size_t kept = 0;               ///< how many of those of all slices it has after the sorting
  Profile profile;                    ///< of what its thread does with it
  StepTally tally;                    ///< of contacts that began or ended in the last advance
  /// By id: whether contacts named by this grain go into the tally. Empty: all do.
  std::span<const std::uint8_t> counted;

  alignas(cache_line) std::vector<Kick> given_away;  ///< of this step, on grains of other slices
  std::uint32_t given_first = 0, given_last = 0;     ///< the lowest and the highest slot of them
  double fastest2 = 0.0;  ///< (m per step)^2, bound on the own grains' speeds relative to the drift
  double farthest = 0.0;  ///< m, largest own displacement relative to the drift since the sorting
  double gone = 0.0;      ///< m, bound on it: what it was at the last look, and the motion since
  double wandered = 0.0;  ///< m, sum of such bounds over all former listings since the start
  bool failed() const { return trouble || lost; }
  std::optional<Trouble> trouble;  ///< the first
  std::optional<LostGrain> lost;   ///< the first

  /// To be called before the slice starts from another state.
  void start_over() {
    pair_contacts.clear();
    wall_contacts.clear();
    tally = {};
    trouble.reset();
    lost.reset();
    kept = 0;
    wandered = 0.0;
  }
  bool owns(std::uint32_t slot) const { return slot - begin < end - begin; }
  /// Whether the contact is to be in the tally.
  bool counts(const ContactName& name) const {
    return counted.empty() || counted[static_cast<std::size_t>(name.grain)] != 0;
  }
  /// Whether the grain is listed as near the wall. Linear search.
  bool has_near(std::uint32_t slot, std::int32_t wall) const {
    return std::any_of(near_walls.begin(), near_walls.end(), [&](const NearWall& near) {
      return near.slot == slot && near.wall == wall;
    });
  }
};

}  // namespace riesel
