// A single grain thrown at a wall: the set-ups of Figs. 2 to 5 of Schaefer and Wolf, Phys. Rev. E
// 51, 6154 (1995).
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
  double collision_time;  ///< s, of a head-on contact: sets when an impact is given up

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
  stuck    ///< it was still at the wall when the impact was given up
};

struct ImpactResult {
  double dv_x;          ///< m/s, v_x after (away from the wall) plus v_x before (towards it)
  double dv_y;          ///< m/s, loss of axial velocity
  double contacts;      ///< number of overlaps begun
  double contact_time;  ///< s, sum of the durations of those that have ended
  double max_overlap;   ///< m
  double cut_short;     ///< number of contacts cut short, see brake.hpp
  /// kg m/s, impulse along -y of the contacts that brake, and of those of them that were cut short.
  double braking, braking_cut_short;
  double energy_error;  ///< see energy_error_ratio()
  ImpactEnd end;
  std::int64_t steps;
};

/// m, the largest |x| at which an impact may begin: the width of its box.
double greatest_height(const ImpactSetup& setup);

/// Follows one impact to its end. Throws std::invalid_argument for a grain at rest, and what
/// Simulation throws.
ImpactResult follow(const ImpactSetup& setup, const Impact& impact);

/// All impacts, in parallel on `threads` threads, each as if alone. Throws what follow() throws.
std::vector<ImpactResult> follow_all(const ImpactSetup& setup, const std::vector<Impact>& impacts,
                                     int threads);

/// m, the y of a grain that comes along +y at height `x` (m) just before it touches wall grain 0.
/// Throws std::invalid_argument if |x| is beyond the reach (and a small gap).
double just_upstream(const ImpactSetup& setup, double x);

/// e_N of two bodies with `reduced_mass` (kg) that meet head-on with `speed` (m/s), under any law.
/// It is simulated, with steps so short that their error is small (measured: 5e-4). Nothing if the
/// bodies do not rebound.
std::optional<double> restitution(const ContactModel& model, double reduced_mass, double speed);

/// 64-bit hash of all results.
std::uint64_t hash_of(const std::vector<ImpactResult>& results);

}  // namespace riesel
