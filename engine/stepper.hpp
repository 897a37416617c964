// Steps a state one way: candidates, and plain stepping or flights that use them.
#pragma once

#include "engine/askew.hpp"
#include "engine/candidates.hpp"
#include "engine/contact_law.hpp"
#include "engine/plain_steps.hpp"
#include "engine/profile.hpp"
#include "engine/state.hpp"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>

namespace riesel {

class Flights;

class Stepper {
public:
  /// How steps are done.
  struct Manner {
    bool by_flights;
    int threads;
    std::size_t slices_per_thread;

    bool operator==(const Manner&) const = default;
  };

  /// Starts from the state alone, as after a checkpoint. Keeps references. Throws as Candidates
  /// does.
  Stepper(State& state, const ContactModel& model, const Manner& manner, const Askew& askew);
  /// On one thread, and all grains in each step.
  Stepper(State& state, const ContactModel& model, bool by_flights);
  Stepper(const Stepper&) = delete;
  Stepper& operator=(const Stepper&) = delete;
  ~Stepper();

  /// The state has become another one: as Candidates::start_from().
  void start_from(State& state, Fixed drift);

  /// Up to step `last`, or until the run cannot go on, or until flights would better go on in
  /// another manner, as their contacts have become many, or few: that is asked when they sort.
  void advance(std::int64_t last);

  const Candidates& candidates() const { return candidates_; }
  /// From now on the time that the first thread takes is measured.
  void start_profile();
  /// These grains alone have their contacts counted, by id: others look after the rest.
  void count_only(std::span<const std::uint8_t> counted);

  /// What the slices have counted and measured since the last call, added to these.
  void hand_over(Tally& tally, Profile& profile);
  /// After advance(): the state gets its contacts, and that tally.
  void complete_state(Profile& profile);

  /// Throws RunFailure if the run cannot go on.
  void fail_if_in_trouble() const;

private:
  State& state_;
  const Manner manner_;
  Candidates candidates_;
  std::unique_ptr<PlainSteps> plain_steps_;  // one of the two
  std::unique_ptr<Flights> flights_;
};

}  // namespace riesel
