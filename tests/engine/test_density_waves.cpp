// The structure factor along the tube, against its definition and against closed forms.
#include "engine/density_waves.hpp"
#include "tests/catch.hpp"
#include "tests/engine/systems.hpp"

#include <complex>
#include <numbers>

using namespace systems;

namespace {

double by_definition(const State& state, std::size_t n) {
  std::complex<double> sum;
  for (std::size_t slot = 0; slot < state.grains.size(); ++slot) {
    const double y = grain_at(state, slot).y / state.box.length;
    sum += std::polar(1.0, -2.0 * std::numbers::pi * static_cast<double>(n) * y);
  }
  return std::norm(sum) / static_cast<double>(state.grains.size());
}

State gas(std::size_t grains, Dice& dice) {
  State state = empty_box(10e-3, 1.0);
  for (std::size_t i = 0; i < grains; ++i)
    add_grain(state, grain(5e-3, dice.between(0.0, 1.0), 0.0, 0.0));
  return state;
}

}  // namespace

TEST_CASE("the structure factor is what its definition says, but for rounded places") {
  Dice dice(81);
  for (int i = 0; i < 20; ++i) {
    const State state = gas(300, dice);
    const auto factor = axial_structure_factor(state.grains);
    for (std::size_t n = 1; n <= density_waves; ++n) {
      // Each of the 300 terms of the sum is off by up to 2 pi n / 2048, at random.
      const double exact = by_definition(state, n);
      CHECK(std::abs(std::sqrt(factor[n - 1]) - std::sqrt(exact))
            < 4.0 * 2.0 * std::numbers::pi * static_cast<double>(n) / 2048.0);
    }
  }
}

TEST_CASE("an ideal gas has a structure factor of one in the mean") {
  Dice dice(82);
  constexpr int gases = 2000;
  std::array<double, density_waves> sum{};
  for (int i = 0; i < gases; ++i) {
    const auto factor = axial_structure_factor(gas(50, dice).grains);
    for (std::size_t n = 0; n < density_waves; ++n) sum[n] += factor[n];
  }
  // Each is distributed exponentially: its standard deviation is one, too.
  for (const double total : sum) CHECK(std::abs(total / gases - 1.0) < 4.0 / std::sqrt(gases));
}

TEST_CASE("grains in one place, evenly spaced grains and a wave have the factors of closed form") {
  State heap = empty_box(10e-3, 1.0), row = heap, wave = heap;
  for (int i = 0; i < 64; ++i) {
    add_grain(heap, grain(5e-3, 0.3, 0.0, 0.0));
    add_grain(row, grain(5e-3, (i + 0.5) / 64.0, 0.0, 0.0));
    // Of density 1 + a cos(2 pi 2 y), to first order in the displacement: S_2 = N (a / 2)^2
    const double y = (i + 0.5) / 64.0;
    const double a = 0.1;
    add_grain(wave,
              grain(5e-3, y - a / (4.0 * std::numbers::pi) * std::sin(4.0 * std::numbers::pi * y),
                    0.0, 0.0));
  }
  for (const double factor : axial_structure_factor(heap.grains)) CHECK(factor == Approx(64.0));
  for (const double factor : axial_structure_factor(row.grains)) CHECK(factor < 1e-20);
  const auto factor = axial_structure_factor(wave.grains);
  CHECK(std::abs(std::sqrt(factor[1]) - std::sqrt(64.0) * 0.05) < 0.01);  // rounded places
  CHECK(factor[0] < 1e-3);
  CHECK(factor[2] < 1e-3);
}
