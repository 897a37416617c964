// What tests of files need: a directory of their own, the bytes of files, another process, and a
// state in which every member is something special.
#pragma once

#include "engine/state.hpp"
#include "io/run_file.hpp"
#include "tests/catch.hpp"
#include "tests/message_of.hpp"
#include "tests/scratch_directory.hpp"

#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace file_fixture {

namespace fs = std::filesystem;

using riesel::message_of;
using riesel::ScratchDirectory;

inline std::string contents(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  REQUIRE(file.is_open());
  return {std::istreambuf_iterator<char>(file), {}};
}

inline void overwrite(const fs::path& path, const std::string& bytes) {
  std::ofstream file(path, std::ios::binary | std::ios::trunc);
  file.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  REQUIRE(file.good());
}

/// Calls action() in another process, and returns what it returned, 0 ... 255; an exception counts
/// as 99, a signal as 128 and its number.
template <class Action>
int in_other_process(Action action) {
  const pid_t child = fork();
  REQUIRE(child >= 0);
  if (child == 0) {
    try {
      _exit(action());
    } catch (...) {
      _exit(99);
    }
  }
  int status = 0;
  REQUIRE(waitpid(child, &status, 0) == child);
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

/// Of a series with two columns.
inline const std::vector<riesel::io::Column> columns = {
    {"time", "s", "Time since the start."}, {"velocity", "m/s", "Mean axial velocity."}};

inline riesel::Contact contact(riesel::ContactName name, double first) {
  riesel::Contact contact{.name = name};
  double value = first;
  for (auto* member :
       {&contact.begin, &contact.end, &contact.entry_rate, &contact.entry_slip, &contact.overlap,
        &contact.max_overlap, &contact.slip_path, &contact.elastic_energy, &contact.normal_loss,
        &contact.friction_loss, &contact.impulse_x, &contact.impulse_y,
        &contact.impulse_y_times_time, &contact.friction_x, &contact.friction_y, &contact.spring,
        &contact.torque, &contact.rolling_torque}) {
    *member = value;
    value = value * -1.3 + 0.1;
  }
  return contact;
}

inline riesel::WallVisit visit(std::int32_t wall, std::int32_t grain, double begin) {
  riesel::WallVisit visit(contact({wall, grain, 0}, 1.0 / 7.0), {begin, begin + 1.0 / 3.0});
  visit.contacts = 5;
  visit.impulse_y.add(-1e9 / 3.0);
  return visit;
}

inline riesel::ContactTally tally(double scale) {
  riesel::ContactTally tally;
  tally.begun = 7;
  tally.ended = 5;
  tally.max_overlap = 3e-5 * scale;
  double value = scale;
  for (auto* sum : {&tally.duration, &tally.slip_path, &tally.normal_loss, &tally.friction_loss,
                    &tally.energy_won, &tally.impulse_y, &tally.impulse_y_times_time}) {
    sum->add(value);
    value *= -1.7e-4;
  }
  tally.durations.add(3e-5 * std::abs(scale));
  tally.overlaps.add(1e-5 * std::abs(scale));
  return tally;
}

inline riesel::Tally whole_tally() {
  riesel::Tally whole;
  whole.grains = tally(-2.5);
  whole.walls = tally(1e10 / 3.0);
  whole.impulses.work.add(7e-3 / 3.0);
  whole.impulses.x[0].add(8e-3 / 3.0);
  whole.impulses.x[1].add(-9e-3 / 3.0);
  whole.impulses.y[0].add(-4e-3 / 3.0);
  whole.impulses.y[1].add(-5e-3 / 3.0);
  auto& b = whole.brakes;
  b.contacts = 11;
  b.cut_short = 3;
  double value = 1.0 / 3.0;
  const auto fill = [&](riesel::ExactSum& sum) { sum.add(value *= -1.9); };
  for (auto* sum : {&b.braking, &b.braking_cut_short, &b.friction_loss, &b.friction_loss_cut_short,
                    &b.entry_slip, &b.duration, &b.pulling}) {
    fill(*sum);
  }
  auto& v = whole.visits;
  v.of_contacts = {9, 8, 7, 6, 5, 4, 3, 2};
  v.contacts = 140;
  for (auto* sum : {&v.dv_y, &v.dv_x, &v.entry_rate, &v.entry_slip}) fill(*sum);
  v.entry_rates.add(0.1);
  v.entry_slips.add(1.0);
  return whole;
}

/// A state of `n` >= 4 grains, in the order of their ids, with numbers that a careless format would
/// lose: the extremes of the integers, denormals, negative zeros, numbers with no short decimals.
inline riesel::State special_state(std::size_t n = 4, double inertia = 0.0) {
  constexpr auto least = std::numeric_limits<riesel::Fixed>::min();
  constexpr auto most = std::numeric_limits<riesel::Fixed>::max();
  constexpr auto denormal = std::numeric_limits<double>::denorm_min();
  riesel::State state;
  state.box = {.width = 0.1 / 3.0, .length = 0.1};
  state.walls = {{.line = -0.0, .radius = 3.3e-4, .count = 83},
                 {.line = 0.02,
                  .radius = 0.0,
                  .count = 0,
                  .motion = {.velocity = -1.0 / 3.0,
                             .amplitude_x = 1e-6,
                             .amplitude_y = 1e-5,
                             .frequency = 100.0 / 7.0,
                             .phase = 0.1,
                             .start = least}}};
  state.gravity.y = -0.0;
  state.time_step = 1e-6 / 3.0;
  state.step = most / 4;  // more is refused
  auto& grains = state.grains;
  grains.inertia = inertia;
  grains.resize(n);
  for (std::size_t i = 0; i < n; ++i) {
    const auto k = static_cast<std::uint64_t>(i + 1) * 0x9e3779b97f4a7c15U;
    grains.position[i].x = static_cast<riesel::Fixed>(k);
    grains.position[i].y = static_cast<riesel::Fixed>(k * k);
    grains.u[i].x = static_cast<riesel::Fixed>(k * 3);
    grains.u[i].y = static_cast<riesel::Fixed>(k * 5);
    grains.kick[i].x = static_cast<riesel::Fixed>(k * 7);
    grains.kick[i].y = static_cast<riesel::Fixed>(k * 11);
    if (grains.rotate()) grains.spin[i] = static_cast<riesel::Fixed>(k * 13);
    if (grains.rotate()) grains.spin_kick[i] = static_cast<riesel::Fixed>(k * 17);
    grains.radius[i] = 5e-4 + 1e-6 / (3.0 + static_cast<double>(i));
    grains.mass[i] = 1e-6 / (7.0 + static_cast<double>(i));
    grains.id[i] = static_cast<std::int32_t>(i);
  }
  grains.position[0].x = grains.kick[1].x = least;
  grains.position[1].y = grains.u[0].y = most;
  grains.radius[2] = denormal;
  grains.mass[3] = std::numeric_limits<double>::max();
  state.contacts = {contact({riesel::no_wall, 0, 3}, 0.1), contact({riesel::no_wall, 1, 2}, -0.0),
                    contact({0, 0, 82}, denormal), contact({1, 2, 0}, 1e300)};
  state.open_visits = {visit(0, 0, -1.0 / 3.0), visit(0, 0, 0.1), visit(1, 3, denormal)};
  state.open_visits[2].span.end = std::numeric_limits<double>::infinity();
  state.tally = whole_tally();
  state.tally.grains.deepest = contact({riesel::no_wall, 0, 3}, 0.2);
  state.tally.walls.deepest = contact({1, 2, 0}, 0.3);
  state.origin = {.energy = 1.0 / 7.0, .momentum_y = -0.0, .moment_x = 1.0 / 11.0};
  return state;
}

/// The same state with the grains stored the other way round.
inline riesel::State reversed(riesel::State state) {
  for_each_array_of(state.grains, [](auto& array) { std::reverse(array.begin(), array.end()); });
  return state;
}

inline bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

}  // namespace file_fixture
