#include "engine/density_waves.hpp"

#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

namespace riesel {

namespace {

constexpr int cell_bits = 10;
constexpr std::size_t cells = std::size_t{1} << cell_bits;

/// Table of cos(2 pi i / cells), which has all values that the waves take in the cells.
const std::vector<double>& cosines() {
  static const std::vector<double> table = [] {
    std::vector<double> values(cells);
    for (std::size_t i = 0; i < cells; ++i)
      values[i] =
          std::cos(2.0 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(cells));
    return values;
  }();
  return table;
}

struct Occupied {
  std::size_t cell;
  double grains;
};

/// The cells that have grains: few where there are few grains, as in an impact.
std::vector<Occupied> occupied_cells(const Grains& grains) {
  std::vector<std::int64_t> counts(cells);
  for (const FixedVector& at : grains.position)
    ++counts[static_cast<std::uint64_t>(at.y) >> (64 - cell_bits)];
  std::vector<Occupied> occupied;
  for (std::size_t cell = 0; cell < cells; ++cell)
    if (counts[cell] > 0) occupied.push_back({cell, static_cast<double>(counts[cell])});
  return occupied;
}

}  // namespace

std::array<double, density_waves> axial_structure_factor(const Grains& grains) {
  const std::vector<double>& cosine = cosines();
  const std::vector<Occupied> occupied = occupied_cells(grains);
  const auto grains_in_all = static_cast<double>(grains.size());
  std::array<double, density_waves> factor{};
  for (std::size_t n = 1; n <= density_waves; ++n) {
    double real_part = 0.0, imaginary_part = 0.0;
    for (const auto& [cell, count] : occupied) {
      real_part += count * cosine[n * cell % cells];
      imaginary_part += count * cosine[(n * cell + cells * 3 / 4) % cells];
    }
    factor[n - 1] = (real_part * real_part + imaginary_part * imaginary_part) / grains_in_all;
  }
  return factor;
}

}  // namespace riesel
