// Those of the candidate pairs that may touch soon: the inner one of two Verlet lists.
//
// The search of plain stepping tests pairs in every step, and most candidates are too far apart for
// that. The inner list has those closer than the sum of radii plus a skin of its own, at most half
// of that of the candidates and mostly far less. It is made by one look at all candidates, and
// holds as long as no grain has moved by half of its skin. The skin follows the motion of the
// grains: lists are made so often that this costs as much as it saves.
//
// Which pairs are in it changes no result: those that are not cannot touch.
#pragma once

#include "engine/candidate_pairs.hpp"
#include "engine/coarse_positions.hpp"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace riesel {

class InnerPairs {
public:
  /// There are new candidates, which have a skin of `outer_skin` (m): the list holds no longer.
  void start_over(double outer_skin);

  /// A step has been done in which no grain of the candidates has moved farther than this (m),
  /// relative to a motion common to all.
  void spend(double motion) {
    budget_ -= motion;
    ++age_;
  }

  /// What a list has cost so far, in tests of pairs.
  struct Use {
    double tests = 0.0;          ///< since it was made, with those of the step to come
    double worth_listing = 0.0;  ///< as many as would be best between two lists
  };
  Use use() const {
    return {.tests = static_cast<double>(age_ + 1) * static_cast<double>(pairs_.size() + 1),
            .worth_listing = tests_worth_listing_};
  }
  /// Where slices do each step together, the use that all have made of their lists decides when all
  /// make new ones: in the same step, so that none waits for another. To be told before each step.
  void heed(const Use& of_all) { of_all_ = of_all; }

  /// Lists anew what is close at `positions`, the present ones, if the list holds no longer, or if
  /// a shorter one pays. `candidates` are those of the last start_over().
  void keep_up(const CandidatePairs& candidates, const PackedPositions& positions,
               CoarseUnits units);

  /// In no order. Of pairs in contact reach2 is negative, as in the candidates.
  const CandidatePairs& pairs() const { return pairs_; }
  /// The index among the candidates of a pair of the list.
  std::uint32_t candidate(std::size_t pair) const { return candidate_[pair]; }

  /// This pair of the list has come into contact.
  void leave_out(std::size_t pair) { pairs_.reach2[pair] = -pairs_.reach2[pair]; }
  /// The contact of this candidate has ended.
  void take_back(const CandidatePairs& candidates, std::uint32_t candidate);

private:
  void adapt_skin();

  CandidatePairs pairs_;
  std::vector<std::uint32_t> candidate_;  // of each pair
  double outer_skin_ = 0.0, skin_ = 0.0;  // m
  double budget_ = 0.0;                   // m, motion that leaves the list valid
  std::int64_t age_ = 0;                  // steps that the list has served
  double tests_worth_listing_ = 0.0;
  Use of_all_;
  bool stale_ = true;
};

}  // namespace riesel
