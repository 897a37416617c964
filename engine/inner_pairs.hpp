// Those of the candidate pairs that may touch soon: the inner one of two Verlet lists.
//
// Plain stepping tests pairs in every step, and most candidates are too far apart to be worth that.
// The inner list has those closer than the sum of radii plus a skin of its own, at most half of
// that of the candidates and mostly far less. It is made by one pass over all candidates, and holds
// as long as no grain has moved by half of its skin. The skin adapts to the motion of the grains,
// so that making lists costs about as much as testing them.
//
// Its choice changes no result: pairs that are not in it cannot touch.
#pragma once

#include "engine/candidate_pairs.hpp"
#include "engine/coarse_positions.hpp"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace riesel {

class InnerPairs {
public:
  /// To be called when new candidates have been listed, with a skin of `outer_skin` (m): the list
  /// is out of date.
  void start_over(double outer_skin);

  /// To be called after each step: no grain of the candidates has moved farther in it than `motion`
  /// (m), relative to the drift.
  void spend(double motion) {
    budget_ -= motion;
    ++age_;
  }

  /// What lists have cost since they were made, in tests of pairs.
  struct Use {
    double tests = 0.0;          ///< so far, with those of the step to come
    double worth_listing = 0.0;  ///< the best number between two listings
  };
  Use use() const {
    return {.tests = static_cast<double>(age_ + 1) * static_cast<double>(pairs_.size() + 1),
            .worth_listing = tests_worth_listing_};
  }
  /// To be called before each step with the use on which keep_up() decides. Where slices do each
  /// step together that is the sum over all of them: so all make new lists in the same step, and
  /// none waits for another.
  void heed(const Use& of_all) { of_all_ = of_all; }

  /// Makes a new list from the present `positions` if the old one does not hold any more, or is so
  /// long that a shorter one pays. `candidates` are those of the last start_over().
  void keep_up(const CandidatePairs& candidates, const PackedPositions& positions,
               CoarseUnits units);

  /// The list, in no particular order. reach2 of pairs in contact is negative, as in the
  /// candidates.
  const CandidatePairs& pairs() const { return pairs_; }
  /// Index among the candidates of pair number `pair` of the list.
  std::uint32_t candidate(std::size_t pair) const { return candidate_[pair]; }

  /// To be called when this pair of the list has come into contact: it is not searched any more.
  void leave_out(std::size_t pair) { pairs_.reach2[pair] = -pairs_.reach2[pair]; }
  /// To be called when the contact of this candidate has ended: the pair is searched again.
  void take_back(const CandidatePairs& candidates, std::uint32_t candidate);

private:
  void adapt_skin();

  CandidatePairs pairs_;
  std::vector<std::uint32_t> candidate_;  // of each pair
  double outer_skin_ = 0.0, skin_ = 0.0;  // m
  double budget_ = 0.0;                   // m, further motion for which the list holds
  std::int64_t age_ = 0;                  // steps that the list has served
  double tests_worth_listing_ = 0.0;
  Use of_all_;
  bool stale_ = true;
};

}  // namespace riesel
