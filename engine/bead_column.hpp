// A column of beads that falls on a plate: the set-up of Luding, Clement, Blumen, Rajchenbach and
// Duran, Phys. Rev. E 50, 4113 (1994).
//
// Hard beads collide one after the other (engine/rigid_column.hpp). Soft ones whose contacts last
// longer than the time between two collisions touch several others at once: they are coupled
// oscillators and dissipate less, the "detachment effect". Everything happens on a line, so the
// plate is a fixed wall grain hit head on: a body of infinite mass, whose radius plays no part.
#pragma once

#include "engine/contact_law.hpp"
#include "engine/simulation.hpp"

#include <cstdint>
#include <vector>

namespace riesel {

/// What all drops of a curve share. There is no gravity.
struct ColumnSetup {
  int beads;           ///< at least 1
  double bead_radius;  ///< m
  double bead_mass;    ///< kg
  double velocity;     ///< m/s, of all beads, towards the plate
  ContactModel model;
  double collision_time;  ///< s, of a bead with the plate
  double time_step;       ///< s
};

struct ColumnResult {
  double restitution;   ///< square root of the energy after over that before
  double rebound;       ///< velocity of the centre of mass after over that before, upwards
  double contacts;      ///< number of overlaps begun
  double contact_time;  ///< s, sum of the durations of those that have ended
  double max_overlap;   ///< m
  double energy_error;  ///< see energy_error_ratio()
  bool over;  ///< no contacts are left, and no two bodies approach noticeably; false: given up
  std::int64_t steps;
};

/// Drops a column with `gap` (m) between neighbours and follows it until it is over. Throws
/// std::invalid_argument for one without beads or velocity, and what Simulation throws.
ColumnResult drop(const ColumnSetup& setup, double gap, Stepping stepping = Stepping::automatic);

/// A drop for each gap, in parallel on `threads` threads, each as if alone. Throws what drop()
/// throws.
std::vector<ColumnResult> drop_all(const ColumnSetup& setup, const std::vector<double>& gaps,
                                   int threads);

/// 64-bit hash of all results.
std::uint64_t hash_of(const std::vector<ColumnResult>& results);

}  // namespace riesel
