// Grains flow down a chute with a rough bottom and a free surface, periodic along the flow:
// Silbert, Ertas, Grest, Halsey, Levine and Plimpton, Phys. Rev. E 64, 051302 (2001).
//
// x is the height above the bottom, y points down the slope. There is a range of inclinations with
// a steady flow: below it the layer comes to rest, above it it accelerates. In a steady flow
// friction in the whole layer balances gravity, and the velocity follows Bagnold's profile.
#include "scenarios/flow_start.hpp"
#include "scenarios/walls.hpp"

#include <fmt/core.h>

#include <numbers>
#include <vector>

namespace riesel::scenarios {

namespace {

using std::numbers::pi;

/// Area fraction of the grains where they start, above the bottom, to which they then fall.
constexpr double loose = 0.5;

io::SettingsTable chute_settings() {
  return {
      {.key = "chute.inclination",
       .unit = "rad",
       .fallback = "20 degrees",
       .range = io::between(0.0, 0.5 * pi),
       .doc = "Angle between the chute and the horizontal."},
      {.key = "chute.length",
       .unit = "m",
       .fallback = "20 mm",
       .range = io::positive(),
       .doc = "Period of the chute."},
      {.key = "chute.layers",
       .unit = "1",
       .fallback = "20",
       .range = io::between(0.1, 1e5),
       .doc =
           "Number of layers: area of the grains over that of one full layer, in which grains of "
           "the mean diameter lie side by side over the length; approximated to within one "
           "grain.",
       .only_when = io::When{"start.kind", {"fresh", "continued"}}},
      {.key = "chute.height",
       .unit = "m",
       .fallback = "40 mm",
       .range = io::positive(),
       .doc = "How far above the bottom line profiles are taken and the grains may start; it is no "
              "wall, but a grain at twice the height is lost."},
      {.key = "gravity",
       .unit = "m/s^2",
       .fallback = "10 m/s^2",
       .range = io::non_negative(),
       .doc = "Acceleration of free fall."},
  };
}

State empty_chute(const io::Settings& settings) {
  State state;
  state.box = {.width = settings.number("chute.height"), .length = settings.number("chute.length")};
  state.walls = {wall_at(0.0, settings, state.box, "chute.length")};
  const double gravity = settings.number("gravity");
  const auto [level, down] = direction(settings.number("chute.inclination"));
  state.gravity = {.x = -gravity * level, .y = gravity * down};
  return state;
}

/// `other_way`: what could be chosen besides a higher chute.
void reject_low_chute(const io::Settings& settings, double needed, const State& empty,
                      const char* other_way) {
  if (empty.box.width < needed)
    settings.reject("chute.height", "too low for the grains at their start",
                    fmt::format("choose {}, or chute.height above {:.6g} m", other_way, needed));
}

void reject_small_chute(const io::Settings& settings, const LargestGrain& largest,
                        const State& empty) {
  reject_short_period(settings, largest, empty, "chute.length");
  reject_low_chute(settings, largest.diameter + empty.walls.front().radius, empty,
                   "smaller grains");
}

/// Packs the grains between the bottom and a lid, which is not part of the flow.
std::vector<Grain> place_grains(const io::Settings& settings, const SizeDistribution& sizes,
                                const State& empty) {
  const double layer = 0.25 * pi * sizes.mean() * empty.box.length;
  const double area = settings.number("chute.layers") * layer;
  State covered = empty;
  covered.box.width =
      area / (loose * empty.box.length) + sizes.largest() + 2.0 * empty.walls.front().radius;
  reject_low_chute(settings, covered.box.width, empty, "fewer layers");
  covered.walls.push_back(empty.walls.front());  // whatever its motion: nothing moves yet
  covered.walls.back().line = covered.box.width;
  std::vector<Grain> grains =
      packed_grains(settings, radii_of_area(settings, sizes, area), covered);
  if (grains.empty())
    settings.reject("chute.layers", "no start without overlaps was found",
                    "choose grains of more equal size");
  return grains;
}

Problem prepare(const io::Settings& settings) {
  return start_flow(settings, {.empty = empty_chute(settings),
                               .reject_too_small = reject_small_chute,
                               .place_grains = place_grains});
}

}  // namespace

Scenario inclined_chute() {
  return {.name = "inclined_chute",
          .summary = "Grains flow down a chute with a rough bottom and a free surface: profiles of "
                     "velocity and area fraction (Silbert et al. 2001).",
          .own_settings =
              flow_table({size_settings(), wall_settings(), chute_settings(),
                          // Faster grains would fly out of the chute before they meet others.
                          start_velocity_settings("0", "0.1 m/s")}),
          .prepare = prepare};
}

}  // namespace riesel::scenarios
