// Steps a State: chooses how steps are done, does them, and does what is needed between two
// advances.
#pragma once

#include "engine/contact_law.hpp"
#include "engine/parts.hpp"
#include "engine/run_failure.hpp"
#include "engine/state.hpp"
#include "engine/stepper.hpp"
#include "engine/stepping_choice.hpp"
#include "engine/wall_watch.hpp"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>

namespace riesel {

/// The number of threads that pays for this many grains on this machine, for users who leave the
/// choice to the program.
int useful_threads(std::size_t grains);
/// The same where `available` threads are.
int useful_threads(std::size_t grains, int available);

/// How grains in free flight are moved. The results are the same, bit by bit.
enum class Stepping {
  plain,     ///< all grains in each step
  windows,   ///< grains that touch nothing cross many steps at once
  automatic  ///< whatever is fastest, on one thread or on all
};

/// How threads share the steps. The results are the same, bit by bit.
enum class Sharing {
  together,  ///< all do each step together
  apart,     ///< each does many steps with a part of its own
  automatic  ///< whatever is faster
};

class Simulation {
public:
  /// `state` may come from a scenario or from a checkpoint. Of `threads` it uses as many as the
  /// system grants: see threads(). Throws std::invalid_argument if the invariants of the state do
  /// not hold, a contact of it is between bodies that are far apart, the box is too small for the
  /// nearest image to be unique, wall grains are too close together, `threads` is not positive, or
  /// `askew` is unsound; RunFailure if the system takes back threads that it had granted.
  Simulation(State state, const ContactModel& model, int threads,
             Stepping stepping = Stepping::automatic, const Askew& askew = {},
             Sharing sharing = Sharing::automatic);
  Simulation(const Simulation&) = delete;
  Simulation& operator=(const Simulation&) = delete;
  ~Simulation();

  /// Does `steps` steps; none if `steps` <= 0. The result does not depend on the number of threads,
  /// nor on how the steps are divided between calls. Throws RunFailure if a force is not finite or
  /// far too large for a step, if a grain is lost, or if the system grants fewer threads than at
  /// first. In which step a lost grain is found, and whether one that is thrown far within a few
  /// steps is, depends on the stepping (automatic: on the clock), the threads and the calls.
  void advance(std::int64_t steps);

  const State& state() const { return state_; }
  const ContactModel& model() const { return model_; }
  int threads() const { return threads_; }
  /// The fastest way found so far.
  Way preferred_way() const { return choice_.preferred(); }

  /// From now on measures the time that the first thread takes for stepping, by phase.
  void start_profile();
  const Profile& profile() const { return profile_; }

private:
  /// What has been built for a Way: a Stepper of this manner, or Parts of so many threads.
  struct Preparation {
    Stepper::Manner manner;
    bool apart;

    bool operator==(const Preparation&) const = default;
  };
  Preparation wanted() const;
  std::int64_t piece() const;
  void advance_piece(std::int64_t last);
  void prepare();
  void step_up_to(std::int64_t last);

  State state_;
  ContactModel model_;
  const int threads_;
  const Askew askew_;
  /// Slices per thread where they go askew: if one thread steps alone, and if all do together.
  struct Slices {
    std::size_t alone, together;
  };
  Slices askew_slices(bool by_flights) const;
  const Slices slices_, slices_of_flights_;
  SteppingChoice choice_;
  Profile profile_;
  std::optional<Preparation> prepared_;  // how the one of stepper_ and parts_ that exists steps
  std::optional<Stepper> stepper_;
  Parts::Habits habits_, habits_of_flights_;
  double changing_ = 0.0;  // s, that a change of the way has taken and choice_ does not know of yet
  std::unique_ptr<Parts> parts_;
  const WallWatch wall_watch_;
};

}  // namespace riesel
