#include "engine/stepper.hpp"

#include "engine/flights.hpp"
#include "engine/run_failure.hpp"
#include "engine/team.hpp"

#include <optional>
#include <string>

namespace riesel {

namespace {

/// Whether a side has no wall.
bool has_open_side(const State& state) { return state.walls.size() < 2; }

}  // namespace

Stepper::Stepper(State& state, const ContactModel& model, const Manner& manner, const Askew& askew)
    : state_(state),
      manner_(manner),
      candidates_(state, model.slip, manner.threads,
                  manner.by_flights ? Flights::purpose : Candidates::plain_stepping,
                  manner.slices_per_thread) {
  if (manner.by_flights)
    flights_ = std::make_unique<Flights>(state, model, candidates_, askew);
  else
    plain_steps_ = std::make_unique<PlainSteps>(state, model, candidates_, askew);
}

Stepper::Stepper(State& state, const ContactModel& model, bool by_flights)
    : Stepper(state, model, {.by_flights = by_flights, .threads = 1, .slices_per_thread = 1},
              Askew::never()) {}

Stepper::~Stepper() = default;

void Stepper::start_over(Fixed drift) {
  Profile& profile = candidates_.slices().front().profile;
  profile.begin_build();
  candidates_.start_from(state_, drift);
  if (flights_)
    flights_->start_over();
  else
    plain_steps_->start_over();
  profile.done_build();
}

void Stepper::advance(std::int64_t last) {
  const std::int64_t now = state_.step;  // before the team starts, which changes it
  as_a_team(manner_.threads, [&](std::size_t member) {
    if (flights_)
      flights_->advance(member, now, last);
    else
      plain_steps_->advance(member, now, last);
  });
}

void Stepper::start_profile() { candidates_.slices().front().profile = Profile(true); }

void Stepper::count_only(std::span<const std::uint8_t> counted) {
  for (Slice& slice : candidates_.slices()) slice.counted = counted;
}

void Stepper::hand_over(StepTally& tally, Profile& profile) {
  for (Slice& slice : candidates_.slices()) {
    tally.merge(slice.tally);
    slice.tally = {};
    profile.merge(slice.profile);
    slice.profile = Profile(slice.profile.on());
  }
}

void Stepper::complete_state(Profile& profile) {
  state_.contacts = candidates_.contacts();
  hand_over(state_.tally, profile);
}

void Stepper::fail_if_in_trouble() const {
  std::optional<Trouble> trouble;
  std::optional<LostGrain> lost;
  for (const Slice& slice : candidates_.slices()) {
    trouble = first_of(trouble, slice.trouble);
    lost = first_of(lost, slice.lost);
  }
  if (trouble && !(lost && lost->step < trouble->step))
    throw RunFailure("the force between " + bodies_of(trouble->contact)
                     + " is not finite, or far too large for a time step, "
                     + when(trouble->step, state_.time_step) + "; a shorter time step may help");
  if (!lost) return;
  const bool through_open_side = !lost->thrown && has_open_side(state_);
  throw RunFailure("grain " + std::to_string(lost->id)
                   + (lost->thrown
                          ? " was thrown farther within a few steps than its neighbours look "
                          : " has left the system ")
                   + when(lost->step, state_.time_step)
                   + (through_open_side ? "; more room at the open side or a slower start may help"
                                        : "; stiffer contacts or a shorter time step may help"));
}

}  // namespace riesel
