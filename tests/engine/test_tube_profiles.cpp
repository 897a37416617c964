// Profiles across the tube: closed forms of an ideal gas, and error bars that keep their word.
#include "engine/observables.hpp"
#include "engine/tube_profiles.hpp"
#include "tests/catch.hpp"
#include "tests/engine/systems.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <string>
#include <string_view>
#include <vector>

using namespace systems;

namespace {

double gaussian(Dice& dice) {
  return std::sqrt(-2.0 * std::log(1.0 - dice.between(0.0, 1.0)))
         * std::cos(2.0 * std::numbers::pi * dice.between(0.0, 1.0));
}

constexpr double mean_vy = 3.0, sigma_x = 0.2, sigma_y = 0.4;  // m/s
constexpr Frame in_frame{.vx = 0.0, .vy = mean_vy};

/// Grains that know nothing of each other; v_y grows by 0.1 m/s per mm across the tube.
State ideal_gas(Dice& dice) {
  State state = empty_box(4e-3, 50e-3);
  for (int i = 0; i < 100; ++i) {
    const double x = dice.between(0.0, 4e-3);
    add_grain(state, grain(x, dice.between(0.0, 50e-3), sigma_x * gaussian(dice),
                           mean_vy + 100.0 * x + sigma_y * gaussian(dice)));
  }
  return state;
}

const TubeProfile& find(const std::vector<TubeProfile>& profiles, std::string_view name) {
  const auto found = std::ranges::find(profiles, name, &TubeProfile::name);
  REQUIRE(found != profiles.end());
  return *found;
}

/// One strip in which `grains` stand all the time and these are the sums.
std::vector<double> one_strip(double grains, double vy, double w) {
  std::vector<double> sample(strip_sums);
  sample[Strips::column(0, StripSum::grains)] = grains;
  sample[Strips::column(0, StripSum::vy)] = grains * vy;
  sample[Strips::column(0, StripSum::w)] = grains * w;
  sample[Strips::column(0, StripSum::w2)] = grains * w * w;
  return sample;
}

/// A strip of 10 m^2 in which no two sums are alike, in the order of StripSum.
constexpr Strips odd_strip{.width = 2.0, .length = 5.0, .count = 1};
constexpr std::array<double, strip_sums> odd_sums = {
    3.0,  4.0,    20.0, 1.6,  2.0,  5.0,  // area, grains, v_y, u^2, w, w^2
    1.0,  1.25,   1.5,                    // z, z^2, z w
    8.0,  2.0,    3.0,  7.7,              // spin, I / m and with spin, spin^2
    7.0,  11.0,   13.0, 14.0, 45.0,       // mass and with v_x^2, v_x w, w, w^2
    1.75, 3.9375, 10.5,                   // with z, z^2, z w
    19.0, 23.0,   29.0, 31.0};            // of contacts: xx, xy, yx, yy

struct OddProfile {
  std::string_view name;
  double value;
  std::vector<StripSum> sums;  ///< that it depends on
};

std::vector<OddProfile> odd_profiles() {
  using S = StripSum;
  // In the mean over grains w is 0.5 m/s with a variance of 1, z is 0.25 with one of 0.25, and w
  // grows by 1 m/s per z. In that over mass these are 2 m/s and 17/7, 0.25 and 0.5, and 2 m/s.
  const std::vector<S> of_w2 = {S::w2, S::w, S::grains, S::z, S::z2, S::zw};
  const std::vector<S> of_mass_w2 = {S::mass_w2, S::mass_w,  S::mass,
                                     S::mass_z,  S::mass_z2, S::mass_zw};
  std::vector<S> of_stress_yy = of_mass_w2;
  of_stress_yy.push_back(S::contact_yy);
  return {{"area_fraction", 0.3, {S::area}},
          {"density", 0.7, {S::mass}},
          {"mean_axial_velocity", 5.0, {S::vy, S::grains}},
          {"shear_rate", 0.5, {S::zw, S::w, S::z2, S::grains}},  // a mere z does not turn this line
          {"temperature_x", 0.4, {S::u2, S::grains}},
          {"temperature_y", 1.0 - 0.25, of_w2},
          {"mean_spin", 2.0, {S::spin, S::grains}},
          {"rotational_temperature",
           0.8,
           {S::gyration2_spin2, S::gyration2_spin, S::gyration2, S::grains}},
          {"stress_xx", 3.0, {S::mass_vx2, S::contact_xx}},
          {"stress_xy", 3.6, {S::mass_vx_w, S::contact_xy}},
          {"stress_yx", 4.2, {S::mass_vx_w, S::contact_yx}},
          {"stress_yy", 1.7 - 1.4 + 3.1, of_stress_yy},
          {"kinetic_stress_xx", 1.1, {S::mass_vx2}},
          {"kinetic_stress_xy", 1.3, {S::mass_vx_w}},
          {"kinetic_stress_yy", 1.7 - 1.4, of_mass_w2},
          {"contact_stress_xx", 1.9, {S::contact_xx}},
          {"contact_stress_xy", 2.3, {S::contact_xy}},
          {"contact_stress_yx", 2.9, {S::contact_yx}},
          {"contact_stress_yy", 3.1, {S::contact_yy}}};
}

}  // namespace

