// What must hold for every set-up, whatever it is.
#pragma once

#include "tests/properties/setups.hpp"

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace properties {

/// What was found to be wrong, one line each; empty if all is well.
using Complaints = std::vector<std::string>;

/// What a run comes to: its last state, or why it failed.
struct Outcome {
  riesel::State end;
  std::string failure;
};

/// Since the start.
std::int64_t contacts_begun(const riesel::State& state);

/// Plainly, on one thread, in one go.
Outcome reference(const SetUp& set_up);
/// By windows, in one go.
Outcome by_windows(const SetUp& set_up, int threads = 2);

/// Goes there again by several journeys, which change the way of stepping, the number of threads,
/// the order of the slots and the length of the advances on the way, look at the state, measure a
/// profile, and go through a checkpoint in `scratch`: every bit must be that of `expected`.
Complaints same_bits(const SetUp& set_up, const Outcome& expected, std::uint64_t seed,
                     const std::filesystem::path& scratch);

/// Goes there again by windows in one go, on this number of threads.
Complaints same_by_windows(const SetUp& set_up, const Outcome& expected, int threads);

/// Contacts that began have ended or last; damping and friction never win energy, nor does the
/// whole win or lose any but by the error of the time step; the walls gave the momentum along the
/// tube; without walls, grains of equal mass keep theirs to the last bit.
Complaints balances(const SetUp& set_up, const Outcome& outcome);

/// One impact of two grains, or of a grain on a corrugated wall, at any angle and of any law.
struct Impact {
  double gain;      ///< of kinetic and elastic energy, as a part of that of the relative motion
  double residual;  ///< of the balance of energy, as such a part
  std::int64_t contacts;
  double steps_per_contact;  ///< in contact_time()
  riesel::ContactModel model;
};

Impact random_impact(std::uint64_t seed);

}  // namespace properties
