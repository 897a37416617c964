#include "engine/inner_pairs.hpp"

#include "engine/pair_search.hpp"

#include <algorithm>
#include <cmath>

namespace riesel {

namespace {

/// The longest, first and shortest inner skin, over that of the candidates.
constexpr double longest = 0.5, first = 0.1, shortest = 5e-4;

/// The best number of pair tests between two listings, per candidate; measured. It agrees with an
/// estimate: listing takes as long as two tests per candidate, and as the number of pairs grows
/// about as the root of the skin, the cost of longer lists grows half as fast as that of rarer
/// listing falls.
constexpr double tests_per_candidate = 4.0;

/// A list with which this many times the best number of tests has been done is too long.
constexpr double most_patience = 4.0;

}  // namespace

void InnerPairs::start_over(double outer_skin) {
  outer_skin_ = outer_skin;
  if (skin_ == 0.0) skin_ = first * outer_skin;
  stale_ = true;
}

/// The tests between two listings grow as skin^(3/2): the number of steps as the skin, the number
/// of pairs as its root.
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
