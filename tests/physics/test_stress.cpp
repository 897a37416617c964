// The stresses of a steady tube carry its weight to the walls.
#include "engine/observables.hpp"
#include "engine/strips.hpp"
#include "engine/time_blocks.hpp"
#include "engine/time_series.hpp"
#include "tests/catch.hpp"
#include "tests/engine/systems.hpp"

#include <array>
#include <cmath>
#include <tuple>
#include <vector>

using namespace systems;

namespace {

/// A tube in its steady state, and how its strips were: 4000 samples after a start.
struct SteadyTube {
  SteadyTube() {
    Simulation simulation(start(), frictional(), 1);
    simulation.advance(100'000);
    const auto before = observe(simulation.state()).impulse_y_of_wall;
    for (int i = 0; i < samples; ++i) {
      simulation.advance(steps_per_sample);
      blocks.add(sum_over_strips(strips, simulation.state(), frictional(),
                                 {.vx = 0.0, .vy = observe(simulation.state()).mean_vy}));
    }
    const auto after = observe(simulation.state()).impulse_y_of_wall;
    for (std::size_t wall : {0U, 1U}) impulse[wall] = after[wall] - before[wall];
  }

  static ContactModel frictional() {
    return {LinearLaw{stiffness, 0.1 * damping}, CappedSlip{}, friction, Attraction::keep};
  }
  static State start() { return small_tube(7); }

  static constexpr int samples = 4000, steps_per_sample = 400;
  Strips strips{.width = 0.5e-3, .length = 9.6e-3, .count = 16};
  TimeBlocks blocks{strips.columns()};
  std::array<double, 2> impulse{};  ///< kg m/s, of the left and the right wall meanwhile
};

const SteadyTube& tube() {
  static const SteadyTube the_tube;
  return the_tube;
}

/// N/m, block by block.
std::vector<double> stress(std::size_t strip, StripSum kinetic, StripSum contact) {
  std::vector<double> sum = tube().blocks.means(Strips::column(strip, kinetic), 0);
  const auto of_contacts = tube().blocks.means(Strips::column(strip, contact), 0);
  for (std::size_t b = 0; b < sum.size(); ++b)
    sum[b] = (sum[b] + of_contacts[b]) / tube().strips.area();
  return sum;
}

/// N/m per strip: its weight, block by block.
std::vector<double> weight(std::size_t strip) {
  std::vector<double> values = tube().blocks.means(Strips::column(strip, StripSum::mass), 0);
  for (double& value : values) value *= 10.0 / tube().strips.length;
  return values;
}

std::vector<double> combined(std::vector<double> a, const std::vector<double>& b, double factor) {
  for (std::size_t i = 0; i < a.size(); ++i) a[i] += factor * b[i];
  return a;
}

}  // namespace

TEST_CASE("the normal stress across a steady tube is the same in all strips") {
  // Also in those that no grain centre reaches, where contacts with the walls alone carry it.
  std::vector<double> mean(tube().blocks.size());
  const auto strips = static_cast<double>(tube().strips.count);
  for (std::size_t s = 0; s < tube().strips.count; ++s)
    mean = combined(mean, stress(s, StripSum::mass_vx2, StripSum::contact_xx), 1.0 / strips);
  CHECK(estimate_mean(mean).error < 0.05 * estimate_mean(mean).mean);
  for (std::size_t s = 0; s < tube().strips.count; ++s) {
    const auto difference =
        estimate_mean(combined(stress(s, StripSum::mass_vx2, StripSum::contact_xx), mean, -1.0));
    CAPTURE(s, difference.mean, difference.error);
    CHECK(std::abs(difference.mean) < 5.0 * difference.error);
    CHECK(difference.error < 0.15 * estimate_mean(mean).mean);
  }
}

TEST_CASE("the shear stress in a steady tube carries the weight to the walls") {
  // Downstream momentum flows outwards: sigma_xy grows by the weight of what lies between, from
  // minus half of all the weight at the left wall to half of it at the right.
  std::vector<double> left_of_here(tube().blocks.size());
  std::vector<double> all = left_of_here;
  for (std::size_t s = 0; s < tube().strips.count; ++s) all = combined(all, weight(s), 1.0);
  const double whole = estimate_mean(all).mean;
  CHECK(whole == Approx(40.0 * 1e-6 * 10.0 / 9.6e-3).epsilon(0.05));  // masses vary
  for (std::size_t s = 0; s < tube().strips.count; ++s) {
    const auto shear = stress(s, StripSum::mass_vx_w, StripSum::contact_xy);
    const auto expected = combined(combined(left_of_here, weight(s), 0.5), all, -0.5);
    const auto difference = estimate_mean(combined(shear, expected, -1.0));
    CAPTURE(s, estimate_mean(shear).mean, difference.mean, difference.error);
    CHECK(std::abs(difference.mean) < 5.0 * difference.error);
    CHECK(difference.error < 0.1 * whole);
    left_of_here = combined(left_of_here, weight(s), 1.0);
  }
}

TEST_CASE("the shear stress at each wall is the axial impulse that this wall has given") {
  // Forces of moments against the sums over contacts: two ways that share no book-keeping.
  const double time = SteadyTube::samples * SteadyTube::steps_per_sample * time_step;
  for (const auto& [wall, strip, outwards] :
       {std::tuple{0U, std::size_t{0}, -1.0}, std::tuple{1U, tube().strips.count - 1, 1.0}}) {
    CHECK(estimate_mean(weight(strip)).mean == 0.0);  // the outermost strips hold contacts only
    const auto shear = estimate_mean(stress(strip, StripSum::mass_vx_w, StripSum::contact_xy));
    const double given = tube().impulse[wall] / time / tube().strips.length;
    CAPTURE(wall, given, shear.mean, shear.error);
    CHECK(std::abs(outwards * shear.mean + given) < 4.0 * shear.error);
    CHECK(shear.error < 0.15 * std::abs(shear.mean));
  }
}

TEST_CASE("the walls of a steady tube carry its weight, each its half") {
  const double time = SteadyTube::samples * SteadyTube::steps_per_sample * time_step;
  const double all = 10.0 * total_mass(SteadyTube::start().grains);
  const double left = -tube().impulse[0] / time, right = -tube().impulse[1] / time;
  CAPTURE(all, left, right);
  CHECK(left + right == Approx(all).epsilon(0.02));  // but for the momentum at both ends
  CHECK(left == Approx(right).epsilon(0.25));        // by symmetry, in the mean over time
}
