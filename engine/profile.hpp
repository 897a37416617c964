// Measures where the time of stepping goes.
//
// Reading the clock costs as much as a few contacts, so only one step in steps_per_sample is timed
// in detail and stands for the others. Sorting and listing happen rarely and are timed each time.
// The simulation does not depend on what is measured.
#pragma once

#include <algorithm>
#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>

namespace riesel {

class Profile {
public:
  enum class Phase {
    fly,           ///< grains move on
    build,         ///< sorting, listing of candidates
    search,        ///< which contacts begin
    forces,        ///< contacts: forces, lives, kicks
    receive,       ///< kicks reach the grains; in plain stepping their velocities, too
    appointments,  ///< flights only: courses, and when to look again
  };
  static constexpr std::size_t phases = 6;
  /// A prime, so that the samples do not coincide with things that happen after round numbers of
  /// steps.
  static constexpr std::int64_t steps_per_sample = 61;

  explicit Profile(bool on = false) : on_(on) {}

  bool on() const { return on_; }

  void begin_step(std::int64_t step) { begin_steps(step, 1); }
  /// For `count` steps that are done as one, from step `first` on: timed if one of them is a
  /// sample.
  void begin_steps(std::int64_t first, std::int64_t count) {
    const std::int64_t last = first + count - 1;
    sampled_ = on_ && last - last % steps_per_sample >= first;
    if (!sampled_) return;
    weight_ = std::max(1.0, static_cast<double>(steps_per_sample) / static_cast<double>(count));
    last_ = Clock::now();
  }
  /// Attributes the time since the last call of a member function to this phase.
  void done(Phase phase) {
    if (sampled_) add(phase, weight_);
  }

  void begin_build() {
    if (on_) last_ = Clock::now();
  }
  void done_build() {
    if (on_) add(Phase::build, 1.0);
  }

  double seconds(Phase phase) const { return seconds_[static_cast<std::size_t>(phase)]; }

  void merge(const Profile& other) {
    for (std::size_t p = 0; p < phases; ++p) seconds_[p] += other.seconds_[p];
  }

private:
  using Clock = std::chrono::steady_clock;

  void add(Phase phase, double weight) {
    const Clock::time_point now = Clock::now();
    seconds_[static_cast<std::size_t>(phase)] +=
        weight * std::chrono::duration<double>(now - last_).count();
    last_ = now;
  }

  bool on_, sampled_ = false;
  double weight_ = 1.0;  // how many steps, or groups of steps, the timed one stands for
  Clock::time_point last_;
  std::array<double, phases> seconds_{};
};

}  // namespace riesel