TEST_CASE("an ideal gas has the stress of density times temperature, and no more") {
  // v_y grows by 0.1 m/s within a strip: its variance would be greater by 0.1^2 / 12.
  Dice dice(91);
  Strips strips{};
  TimeBlocks blocks;
  constexpr int samples = 400;
  for (int i = 0; i < samples; ++i) {
    const State gas = ideal_gas(dice);
    if (i == 0) {
      strips = Strips::of(gas);
      blocks = TimeBlocks(strips.columns());
    }
    blocks.add(sum_over_strips(strips, gas, paper_model(), in_frame));
  }
  REQUIRE(strips.count == 4);
  const auto profiles = tube_profiles(blocks, strips, each_strip(strips), 0);
  const auto at = [&](std::string_view name, std::size_t strip) {
    return find(profiles, name).zones[strip];
  };
  const auto agrees = [](const Estimate& e, double expected) {
    CAPTURE(e.value, e.error, expected);
    CHECK(e.error > 0.0);
    CHECK(e.error < 0.05 * std::abs(expected));
    CHECK(std::abs(e.value - expected) < 4.0 * e.error);
  };
  const double rho = 100.0 * mass / (4e-3 * 50e-3);  // kg/m^2
  const double temperature_y = sigma_y * sigma_y;
  for (std::size_t s = 0; s < strips.count; ++s) {
    agrees(at("density", s), rho);
    agrees(at("mean_axial_velocity", s), mean_vy + 0.1 * (static_cast<double>(s) + 0.5));
    agrees(at("temperature_x", s), sigma_x * sigma_x);
    agrees(at("temperature_y", s), temperature_y);
    agrees(at("kinetic_stress_xx", s), rho * sigma_x * sigma_x);
    agrees(at("kinetic_stress_yy", s), rho * temperature_y);
    // Grains of equal mass
    CHECK(at("kinetic_stress_xx", s).value
          == Approx(at("density", s).value * at("temperature_x", s).value).epsilon(1e-9));
    CHECK(at("kinetic_stress_yy", s).value
          == Approx(at("density", s).value * at("temperature_y", s).value).epsilon(1e-9));
    const Estimate shear = at("kinetic_stress_xy", s);
    CHECK(shear.error < 0.05 * rho * sigma_x * sigma_y);
    CHECK(std::abs(shear.value) < 4.0 * shear.error);
    // No contact was seen, which does not tell how many there are.
    for (const std::string component : {"xx", "xy", "yx", "yy"}) {
      const Estimate contact = at("contact_stress_" + component, s);
      CHECK(contact.value == 0.0);
      CHECK(std::isnan(contact.error));
      CHECK(std::isnan(at("stress_" + component, s).error));
    }
    CHECK(at("stress_xx", s).value == at("kinetic_stress_xx", s).value);
    CHECK(at("stress_xy", s).value == shear.value);
    CHECK(at("stress_yy", s).value == at("kinetic_stress_yy", s).value);
  }
  double covered = 0.0;
  for (std::size_t s = 0; s < strips.count; ++s) covered += at("area_fraction", s).value;
  CHECK(covered * strips.area()
        == Approx(100.0 * std::numbers::pi * radius * radius).epsilon(1e-9));
}

