#include "engine/askew.hpp"

#include "engine/candidates.hpp"

#include <algorithm>

namespace riesel {

std::int64_t Askew::most_steps(const State& state) const {
  return state.grains.size() < fewest ? 1 : steps;
}

std::size_t Askew::slices_per_thread(const State& state, int threads) const {
  // So that slices have enough rows even where grains are denser than elsewhere.
  constexpr double rows_per_slice = 10.0;
  const std::size_t grains = state.grains.size(), members = static_cast<std::size_t>(threads);
  if (grains < fewest) return 1;
  const auto most = static_cast<std::size_t>(Candidates::rows(state) / rows_per_slice) / members;
  const std::size_t slices = std::min(grains / members / slice, most);
  return slices * members < 3 ? 1 : slices;
}

}  // namespace riesel
