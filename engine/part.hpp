// A part of the tube that one thread steps by itself: its own grains, and copies of those in a
// margin on either side, which belong to its neighbours.
#pragma once

#include "engine/contact_law.hpp"
#include "engine/profile.hpp"
#include "engine/state.hpp"
#include "engine/stepper.hpp"
#include "engine/tally.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <utility>
#include <vector>

namespace riesel {

/// Where a part and its margins lie on the ring, in quanta of y.
struct Extent {
  std::uint64_t begin, length, margin;

  /// Distance of `y` from the part along the ring; 0 only for begin <= y < begin + length. A part
  /// of length 0 has nothing within.
  std::uint64_t distance(Fixed y) const {
    const std::uint64_t from_begin = static_cast<std::uint64_t>(y) - begin;
    if (from_begin < length) return 0;
    return std::min(from_begin - length, ~from_begin) + 1;
  }
};

class Part {
public:
  /// Starts with a copy of the whole, until the first cut(). Keeps a reference to the model. Throws
  /// what Stepper throws.
  Part(State whole, const ContactModel& model, bool by_flights);

  /// Takes the grains of this extent and its margins from `whole`, and, of the contacts that
  /// `parts` have kept, those between these grains.
  void cut(const State& whole, std::span<const std::unique_ptr<Part>> parts, const Extent& extent);
  /// Steps from there up to step `last`. `drift` (quanta per step along y) as for
  /// Candidates::start_from(); it must be the same for all parts.
  void advance(std::int64_t last, Fixed drift);
  /// Writes the own grains, as they are now, to their slots in the whole.
  void write(Grains& next) const;

  bool in_trouble() const { return stepper_.candidates().in_trouble(); }
  /// Whether the candidates listed at the beginning did not hold until the end of advance().
  bool has_sorted() const { return stepper_.candidates().sorted_at() > began_; }
  double skin() const { return stepper_.candidates().skin(); }  ///< m
  /// m, as Candidates::wandered().
  double wandered() const { return stepper_.candidates().wandered(); }
  /// Whether the copies of grains that began no farther than `farthest` (quanta of y) from the part
  /// have the same bits as their originals in `next`.
  bool agrees(const Grains& next, std::uint64_t farthest) const;

  /// Accepts what was done since cut(): takes over the tally, and keeps the contacts of own grains.
  void accept();
  /// Holds these contacts for the next cut() of all parts, instead of any that it has kept.
  void hold(std::vector<Contact>&& contacts) { contacts_ = std::move(contacts); }
  /// Moves the contacts, the tally and the profile that were kept since the last call to the whole.
  void hand_over(State& whole, Profile& profile);

  void start_profile() { stepper_.start_profile(); }

private:
  void choose(const Grains& all, const Extent& extent);
  void gather(const Grains& all);
  void note_ids(std::size_t all);
  void find_slots();
  std::size_t id(std::size_t slot) const {
    return static_cast<std::size_t>(state_.grains.id[slot]);
  }
  bool knows(const ContactName& name) const;

  State state_;
  Stepper stepper_;
  std::int64_t began_ = 0;                       // step
  std::size_t own_ = 0;                          // grains; those that follow are copies
  std::vector<std::uint32_t> places_;            // slots in the whole of the grains here
  std::vector<std::uint32_t> places_of_copies_;  // scratch of choose()
  std::vector<std::uint64_t> distances_;         // quanta of y, of the copies from the part
  std::vector<std::uint32_t> slots_;             // slots here of the same grains, after advance()
  static constexpr std::uint32_t not_here = UINT32_MAX;
  std::vector<std::uint32_t> rank_;   // by id: index in places_, or not_here
  std::vector<std::uint8_t> is_own_;  // by id
  std::vector<Contact> contacts_;     // kept
  StepTally tally_;
  Profile profile_;
};

}  // namespace riesel
