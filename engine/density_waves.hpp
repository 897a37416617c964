// Structure along the tube: how much the density varies with the longest waves that the period
// allows. Clusters and plugs show here.
//
// The measure is the static structure factor along y,
//     S_n = |sum over grains of exp(-i k_n y)|^2 / N,   k_n = 2 pi n / length,
// which has the mean 1 for grains placed independently, is below 1 where they are spaced evenly (a
// dense fluid resists compression), and N where all are at one place.
#pragma once

#include "engine/state.hpp"

#include <array>
#include <cstddef>

namespace riesel {

/// Number of waves: n = 1 ... 4.
inline constexpr std::size_t density_waves = 4;

/// S_1 ... S_4; the same bits for any order of the slots. The positions are rounded to 1/1024 of
/// the length, so that grains can be counted instead of summed: sqrt(S_n) is off by about 0.001 n.
std::array<double, density_waves> axial_structure_factor(const Grains& grains);

}  // namespace riesel
