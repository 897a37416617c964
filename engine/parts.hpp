// The tube in parts: each thread does many steps with a part of its own, without a word to others.
//
// For that it has, besides the grains of its part, those of a margin on either side, as they were
// at the beginning: copies of grains that belong to its neighbours. At the end it compares. If the
// copies close to its own grains came to the same bits as their originals, nothing that the margin
// does not know of has reached the part, and its own grains are right. Else nothing of these steps
// is kept, and one thread does them with all grains together.
//
// Why that is enough, and what it gives: docs/architecture-parallel.md.
#pragma once

#include "engine/contact_law.hpp"
#include "engine/profile.hpp"
#include "engine/state.hpp"
#include "engine/stepper.hpp"
#include "engine/team_barrier.hpp"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

namespace riesel {

class Parts {
public:
  /// Whether parts of this state are much larger than their margins.
  static bool pay(const State& state, bool by_flights, int threads);

  /// Sorts the grains now and then. Keeps references.
  Parts(State& state, const ContactModel& model, bool by_flights, int threads);
  Parts(const Parts&) = delete;
  Parts& operator=(const Parts&) = delete;
  ~Parts();

  /// Up to step `last`, or until the run cannot go on: then throws RunFailure. The state is
  /// complete, but for what WallWatch does.
  void advance(std::int64_t last, Profile& profile);

  /// How often steps were done together, of how many stretches.
  std::int64_t stretches() const { return stretches_; }
  std::int64_t in_vain() const { return in_vain_; }

private:
  class Part;

  std::uint64_t quanta(double metres) const;
  std::uint64_t farthest_that_matters() const;
  void sort();
  void plan(std::int64_t last);
  void conclude(Profile& profile);
  void keep();
  bool all_agree() const;
  std::vector<double> weight_;
  void do_together(Profile& profile);

  State& state_;
  const ContactModel& model_;
  const bool by_flights_;
  const double reach_, diameter_;  // m
  const double skin_, most_buffer_;
  double buffer_ = 5.0;
  std::uint64_t margin_ = 0;  // quanta of y
  Fixed drift_ = 0;
  std::int64_t resorted_ = 0;
  TeamBarrier team_;
  std::vector<std::unique_ptr<Part>> parts_;
  std::vector<std::uint8_t> agreed_;
  std::vector<std::uint64_t> borders_;  // quanta of y; parts begin there
  Grains next_;                         // of the stretch; ordered as those of the state
  double steps_ = 16.0;                 // of the next stretch
  std::int64_t until_ = 0;              // step, of this stretch
  bool over_ = false;
  std::optional<Stepper> whole_;  // if the run cannot go on
  std::int64_t stretches_ = 0, in_vain_ = 0;
};

}  // namespace riesel
