#include "engine/inner_pairs.hpp"

#include "engine/pair_search.hpp"

#include <algorithm>
#include <cmath>

namespace riesel {

namespace {

/// Parts of the candidates' skin.
constexpr double longest = 0.5, first = 0.1, shortest = 5e-4;

/// So many tests of pairs between two lists are best, for each candidate: found by trying. A look
/// at a candidate takes as long as two tests; and as the number of pairs grows about with the root
/// of the skin, longer lists cost half as much more as rarer ones save.
constexpr double tests_per_candidate = 4.0;

/// A list that has served for so many times the best number is too long.
constexpr double most_patience = 4.0;

}  // namespace

void InnerPairs::start_over(double outer_skin) {
  outer_skin_ = outer_skin;
  if (skin_ == 0.0) skin_ = first * outer_skin;
  stale_ = true;
}

/// Tests between two lists grow as the skin (steps) times its root (pairs).
void InnerPairs::adapt_skin() {
  const double ratio = of_all_.worth_listing / of_all_.tests;
  skin_ *= std::clamp(std::cbrt(ratio * ratio), 0.5, 2.0);
  skin_ = std::clamp(skin_, shortest * outer_skin_, longest * outer_skin_);
}

void InnerPairs::keep_up(const CandidatePairs& candidates, const PackedPositions& positions,
                         CoarseUnits units) {
  const bool pays = of_all_.tests < most_patience * of_all_.worth_listing;
  if (!stale_ && budget_ >= 0.0 && pays) return;
  if (!stale_) adapt_skin();
  find_near(candidates, positions, units, skin_, candidate_);
  pairs_.resize(candidate_.size());
  for (std::size_t p = 0; p < candidate_.size(); ++p) pairs_.set_copy(p, candidates, candidate_[p]);
  budget_ = 0.5 * skin_;
  age_ = 0;
  tests_worth_listing_ = tests_per_candidate * static_cast<double>(candidates.size());
  stale_ = false;
}

void InnerPairs::take_back(const CandidatePairs& candidates, std::uint32_t candidate) {
  pairs_.add_copy(candidates, candidate);
  candidate_.push_back(candidate);
}

}  // namespace riesel
