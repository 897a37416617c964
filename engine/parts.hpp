// The tube in parts: each thread does many steps with a part of its own without communication.
//
// For that it has, besides the grains of its part, copies of those in a margin on either side. At
// the end of such a stretch the copies close to the part are compared with their originals: if they
// have the same bits, nothing that the part does not know of has reached it, and its own grains are
// right. Else the stretch was in vain: nothing of it is kept, and one thread repeats it with all
// grains.
//
// Why that is enough: docs/architecture-parallel.md. What it gains: docs/performance.md.
#pragma once

#include "engine/contact_law.hpp"
#include "engine/part.hpp"
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
  /// The length of stretches and the width of margins, adapted from stretch to stretch. The results
  /// do not depend on them.
  struct Habits {
    double steps = 16.0;  ///< of a stretch: 1 or more
    /// Width of a margin in mean diameters beyond what a grain may meet without a new listing: the
    /// distance over which what is missing outside must spread to reach the part.
    double buffer = 5.0;
    bool steps_known = false;  ///< longer stretches have turned out too long
  };

  /// Whether the parts of so many threads would be much longer than their margins.
  static bool pay(const State& state, int threads);

  /// Keeps references, also to `habits`, which it adapts. Throws std::invalid_argument for fewer
  /// than two threads, and what Stepper throws.
  Parts(State& state, const ContactModel& model, bool by_flights, int threads, Habits& habits);

  /// Steps up to step `last`, or until the run cannot go on. Throws RunFailure, and does nothing,
  /// if the system grants fewer threads.
  void advance(std::int64_t last, Profile& profile);

  /// Whether the run cannot go on.
  bool in_trouble() const { return whole_.has_value(); }
  /// Throws RunFailure if the run cannot go on.
  void fail_if_in_trouble() const;

  std::int64_t stretches() const { return stretches_; }
  /// Stretches of which nothing was kept.
  std::int64_t in_vain() const { return in_vain_; }

private:
  void do_stretches(std::size_t member, std::int64_t last, Profile& profile);
  void do_stretch(std::size_t member);
  void plan(std::int64_t last);
  void sort();
  void share_out();
  Extent extent_of(std::size_t part) const;
  std::uint64_t quanta(double metres) const;
  std::uint64_t farthest_met() const;
  bool all_agree() const;
  void conclude(std::int64_t last, Profile& profile);
  void learn_from_success();
  void learn_from_failure();
  void do_together(std::int64_t last, Profile& profile);

  State& state_;
  const ContactModel& model_;
  const bool by_flights_;
  Habits& habits_;
  const double reach_;     // m, of the largest pair
  const double diameter_;  // m, mean
  TeamBarrier team_;
  std::vector<std::unique_ptr<Part>> parts_;
  std::vector<double> weights_;         // of parts: what share of the grains they get
  std::vector<std::uint64_t> borders_;  // quanta of y, where parts begin; and the end of the last
  std::vector<double> seconds_;         // that parts took for the stretch
  std::vector<std::uint8_t> agreed_;    // of parts

  std::int64_t until_ = 0;    // step: the end of the stretch
  std::uint64_t margin_ = 0;  // quanta of y
  Fixed drift_ = 0;           // quanta per step along y
  bool cut_short_ = false;    // the stretch ends with the advance: it tells nothing of longer ones
  bool over_ = false;         // no stretch is left to be done
  Grains next_;               // those of the state at the end of the stretch, in the same places
  std::optional<Stepper> whole_;  // of all grains; kept only if the run could not go on with it
  std::int64_t stretches_ = 0, in_vain_ = 0;
  int failures_ = 0;  // in a row
};

}  // namespace riesel
