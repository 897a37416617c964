#include "engine/simulation.hpp"

#include "engine/observables.hpp"
#include "engine/require.hpp"
#include "engine/state_check.hpp"
#include "engine/team.hpp"

#include <omp.h>

#include <algorithm>
#include <chrono>
#include <stdexcept>
#include <string>
#include <utility>

namespace riesel {

namespace {

/// Returns `state` if a simulation can start from it, at step 0 with its origin set. Throws
/// std::invalid_argument otherwise.
State ready(State state) {
  if (const std::string flaw = flaw_of(state); !flaw.empty()) throw std::invalid_argument(flaw);
  if (state.step == 0) state.origin = origin_of(state);
  return state;
}

Askew sound(const Askew& askew) {
  constexpr std::int64_t most_steps = 1'000'000;
  require(askew.bytes_of_slice > 0.0 && askew.steps > 0 && askew.steps <= most_steps,
          "slices need memory and steps, not too many");
  return askew;
}

int team_size(int wanted) {
  require(wanted > 0, "a simulation needs at least one thread");
  if (wanted == 1) return 1;
  return fix_members(wanted);
}

/// Whether to try flights first. In units of the time that plain stepping takes for a grain without
/// contacts, flights take some 2.5 more than plain stepping for a contact, or 6 where there are so
/// many grains that slices go askew, and next to nothing for a grain: docs/performance-log.md.
bool flights_look_faster(const State& state, int threads, const Askew& askew) {
  const auto contacts = static_cast<double>(state.contacts.size());
  const double price = askew.slices_per_thread(state, threads, true) > 1 ? 6.0 : 2.5;
  return price * contacts < static_cast<double>(state.grains.size());
}

/// Whether several threads may each have a part of their own. Not if slices go askew, as these give
/// each thread a region of its own already.
bool may_part(Sharing sharing, const State& state, int threads, const Askew& askew) {
  if (sharing != Sharing::automatic) return sharing == Sharing::apart;
  return !askew.pays(state) && Parts::pay(state, threads);
}

/// The ways by plain stepping in which threads may share the steps, the one to begin with first.
std::vector<Way> ways_to_share(Stepping stepping, Sharing sharing, const State& state, int threads,
                               const Askew& askew) {
  const Way alone{.by_flights = false, .threads = 1};
  const Way together{.by_flights = false, .threads = threads};
  const Way apart{.by_flights = false, .threads = threads, .apart = true};
  if (threads == 1) return {alone};
  std::vector<Way> all;
  if (sharing != Sharing::apart) all.push_back(together);
  if (may_part(sharing, state, threads, askew)) all.push_back(apart);
  if (stepping == Stepping::automatic) all.push_back(alone);
  // With fewer grains, threads that wait for each other in each step gain nothing, or lose.
  constexpr std::size_t few_per_thread = 2000;
  if (state.grains.size() < few_per_thread * static_cast<std::size_t>(threads))
    std::reverse(all.begin(), all.end());
  return all;
}

/// The ways that are allowed, the one to begin with first.
std::vector<Way> ways(Stepping stepping, Sharing sharing, const State& state, int threads,
                      const Askew& askew) {
  const bool flights_first =
      stepping == Stepping::windows
      || (stepping == Stepping::automatic && flights_look_faster(state, threads, askew));
  std::vector<bool> steppings{flights_first};
  if (stepping == Stepping::automatic) steppings.push_back(!flights_first);
  std::vector<Way> all;
  for (const bool by_flights : steppings)
    for (Way way : ways_to_share(stepping, sharing, state, threads, askew)) {
      way.by_flights = by_flights;
      all.push_back(way);
    }
  return all;
}

}  // namespace

int useful_threads(std::size_t grains) { return useful_threads(grains, omp_get_max_threads()); }

int useful_threads(std::size_t grains, int available) {
  constexpr std::size_t grains_per_thread = 600;  // with fewer the margins of parts cost too much
  const auto most = static_cast<std::size_t>(available);
  return static_cast<int>(std::clamp<std::size_t>(grains / grains_per_thread, 1, most));
}

Simulation::Simulation(State state, const ContactModel& model, int threads, Stepping stepping,
                       const Askew& askew, Sharing sharing)
    : state_(ready(std::move(state))),
      model_(model),
      threads_(team_size(threads)),
      askew_(sound(askew)),
      slices_(askew_slices(false)),
      slices_of_flights_(askew_slices(true)),
      choice_(ways(stepping, sharing, state_, threads_, askew_)),
      wall_watch_(state_, model_) {
  prepare();
}

Simulation::~Simulation() = default;

Simulation::Slices Simulation::askew_slices(bool by_flights) const {
  return {.alone = askew_.slices_per_thread(state_, 1, by_flights),
          .together = askew_.slices_per_thread(state_, threads_, by_flights)};
}

void Simulation::start_profile() {
  profile_ = Profile(true);
  if (stepper_) stepper_->start_profile();
}

void Simulation::advance(std::int64_t steps) {
  const std::int64_t last = state_.step + steps;
  do {
    // In pieces of equal length: a short one at the end would be a poor measurement of its way.
    const std::int64_t left = last - state_.step;
    const std::int64_t pieces = std::max<std::int64_t>(1, left / piece());
    advance_piece(state_.step + left / pieces);
  } while (state_.step < last);
}

/// Steps between two decisions on the way of stepping: enough to be timed, enough for flights, for
/// which landing costs as much as ten steps, and for parts, which do long stretches. Fewer during
/// the first looks, as any way may still be a slow one.
std::int64_t Simulation::piece() const {
  constexpr double particle_steps = 2e7, duration = 0.03;  // s
  if (!choice_.open()) return INT64_MAX / 2;
  const double fewest = choice_.past_first_looks() ? 512.0 : 64.0;
  double steps = std::max(fewest, particle_steps / static_cast<double>(state_.grains.size()));
  if (choice_.pace() > 0.0) steps = std::max(steps, duration / choice_.pace());
  return static_cast<std::int64_t>(steps);
}

void Simulation::advance_piece(std::int64_t last) {
  const auto now = std::chrono::steady_clock::now;
  const auto seconds = [](auto span) { return std::chrono::duration<double>(span).count(); };
  const bool in_trouble =
      parts_ ? parts_->in_trouble() : stepper_ && stepper_->candidates().in_trouble();
  if (!in_trouble && prepared_ != wanted()) {
    const auto begin = now();
    prepare();
    step_up_to(std::min(last, state_.step + 1));  // not timed: flights make all appointments in it
    changing_ += seconds(now() - begin);
  }
  const std::int64_t first = state_.step;
  const auto start = now();
  step_up_to(last);
  // Flights that stopped early did so because their slices were not the best: no fair measurement.
  if (state_.step == last && state_.step > first)
    choice_.note(state_.step - first, seconds(now() - start), std::exchange(changing_, 0.0));
  if (parts_)
    parts_->fail_if_in_trouble();
  else
    stepper_->fail_if_in_trouble();
}

Simulation::Preparation Simulation::wanted() const {
  const auto [by_flights, threads, apart] = choice_.way();
  const Slices& slices = by_flights ? slices_of_flights_ : slices_;
  const bool now =
      prepared_ && prepared_->manner.by_flights && prepared_->manner.slices_per_thread > 1;
  const bool askew =
      !by_flights || askew_.flights_gain(state_.contacts.size(), state_.grains.size(), now);
  const std::size_t many = threads == 1 ? slices.alone : slices.together;
  return {{by_flights, threads, askew ? many : 1}, apart};
}

/// Builds the Stepper or the Parts for the way that is wanted, from the state alone, as after a
/// checkpoint.
void Simulation::prepare() {
  const Preparation next = wanted();
  prepared_.reset();  // until the rest has succeeded, which may throw
  stepper_.reset();   // frees the memory before the next candidates are listed
  parts_.reset();
  if (next.apart)
    parts_ = std::make_unique<Parts>(state_, model_, next.manner.by_flights, next.manner.threads,
                                     next.manner.by_flights ? habits_of_flights_ : habits_);
  else
    stepper_.emplace(state_, model_, next.manner, askew_);
  prepared_ = next;
  if (stepper_ && profile_.on()) stepper_->start_profile();
}

void Simulation::step_up_to(std::int64_t last) {
  if (parts_) {
    parts_->advance(last, profile_);
  } else {
    stepper_->advance(last);
    stepper_->complete_state(profile_);
  }
  wall_watch_.look(state_);
}

}  // namespace riesel
