#include "scenarios/grain_file.hpp"

#include "io/csv_table.hpp"
#include "scenarios/size_distribution.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace riesel::scenarios {

namespace {

constexpr auto from_key = "start.from";

/// Tolerated overlap over the sum of the radii, as numbers in a file are rounded.
constexpr double rounding = 1e-9;

io::CsvTable read_table(const io::Settings& settings) {
  return io::read_csv(settings, from_key,
                      {{.name = "x", .unit = "m"},
                       {.name = "y", .unit = "m"},
                       {.name = "vx", .unit = "m/s"},
                       {.name = "vy", .unit = "m/s"},
                       {.name = "diameter", .unit = "m"},
                       {.name = "mass", .unit = "kg", .required = false},
                       {.name = "spin", .unit = "rad/s", .required = false, .also = "1/s"}});
}

double positive(const io::CsvTable& table, std::size_t row, const std::string& column) {
  const double value = table.value(row, column);
  if (value <= 0.0)
    table.reject(row, column, "is not above 0", "give the " + column + " of the grain");
  return value;
}

/// m. Rejects grains far smaller than the tube is long: positions are resolved to a certain part of
/// its length.
double diameter_of(const io::CsvTable& table, std::size_t row, double tube_length) {
  const double least = 1e-6 * tube_length;
  const double value = positive(table, row, "diameter");
  if (value < least)
    table.reject(row, "diameter", "is less than a millionth of the length of the tube",
                 fmt::format("give the diameter of the grain, at least {:.3g} m", least));
  return value;
}

/// kg; in proportion to the area if the file has no masses.
double mass_of(const io::Settings& settings, const io::CsvTable& table, std::size_t row) {
  if (table.has("mass")) return positive(table, row, "mass");
  return mass_of_diameter(settings, table.value(row, "diameter"));
}

/// rad/s; rejects a column of spins if grains do not rotate.
double spin_of(const io::CsvTable& table, std::size_t row, bool rotate) {
  if (!table.has("spin")) return 0.0;
  if (!rotate)
    table.reject(row, "spin", "has no effect, as grains do not rotate",
                 "remove the column, or let them rotate by grains.rotation");
  return table.value(row, "spin");
}

void require_within(const io::CsvTable& table, std::size_t row, const std::string& column,
                    double end) {
  const double value = table.value(row, column);
  if (value < 0.0 || value > end)
    table.reject(row, column, fmt::format("{:.6g} m is outside of the tube", value),
                 fmt::format("choose it from 0 to {:.6g} m", end));
}

/// Overlap (m) of two bodies, with the nearest image along y; negative if they are apart. `reach`
/// (m) is the sum of their radii.
double overlap(const Box& box, double dx, double dy, double reach) {
  return reach - std::hypot(dx, std::remainder(dy, box.length));
}

void reject_in_a_wall(const io::CsvTable& table, const State& empty,
                      const std::vector<Grain>& grains) {
  for (std::size_t row = 0; row < grains.size(); ++row) {
    const Grain& g = grains[row];
    for (const WallLattice& wall : empty.walls) {
      const double reach = g.radius + wall.radius;
      const auto look = [&](std::int64_t, Fixed y) {
        const double deep = overlap(empty.box, g.x - wall.line, g.y - empty.box.place_y(y), reach);
        if (deep > rounding * reach)
          table.reject(row, "x", fmt::format("stands {:.3g} m deep in a wall grain", deep),
                       "move the grain, or change wall or tube");
      };
      for_each_wall_grain_within(wall, empty.box, empty.box.fixed_y(g.y), reach, look);
    }
  }
}

/// Searches from each grain along +y, across the seam of the period, as far as the largest grain
/// reaches.
void reject_in_each_other(const io::CsvTable& table, const Box& box,
                          const std::vector<Grain>& grains) {
  std::vector<std::size_t> order(grains.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, {}, [&](std::size_t i) { return grains[i].y; });
  const double largest = std::ranges::max(grains, {}, &Grain::radius).radius;
  for (std::size_t i = 0; i < order.size(); ++i) {
    const Grain& a = grains[order[i]];
    for (std::size_t step = 1; step < order.size(); ++step) {
      const std::size_t j = (i + step) % order.size();
      const Grain& b = grains[order[j]];
      const double ahead = b.y - a.y + (j < i ? box.length : 0.0);
      if (ahead > a.radius + largest) break;
      const double reach = a.radius + b.radius;
      const double deep = overlap(box, b.x - a.x, b.y - a.y, reach);
      if (deep <= rounding * reach) continue;
      const auto [first, second] = std::minmax(order[i], order[j]);
      table.reject(
          second, "x",
          fmt::format("overlaps the grain in line {} by {:.3g} m", table.line(first), deep),
          "move one of them; a state with contacts can be continued from its checkpoint");
    }
  }
}

/// gamma_N follows from the restitution of a certain pair, and no grain of the file need be of the
/// default mass.
void reject_restitution_of_no_grain(const io::Settings& settings, const io::CsvTable& table) {
  constexpr auto restitution = "contact.restitution", mass = "grains.mass";
  const bool of_a_grain = settings.text("contact.law") == "linear" && settings.has(restitution)
                          && settings.text("contact.restitution_of") != "all";
  if (of_a_grain && table.has("mass") && !settings.given(mass))
    settings.reject(restitution, "of which grain? Masses come from the file of grains",
                    fmt::format("give the mass of the grain that is meant by {}, or choose "
                                "contact.restitution_of: all",
                                mass));
}

}  // namespace

std::vector<Grain> grains_of_file(const io::Settings& settings, const Room& room) {
  const State& empty = room.empty;
  const io::CsvTable table = read_table(settings);
  reject_restitution_of_no_grain(settings, table);
  std::vector<Grain> grains;
  for (std::size_t row = 0; row < table.rows(); ++row) {
    require_within(table, row, "x", empty.box.width);
    require_within(table, row, "y", empty.box.length);
    grains.push_back({.x = table.value(row, "x"),
                      .y = table.value(row, "y"),
                      .vx = table.value(row, "vx"),
                      .vy = table.value(row, "vy"),
                      .radius = 0.5 * diameter_of(table, row, empty.box.length),
                      .mass = mass_of(settings, table, row),
                      .spin = spin_of(table, row, empty.grains.rotate())});
  }
  // First, as walls are looked at grain by grain of theirs.
  room.reject_too_small(
      settings, {2.0 * std::ranges::max(grains, {}, &Grain::radius).radius, from_key}, empty);
  reject_in_a_wall(table, empty, grains);
  reject_in_each_other(table, empty.box, grains);
  return grains;
}

}  // namespace riesel::scenarios
