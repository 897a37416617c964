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

  /// How far `y` is from the part; 0 only within it, where it begins but not where it ends. Nothing
  /// is within a part without length.
  std::uint64_t distance(Fixed y) const {
    const std::uint64_t from_begin = static_cast<std::uint64_t>(y) - begin;
    if (from_begin < length) return 0;
    return std::min(from_begin - length, ~from_begin) + 1;
  }
};

class Part {
public:
  /// Takes all of the grains to begin with. Keeps a reference to the model. Throws as Stepper does.
  Part(State whole, const ContactModel& model, bool by_flights);

  /// Takes the grains of this extent, as they are in `whole`, and of the contacts that `parts` have
  /// kept those between them.
  void cut(const State& whole, std::span<const std::unique_ptr<Part>> parts, const Extent& extent);
  /// From there up to step `last`. Displacements are counted from `drift`, quanta per step along y.
  void advance(std::int64_t last, Fixed drift);
  /// The own grains as they have become, to their places.
  void write(Grains& next) const;

  bool in_trouble() const { return stepper_.candidates().in_trouble(); }
  /// Whether the candidates of the beginning did not hold until the end.
  bool has_sorted() const { return stepper_.candidates().sorted_at() > began_; }
  double skin() const { return stepper_.candidates().skin(); }  ///< m
  /// m, as Candidates::wandered().
  double wandered() const { return stepper_.candidates().wandered(); }
  /// Whether the copies of grains no farther than this from the part (quanta of y) have become what
  /// their originals have.
  bool agrees(const Grains& next, std::uint64_t farthest) const;

  /// What was done since cut() stands: counts it, and keeps the contacts of the own grains.
  void keep();
  /// Keeps these contacts, and no others.
  void keep(std::vector<Contact>&& contacts) { contacts_ = std::move(contacts); }
  /// What was kept and counted since the last call goes to the whole.
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
  std::vector<std::uint32_t> places_;            // of the grains in the whole
  std::vector<std::uint32_t> places_of_copies_;  // while they are chosen
  std::vector<std::uint64_t> distances_;         // quanta of y, of the copies from the part
  std::vector<std::uint32_t> slots_;             // of the grains here, in the order of the places
  static constexpr std::uint32_t not_here = UINT32_MAX;
  std::vector<std::uint32_t> rank_;   // of a grain in that order, or not_here; by id
  std::vector<std::uint8_t> is_own_;  // by id
  std::vector<Contact> contacts_;     // kept
  Tally tally_;
  Profile profile_;
};

}  // namespace riesel