TEST_CASE("the profile of the velocity is no temperature, however steep") {
  // By 0.4 m/s per mm: within a strip its variance would be 0.4^2 / 12, a third of sigma_x^2
  Dice dice(95);
  constexpr double steep = 400.0;
  const auto sheared_gas = [&] {
    State gas = ideal_gas(dice);
    State steeper = empty_box(gas.box.width, gas.box.length);
    for (std::size_t slot = 0; slot < gas.grains.size(); ++slot) {
      Grain g = grain_at(gas, slot);
      g.vy += (steep - 100.0) * g.x;
      add_grain(steeper, g);
    }
    return steeper;
  };
  const Strips strips = Strips::of(ideal_gas(dice));
  TimeBlocks blocks(strips.columns());
  for (int i = 0; i < 400; ++i)
    blocks.add(sum_over_strips(strips, sheared_gas(), paper_model(), in_frame));
  const auto profiles = tube_profiles(blocks, strips, each_strip(strips), 0);
  for (const Estimate& temperature : find(profiles, "temperature_y").zones) {
    CAPTURE(temperature.value, temperature.error);
    CHECK(temperature.error < 0.03 * sigma_y * sigma_y);
    CHECK(std::abs(temperature.value - sigma_y * sigma_y) < 4.0 * temperature.error);
  }
  for (const Zone& zone : {Zone{0}, Zone{3}, Zone{1, 2}, Zone{0, 1, 2, 3}, Zone{0, 3}}) {
    const Estimate rate = find(tube_profiles(blocks, strips, {zone}, 0), "shear_rate").zones[0];
    CAPTURE(zone, rate.value, rate.error);
    CHECK(rate.error < 0.05 * steep);
    CHECK(std::abs(rate.value - steep) < 4.0 * rate.error);
  }
}

TEST_CASE("what all grains do together is no temperature, but a stress across") {
  Dice dice(96);
  constexpr double sway = 0.7;  // m/s
  const Strips strips = Strips::of(ideal_gas(dice));
  TimeBlocks blocks(strips.columns());
  for (int i = 0; i < 400; ++i) {
    const State gas = ideal_gas(dice);
    State swaying = empty_box(gas.box.width, gas.box.length);
    for (std::size_t slot = 0; slot < gas.grains.size(); ++slot) {
      Grain g = grain_at(gas, slot);
      g.vx += i % 2 == 0 ? sway : -sway;
      g.vy += i % 3 == 0 ? sway : 0.0;
      add_grain(swaying, g);
    }
    const Observables now = observe(swaying);
    blocks.add(
        sum_over_strips(strips, swaying, paper_model(), {.vx = now.mean_vx, .vy = now.mean_vy}));
  }
  const auto core = tube_profiles(blocks, strips, {core_of(strips)}, 0);
  const auto agrees = [&](const char* name, double expected) {
    const Estimate e = find(core, name).zones[0];
    CAPTURE(name, e.value, e.error, expected);
    CHECK(e.error < 0.03 * expected);
    CHECK(std::abs(e.value - expected) < 4.0 * e.error);
  };
  constexpr double own = 0.99;  // a hundredth of what a grain does is done by all
  agrees("temperature_x", own * sigma_x * sigma_x);
  agrees("temperature_y", own * sigma_y * sigma_y);
  const double rho = find(core, "density").zones[0].value;
  agrees("kinetic_stress_xx", rho * (sigma_x * sigma_x + sway * sway));
}

