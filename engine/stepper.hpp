// Steps a state in one manner: owns the candidates, and the plain stepping or the flights that use
// them.
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
  /// How one Stepper does all its steps.
  struct Manner {
    bool by_flights;
    int threads;
    std::size_t slices_per_thread;

    bool operator==(const Manner&) const = default;
  };

  /// Starts from the state alone, as after a checkpoint. Keeps references. Throws what Candidates
  /// throws.
  Stepper(State& state, const ContactModel& model, const Manner& manner, const Askew& askew);
  /// On one thread, with one slice.
  Stepper(State& state, const ContactModel& model, bool by_flights);
  Stepper(const Stepper&) = delete;
  Stepper& operator=(const Stepper&) = delete;
  ~Stepper();

  /// To be called when the state has changed: as Candidates::start_from().
  void start_over(Fixed drift);

  /// Steps up to step `last`, or until the run cannot go on, or until flights had better go on with
  /// other slices because their contacts have become many or few: that is decided when they sort.
  void advance(std::int64_t last);

  const Candidates& candidates() const { return candidates_; }
  /// From now on measures the time that the first thread takes.
  void start_profile();
  /// counted[id] tells whether contacts named by this grain go into the tally (Slice::counts).
  /// Keeps the span.
  void count_only(std::span<const std::uint8_t> counted);

  /// Moves what the slices have counted and measured since the last call to `tally` and `profile`.
  void hand_over(StepTally& tally, Profile& profile);
  /// To be called after advance(): writes the contacts to the state and adds to its tally, and to
  /// `profile`, as hand_over() does.
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
