#include "engine/state_check.hpp"

#include "engine/contact_tile.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <sstream>
#include <tuple>
#include <vector>

namespace riesel {

namespace {

/// All arguments as one text.
template <class... Parts>
std::string joined(const Parts&... parts) {
  std::ostringstream text;
  (text << ... << parts);
  return text.str();
}

/// Limit for numbers of steps and of contacts: more than any run can reach, but far from overflow.
constexpr std::int64_t most_of_anything = std::int64_t{1} << 61;

bool is_index(std::int64_t index, std::size_t size) {
  return index >= 0 && static_cast<std::uint64_t>(index) < size;
}

std::string flaw_of_scalars(const State& state) {
  if (!is_positive(state.box.width)) return "the width of the box is not positive";
  if (!is_positive(state.box.length)) return "the length of the box is not positive";
  if (!is_positive(state.time_step)) return "the time step is not positive";
  if (!std::isfinite(state.gravity.x) || !std::isfinite(state.gravity.y))
    return "gravity is not finite";
  const Origin& origin = state.origin;
  if (!std::isfinite(origin.energy) || !std::isfinite(origin.momentum_y)
      || !std::isfinite(origin.moment_x)) {
    return "the energy, momentum or moment at the start is not finite";
  }
  if (state.step < 0) return "the number of steps is negative";
  if (state.step > most_of_anything) return "the number of steps is absurd";
  return {};
}

std::string flaw_of_walls(const State& state) {
  if (state.walls.size() > WallImpulses::most_walls)
    return joined("there are ", state.walls.size(), " walls");
  for (std::size_t i = 0; i < state.walls.size(); ++i) {
    const auto& wall = state.walls[i];
    if (!std::isfinite(wall.line)) return joined("the line of wall ", i, " is not finite");
    if (!wall.motion.is_within(state.box, state.time_step))
      return joined("wall ", i, " moves too far or too fast");
    if (!wall.sound())
      return joined("wall ", i, " has ", wall.count, " grains of radius ", wall.radius);
    if (i > 0 && wall.line < state.walls[i - 1].line)
      return joined("wall ", i, " is to the left of the one before");
  }
  return {};
}

std::string flaw_of_grains(const Grains& grains) {
  if (grains.size() == 0) return "there are no grains";
  if (!std::isfinite(grains.inertia) || grains.inertia < 0.0)
    return "the moment of inertia is negative";
  bool equal_sizes = grains.rotate() || (grains.spin.empty() && grains.spin_kick.empty());
  for_each_array_of(grains, [&](const auto& array) {
    equal_sizes = equal_sizes && array.size() == grains.size();
  });
  if (!equal_sizes) return "not all grains have all values";

  std::vector<bool> seen(grains.size());
  for (const auto id : grains.id) {
    if (!is_index(id, grains.size())) return joined("the id ", id, " is out of range");
    if (seen[static_cast<std::size_t>(id)]) return joined("two grains have the id ", id);
    seen[static_cast<std::size_t>(id)] = true;
  }
  for (std::size_t i = 0; i < grains.size(); ++i) {
    const auto is_wrong = [&](const char* what) {
      return joined("the ", what, " of grain ", grains.id[i], " is not positive");
    };
    if (!is_positive(grains.radius[i])) return is_wrong("radius");
    if (!is_positive(grains.mass[i])) return is_wrong("mass");
  }
  return {};
}

bool is_finite(const Contact& contact) {
  return std::ranges::all_of(life_of(contact), [](double value) { return std::isfinite(value); });
}

std::string flaw_of_contacts(const State& state) {
  const ContactName* last = nullptr;
  for (const auto& contact : state.contacts) {
    const auto& name = contact.name;
    const auto text = [&] {
      return joined("the contact (wall ", name.wall, ", grain ", name.grain, ", partner ",
                    name.partner, ")");
    };
    if (!names_bodies(name, state.grains.size(), state.walls))
      return text() + " is between bodies that do not exist";
    if (last != nullptr && !(*last < name)) return text() + " is out of order";
    if (!is_finite(contact)) return text() + " has a value that is not finite";
    last = &name;
  }
  return {};
}

/// Whether the numbers of a visit are usable. The end of its span may be infinite: that of a grain
/// at rest at a wall, without gravity, is.
bool has_numbers(const WallVisit& visit) {
  return std::isfinite(visit.span.begin) && !std::isnan(visit.span.end)
         && std::isfinite(visit.entry_rate) && std::isfinite(visit.entry_slip);
}

std::string flaw_of_visits(const State& state) {
  const auto key = [](const WallVisit& v) { return std::tie(v.wall, v.grain, v.span.begin); };
  const WallVisit* last = nullptr;
  for (const auto& visit : state.open_visits) {
    const auto text = [&] {
      return joined("the visit of grain ", visit.grain, " to wall ", visit.wall);
    };
    if (!is_index(visit.grain, state.grains.size()) || !is_index(visit.wall, state.walls.size()))
      return text() + " is between bodies that do not exist";
    if (!has_numbers(visit)) return text() + " has a value that is not finite";
    if (last != nullptr && !(key(*last) < key(visit))) return text() + " is out of order";
    if (visit.contacts < 1) return text() + " has no contacts";
    last = &visit;
  }
  return {};
}

std::string flaw_of_tally(const ContactTally& tally) {
  if (tally.begun < 0 || tally.ended < 0) return "a count of contacts is negative";
  if (std::max(tally.begun, tally.ended) > most_of_anything) return "a count of contacts is absurd";
  if (!std::isfinite(tally.max_overlap)) return "the greatest overlap is not finite";
  if (tally.max_overlap > 0.0 && !tally.deepest) return "nobody had the greatest overlap";
  return {};
}

std::string flaw_of_walls_tally(const Tally& tally) {
  const auto& visits = tally.visits.of_contacts;
  const bool negative =
      tally.brakes.contacts < 0 || tally.brakes.cut_short < 0 || tally.visits.contacts < 0
      || std::any_of(visits.begin(), visits.end(), [](std::int64_t count) { return count < 0; });
  return negative ? "a count of contacts with walls is negative" : std::string();
}

}  // namespace

std::string flaw_of(const State& state) {
  auto flaw = flaw_of_scalars(state);
  if (flaw.empty()) flaw = flaw_of_walls(state);
  if (flaw.empty()) flaw = flaw_of_grains(state.grains);
  if (flaw.empty()) flaw = flaw_of_contacts(state);
  if (flaw.empty()) flaw = flaw_of_visits(state);
  if (flaw.empty()) flaw = flaw_of_tally(state.tally.grains);
  if (flaw.empty()) flaw = flaw_of_tally(state.tally.walls);
  if (flaw.empty()) flaw = flaw_of_walls_tally(state.tally);
  return flaw;
}

bool names_bodies(const ContactName& name, std::size_t grains, std::span<const WallLattice> walls) {
  if (!is_index(name.grain, grains)) return false;
  if (name.wall == no_wall) return is_index(name.partner, grains) && name.grain < name.partner;
  if (!is_index(name.wall, walls.size())) return false;
  const WallLattice& wall = walls[static_cast<std::size_t>(name.wall)];
  return is_index(name.partner, static_cast<std::size_t>(wall.partners()));
}

}  // namespace riesel
