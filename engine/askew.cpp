#include "engine/askew.hpp"

#include "engine/candidates.hpp"

#include <algorithm>
#include <numbers>

namespace riesel {

namespace {

/// Estimate in bytes of the memory of all grains and their candidates, whose number grows with the
/// area fraction. Contacts are left out, as their number changes all the time.
double memory_of(const State& state) {
  constexpr double of_grain = 110.0, of_candidates_at_fraction_one = 240.0;
  const auto grains = static_cast<double>(state.grains.size());
  const double diameter = mean_diameter(state.grains);
  const double fraction =
      grains * 0.25 * std::numbers::pi * diameter * diameter / (state.box.width * state.box.length);
  return grains * (of_grain + of_candidates_at_fraction_one * fraction);
}

}  // namespace

bool Askew::pays(const State& state) const { return memory_of(state) >= least_bytes; }

std::int64_t Askew::most_steps(const State& state) const { return pays(state) ? steps : 1; }

std::size_t Askew::slices_per_thread(const State& state, int threads, bool by_flights) const {
  constexpr double of_flights = 2.0;  // size of slices over that in plain stepping
  // More than slices need, so that they have enough even where grains are denser than elsewhere.
  constexpr double rows_per_slice = 10.0;
  if (!pays(state)) return 1;
  const double size = by_flights ? of_flights * bytes_of_slice : bytes_of_slice;
  const double all = std::min(memory_of(state) / size, Candidates::rows(state) / rows_per_slice);
  const auto slices = static_cast<std::size_t>(all / threads);
  return slices * static_cast<std::size_t>(threads) < 3 ? 1 : slices;
}

bool Askew::flights_gain(std::size_t contacts, std::size_t grains, bool now) const {
  constexpr double ample = 0.6;
  const double enough = (now ? ample : 1.0) * contacts_per_grain * static_cast<double>(grains);
  return static_cast<double>(contacts) >= enough;
}

}  // namespace riesel