TEST_CASE("each profile is made of the sums that its name says") {
  TimeBlocks blocks(strip_sums);
  for (int i = 0; i < 30; ++i) blocks.add(odd_sums);
  const auto profiles = tube_profiles(blocks, odd_strip, each_strip(odd_strip), 0);
  CHECK(profiles.size() == odd_profiles().size());
  for (const OddProfile& expected : odd_profiles()) {
    CAPTURE(std::string(expected.name));
    CHECK(find(profiles, expected.name).zones[0].value == Approx(expected.value));
  }
}

TEST_CASE("the error bar of a profile is that of the sums it is made of, and of no others") {
  Dice dice(94);
  for (std::size_t scattering = 0; scattering < strip_sums; ++scattering) {
    TimeBlocks blocks(strip_sums);
    for (int i = 0; i < 100; ++i) {
      auto sample = odd_sums;
      sample[scattering] *= dice.between(0.9, 1.1);
      blocks.add(sample);
    }
    const auto profiles = tube_profiles(blocks, odd_strip, each_strip(odd_strip), 0);
    for (const OddProfile& expected : odd_profiles()) {
      const bool scatters = std::ranges::find(expected.sums, static_cast<StripSum>(scattering))
                            != expected.sums.end();
      const double error = find(profiles, expected.name).zones[0].error;
      CAPTURE(std::string(expected.name), scattering, error);
      if (scatters)
        CHECK(error > 1e-4);
      else
        // Means over grains that do not vary have an unknown one. By its square z turns a line.
        CHECK_FALSE(error > 3e-5);
    }
  }
}

TEST_CASE("the core is the middle half, without the strips at the walls") {
  const auto core = [](std::size_t count) {
    return core_of({.width = 1e-3, .length = 1.0, .count = count});
  };
  CHECK(core(1) == Zone{0});
  CHECK(core(2) == Zone{0, 1});
  CHECK(core(3) == Zone{1});
  CHECK(core(4) == Zone{1, 2});
  CHECK(core(7) == Zone{2, 3, 4});
  CHECK(core(20) == Zone{5, 6, 7, 8, 9, 10, 11, 12, 13, 14});
}

TEST_CASE("a zone is its strips taken together") {
  Dice dice(92);
  const Strips strips = Strips::of(ideal_gas(dice));
  TimeBlocks blocks(strips.columns());
  for (int i = 0; i < 50; ++i)
    blocks.add(sum_over_strips(strips, ideal_gas(dice), paper_model(), in_frame));
  CHECK(wall_layers_of(strips, 2) == Zone{0, 3});
  CHECK(wall_layers_of(strips, 1) == Zone{0});
  const auto profiles = tube_profiles(blocks, strips, {{1}, {2}, {1, 2}}, 0);
  const auto density = find(profiles, "density").zones;
  CHECK(density[2].value == Approx(0.5 * (density[0].value + density[1].value)));
  const auto velocity = find(profiles, "mean_axial_velocity").zones;
  CHECK(velocity[2].value
        == Approx((density[0].value * velocity[0].value + density[1].value * velocity[1].value)
                  / (density[0].value + density[1].value)));
  // v_y differs by 0.1 m/s from strip to strip, which would be a temperature of its own.
  const auto temperature = find(profiles, "temperature_y").zones;
  CHECK(
      temperature[2].value
      == Approx((density[0].value * temperature[0].value + density[1].value * temperature[1].value)
                / (density[0].value + density[1].value)));
  for (const char* name : {"stress_yy", "kinetic_stress_yy"}) {
    const auto stress = find(profiles, name).zones;
    CHECK(stress[2].value == Approx(0.5 * (stress[0].value + stress[1].value)));
  }
  // Strips of an ideal gas know nothing of each other.
  for (const char* name : {"temperature_y", "kinetic_stress_yy", "mean_axial_velocity"}) {
    const auto both = find(profiles, name).zones;
    CHECK(both[2].error < std::max(both[0].error, both[1].error));
  }
}

