#include "engine/askew.hpp"

#include "engine/candidates.hpp"

#include <algorithm>
#include <numbers>

namespace riesel {

namespace {

/// Bytes, about, of a grain and its candidates: the closer together grains are, the more of these
/// there are. Contacts, whose number changes all the time, do not count.
double bytes_per_grain(const State& state) {
  constexpr double alone = 110.0, at_fraction_one = 240.0;
  const double diameter = mean_diameter(state.grains);
  const double fraction = static_cast<double>(state.grains.size()) * 0.25 * std::numbers::pi
                          * diameter * diameter / (state.box.width * state.box.length);
  return alone + at_fraction_one * fraction;
}

}  // namespace

bool Askew::pays(const State& state) const {
  return static_cast<double>(state.grains.size()) * bytes_per_grain(state) >= least;
}

std::int64_t Askew::most_steps(const State& state) const { return pays(state) ? steps : 1; }

std::size_t Askew::slices_per_thread(const State& state, int threads) const {
  // So that slices have enough rows even where grains are denser than elsewhere.
  constexpr double rows_per_slice = 10.0;
  if (!pays(state)) return 1;
  const double bytes = static_cast<double>(state.grains.size()) * bytes_per_grain(state);
  const double all = std::min(bytes / slice, Candidates::rows(state) / rows_per_slice);
  const auto slices = static_cast<std::size_t>(all / threads);
  return slices * static_cast<std::size_t>(threads) < 3 ? 1 : slices;
}

}  // namespace riesel
