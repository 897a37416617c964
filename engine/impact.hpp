// A single grain thrown at a wall: the set-ups of Figs. 2 to 5 of Schaefer and Wolf.
#pragma once

#include "engine/contact_law.hpp"
#include "engine/state.hpp"

#include <cstdint>
#include <optional>
#include <vector>

namespace riesel {

/// What all impacts of a curve share. The wall stands at x = 0, wall grain 0 at y = 0; there is no
/// gravity.
struct ImpactSetup {
  double grain_radius;       ///< m
  double grain_mass;         ///< kg
  double wall_grain_radius;  ///< m
  double wall_spacing;       ///< m; a value <= 0 stands for a single wall grain
  ContactModel model;
  double inertia = 0.0;   ///< moment of inertia of the grain over m r^2; 0: it does not rotate
  double collision_time;  ///< s, of a head-on contact: the scale for giving up

  double reach() const { return grain_radius + wall_grain_radius; }  ///< m
  bool single_wall_grain() const { return wall_spacing <= 0.0; }
};

/// The start of one impact; x points from the wall into the tube.
struct Impact {
  double x, y;       ///< m
  double v_x;        ///< m/s, towards the wall
  double v_y;        ///< m/s, along it
  double time_step;  ///< s
};

enum class ImpactEnd {
  away,    ///< the grain has left the wall for good
  passed,  ///< it went through the wall
  stuck    ///< it still was at the wall when we gave up
};

struct ImpactResult {
  double dv_x;          ///< m/s, v_x after, away from the wall, plus v_x before, towards it
  double dv_y;          ///< m/s, loss of axial velocity
  double contacts;      ///< number of overlaps begun
  double contact_time;  ///< s, sum of the durations of those that have ended
  double max_overlap;   ///< m
  double cut_short;     ///< number of contacts cut short, see brake.hpp
  /// kg m/s, impulse against y of the contacts that brake, and of those among them cut short.
  double braking, braking_cut_short;
  double energy_error;  ///< see energy_error_ratio()
  ImpactEnd end;
  std::int64_t steps;
};

/// m, at which an impact may begin at most: the width of its box.
double greatest_height(const ImpactSetup& setup);

/// Follows one impact to its end. Throws std::invalid_argument for a grain at rest, and what
/// Simulation throws.
ImpactResult follow(const ImpactSetup& setup, const Impact& impact);

/// All impacts, in parallel on `threads` threads, each as if alone. Throws what follow() throws.
std::vector<ImpactResult> follow_all(const ImpactSetup& setup, const std::vector<Impact>& impacts,
                                     int threads);

/// Where a grain that comes from upstream along y at height x stands just before it touches wall
/// grain 0: m. Throws std::invalid_argument if it touches none.
double just_upstream(const ImpactSetup& setup, double x);

/// e_N of two bodies, `reduced_mass` in kg, that meet head-on with `speed` (m/s), under any law, in
/// steps so fine that they hardly count (measured: 5e-4). Nothing if they do not come apart.
std::optional<double> restitution(const ContactModel& model, double reduced_mass, double speed);

/// 64-bit hash of all results.
std::uint64_t hash_of(const std::vector<ImpactResult>& results);

}  // namespace riesel