TEST_CASE("what was not seen is not known") {
  const Strips strips{.width = 1.0, .length = 1.0, .count = 1};
  TimeBlocks blocks(strip_sums);
  for (int i = 0; i < 30; ++i) blocks.add(one_strip(0.0, 0.0, 0.0));
  auto profiles = tube_profiles(blocks, strips, each_strip(strips), 0);
  CHECK(find(profiles, "density").zones[0].value == 0.0);
  for (const char* name : {"mean_axial_velocity", "temperature_x", "temperature_y"})
    CHECK(std::isnan(find(profiles, name).zones[0].value));
  CHECK(find(profiles, "stress_yy").zones[0].value == 0.0);
  profiles = tube_profiles(blocks, strips, each_strip(strips), 30);
  for (const TubeProfile& profile : profiles) {
    CHECK(std::isnan(profile.zones[0].value));
    CHECK(std::isnan(profile.zones[0].error));
  }
  profiles = tube_profiles(blocks, strips, each_strip(strips), 29);  // one sample has no scatter
  CHECK(find(profiles, "density").zones[0].value == 0.0);
  CHECK(std::isnan(find(profiles, "density").zones[0].error));
}

TEST_CASE("how a mean over grains scatters is not known if all rows have caught the same flight") {
  const Strips strips{.width = 1.0, .length = 1.0, .count = 1};
  TimeBlocks blocks(strip_sums);
  for (int i = 0; i < 30; ++i) blocks.add(one_strip(i % 3 == 0 ? 1.0 : 0.0, 3.0, 0.0));
  for (const auto& [name, known] : std::map<std::string, bool>{{"density", true},
                                                               {"mean_axial_velocity", false},
                                                               {"temperature_x", false},
                                                               {"mean_spin", true}}) {
    INFO(name);
    const auto zone = find(tube_profiles(blocks, strips, each_strip(strips), 0), name).zones[0];
    CHECK(std::isfinite(zone.value));
    CHECK(std::isfinite(zone.error) == known);
  }
}

TEST_CASE("error bars of profiles cover the truth as often as they say, correlations or not") {
  // w is an AR(1) series of variance 1 about 0, in a strip with a number of grains that changes.
  const Strips strips{.width = 1.0, .length = 1.0, .count = 1};
  Dice dice(93);
  for (const double phi : {0.0, 0.9}) {
    constexpr int runs = 400;
    int velocity_covered = 0, temperature_covered = 0;
    for (int run = 0; run < runs; ++run) {
      TimeBlocks blocks(strip_sums);
      double w = gaussian(dice);
      for (int i = 0; i < 3000; ++i) {
        w = phi * w + std::sqrt(1.0 - phi * phi) * gaussian(dice);
        blocks.add(one_strip(static_cast<double>(1 + dice.below(9)), 5.0 + w, w));
      }
      const auto profiles = tube_profiles(blocks, strips, each_strip(strips), 0);
      const auto covers = [&](std::string_view name, double truth) {
        const Estimate e = find(profiles, name).zones[0];
        return std::abs(e.value - truth) < e.error;
      };
      velocity_covered += covers("mean_axial_velocity", 5.0) ? 1 : 0;
      temperature_covered += covers("temperature_y", 1.0) ? 1 : 0;
    }
    // 68 %, and the standard deviation of 400 such tries is 2.3 %.
    CAPTURE(phi);
    CHECK(std::abs(velocity_covered / static_cast<double>(runs) - 0.68) < 0.08);
    CHECK(std::abs(temperature_covered / static_cast<double>(runs) - 0.68) < 0.08);
  }
}
