#include "engine/simulation.hpp"

#include "engine/flights.hpp"
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

/// `state` if a simulation can start from it, its balances opened.
State ready(State state) {
  if (const std::string flaw = flaw_of(state); !flaw.empty()) throw std::invalid_argument(flaw);
  if (state.step == 0) state.origin = origin_of(state);
  return state;
}

Askew sound(const Askew& askew) {
  constexpr std::int64_t most_steps = 1'000'000;
  require(askew.slice > 0 && askew.steps > 0 && askew.steps <= most_steps,
          "slices need grains and steps, not too many");
  return askew;
}

int team_size(int wanted) {
  require(wanted > 0, "a simulation needs at least one thread");
  if (wanted == 1) return 1;
  return fix_members(wanted);
}

/// What to try first. In units of what plain stepping takes for a grain without contacts, flights
/// take some 2.5 more for a contact, and next to nothing for a grain; more where there are so many
/// grains that slices go askew: docs/performance-log.md.
bool flights_look_faster(const State& state, int threads, const Askew& askew) {
  const auto contacts = static_cast<double>(state.contacts.size());
  const double price = askew.slices_per_thread(state, threads) > 1 ? 6.0 : 2.5;
  return price * contacts < static_cast<double>(state.grains.size());
}

/// The ways that `stepping` allows, the one to begin with first.
std::vector<Way> ways(Stepping stepping, const State& state, int threads, const Askew& askew) {
  const bool flights_first =
      stepping == Stepping::windows
      || (stepping == Stepping::automatic && flights_look_faster(state, threads, askew));
  std::vector<Way> all{{.by_flights = flights_first, .threads = threads}};
  if (stepping != Stepping::automatic) return all;
  all.push_back({.by_flights = !flights_first, .threads = threads});
  if (threads > 1)
    for (const bool by_flights : {flights_first, !flights_first})
      all.push_back({.by_flights = by_flights, .threads = 1});
  return all;
}

std::string partners(const ContactName& name) {
  const std::string grain = "grain " + std::to_string(name.grain);
  const std::string partner = std::to_string(name.partner);
  return name.wall == no_wall
             ? grain + " and grain " + partner
             : grain + " and grain " + partner + " of wall " + std::to_string(name.wall);
}

/// Not each side has a wall.
bool has_open_side(const State& state) { return state.walls.size() < 2; }

}  // namespace

int useful_threads(std::size_t grains) {
  constexpr std::size_t grains_per_thread = 2000;  // fewer do not pay for the barriers of a step
  const auto most = static_cast<std::size_t>(omp_get_max_threads());
  return static_cast<int>(std::clamp<std::size_t>(grains / grains_per_thread, 1, most));
}

Simulation::Simulation(State state, const ContactModel& model, int threads, Stepping stepping,
                       const Askew& askew)
    : state_(ready(std::move(state))),
      model_(model),
      threads_(team_size(threads)),
      askew_(sound(askew)),
      choice_(ways(stepping, state_, threads_, askew_)),
      wall_watch_(state_, model_) {
  prepare();
}

Simulation::~Simulation() = default;

void Simulation::start_profile() {
  profile_ = Profile(true);
  profile_first_thread();
}

void Simulation::profile_first_thread() {
  candidates_->slices().front().profile = Profile(profile_.on());
}

void Simulation::advance(std::int64_t steps) {
  const std::int64_t last = state_.step + steps;
  do {
    advance_piece(std::min(last, state_.step + piece()));
  } while (state_.step < last);
}

/// Steps between two thoughts about the stepping: many enough to be timed, and for flights, which
/// land after them.
std::int64_t Simulation::piece() const {
  constexpr std::int64_t particle_steps = 20'000'000, fewest = 64;
  if (!choice_.open()) return INT64_MAX / 2;
  return std::max(fewest, particle_steps / static_cast<std::int64_t>(state_.grains.size()));
}

void Simulation::advance_piece(std::int64_t last) {
  const auto now = std::chrono::steady_clock::now;
  const auto seconds = [](auto span) { return std::chrono::duration<double>(span).count(); };
  const auto begin = now();
  const bool in_trouble = prepared_ && candidates_->in_trouble();
  if (!in_trouble && prepared_ != wanted()) {
    prepare();
    step_up_to(std::min(last, state_.step + 1));  // in which flights make all their appointments
  }
  const std::int64_t first = state_.step;
  const auto start = now();
  step_up_to(last);
  if (state_.step > first)
    choice_.note(state_.step - first, seconds(now() - start), seconds(start - begin));
  collect();
  fail_if_in_trouble();
}

Simulation::Preparation Simulation::wanted() const {
  const Way way = choice_.way();
  const std::size_t slices = askew_.slices_per_thread(state_, way.threads);
  constexpr double ample = 0.6;  // so that it is not now one, now the other
  const bool before = prepared_ && prepared_->slices_per_thread > 1;
  const double enough =
      (before ? ample : 1.0) * askew_.contacts * static_cast<double>(state_.grains.size());
  const bool askew = !way.by_flights || static_cast<double>(state_.contacts.size()) >= enough;
  return {way, askew ? slices : 1};
}

/// Whoever is to step the grains starts from the state alone, as after a checkpoint.
void Simulation::prepare() {
  const Preparation next = wanted();
  prepared_.reset();  // until all of it is there: the system may grant no more threads
  flights_.reset();
  plain_steps_.reset();
  candidates_.reset();  // before the next ones are listed: memory
  const auto [by_flights, threads] = next.way;
  candidates_ = std::make_unique<Candidates>(
      state_, model_.slip, threads, by_flights ? Flights::purpose : Candidates::plain_stepping,
      next.slices_per_thread);
  if (by_flights)
    flights_ = std::make_unique<Flights>(state_, model_, *candidates_, askew_);
  else
    plain_steps_ = std::make_unique<PlainSteps>(state_, model_, *candidates_, askew_);
  prepared_ = next;
  profile_first_thread();
}

void Simulation::step_up_to(std::int64_t last) {
  const std::int64_t now = state_.step;  // before the team starts, which changes it
  as_a_team(prepared_->way.threads, [&](std::size_t member) {
    if (flights_)
      flights_->advance(member, now, last);
    else
      plain_steps_->advance(member, now, last);
  });
}

/// Completes the state with what the slices know of contacts.
void Simulation::collect() {
  state_.contacts = candidates_->contacts();
  for (Slice& slice : candidates_->slices()) {
    state_.tally.merge(slice.tally);
    slice.tally = {};
    profile_.merge(slice.profile);
    slice.profile = Profile(slice.profile.on());
  }
  wall_watch_.look(state_);
}

void Simulation::fail_if_in_trouble() const {
  std::optional<Trouble> trouble;
  std::optional<LostGrain> lost;
  for (const Slice& slice : candidates_->slices()) {
    trouble = first_of(trouble, slice.trouble);
    lost = first_of(lost, slice.lost);
  }
  if (trouble && !(lost && lost->step < trouble->step))
    throw RunFailure("the force between " + partners(trouble->contact) + " is not finite "
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
