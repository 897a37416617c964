// summary.json: the result of a run in one small file, for people and scripts. SI units.
//
// The names of its members are a contract, described in docs/files.md.
#pragma once

#include "engine/density_waves.hpp"
#include "engine/estimate.hpp"
#include "engine/observables.hpp"
#include "engine/rigid_column.hpp"
#include "engine/validity.hpp"
#include "engine/wall_visits.hpp"

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace riesel::io {

/// Of what stands in the file: raised when a name that a reader needs changes its meaning, goes, or
/// comes. Version 1 had no number; in version 2 names have come until riesel 0.5.0.
inline constexpr int summary_format = 2;

/// What every summary tells.
struct RunSummary {
  std::string scenario;
  std::int64_t grains = 0;
  std::int64_t steps = 0;
  std::uint64_t state_hash = 0;  ///< written as 16 hexadecimal digits
  double wall_seconds = 0.0;
  double particle_steps_per_second = 0.0;
  int threads = 1;
};

/// Not a number stands as null in the file.
using Measured = Estimate;

/// Means are over the samples after the transient.
struct FlowSummary {
  RunSummary run;
  double time = 0.0;           ///< s, simulated
  double transient_end = 0.0;  ///< s
  /// Why the run ended: `duration`, `precision` (its mean is known as well as was asked for) or
  /// `at_most` (it is not, and the time was up).
  std::string ended_by = "duration";
  std::string state;                  ///< steady, accelerating, drifting or too_short
  std::string judged_by = "mean_vy";  ///< the series that `state` is a verdict on
  Measured mean_axial_velocity;       ///< m/s; while a flow accelerates its error is not known
  double independent_samples = 0.0;
  double granular_temperature = 0.0;  ///< (m/s)^2

  /// Of the grains' velocities, over the whole tube at one moment.
  struct Fluctuations {
    Measured sigma_vx, sigma_vy;    ///< m/s
    Measured granular_temperature;  ///< (m/s)^2
  } fluctuations;

  std::array<Measured, density_waves> structure_factor{};  ///< along the tube, n = 1, 2, ...

  /// Of a part of the tube's width: engine/tube_profiles.hpp.
  struct Zone {
    Measured area_fraction;
    Measured mean_axial_velocity;           ///< m/s
    Measured temperature_x, temperature_y;  ///< (m/s)^2
    Measured stress_xx, stress_yy;          ///< N/m
  } core, wall_layers;

  /// Eq. (9): in a steady state n_dot dv_y = gravity.
  struct Balance {
    Measured n_dot;        ///< 1/s, wall contacts per grain
    Measured dv_y;         ///< m/s, momentum lost per wall contact over the mean mass
    Measured n_dot_dv_y;   ///< m/s^2
    double gravity = 0.0;  ///< m/s^2
  } balance;

  Measured grain_contact_rate{unknown, unknown};  ///< 1/s, contacts with other grains per grain

  /// What each wall carries: the mean force on the grains against gravity. In a steady state both
  /// together carry the weight.
  struct BrakingForce {
    Measured left{unknown, unknown};  ///< N
    std::optional<Measured> right;    ///< N; none of a chute, which has its bottom only
    double weight = unknown;          ///< N, of all grains
  } braking_force;

  /// J; since the start, but kinetic, rotational and elastic energy are those at the end.
  struct Energy {
    double initial = 0.0, kinetic = 0.0, rotational = 0.0, elastic = 0.0, gravity_work = 0.0,
           wall_work = 0.0, normal_loss = 0.0, friction_loss = 0.0, residual = 0.0;
    /// What the residual is measured by, here as in the verdict.
    double turned_over() const { return energy_turned_over(initial, gravity_work, wall_work); }
  } energy;

  /// What grains do at a wall between coming and going.
  struct WallVisits {
    double visits = 0.0;  ///< how many the means are of
    Measured contacts;    ///< per visit
    Measured dv_y;        ///< m/s, axial velocity lost
    Measured dv_x;        ///< m/s, velocity gained away from the wall
    Measured entry_rate;  ///< m/s, normal velocity at the beginning of the first contact
    Measured entry_slip;  ///< m/s, its slip speed
    std::array<std::int64_t, VisitTally::longest> of_contacts{};  ///< since the start
  } wall_visits;

  struct Validity {
    ValidityVerdict verdict{};
    double v_crit = 0.0;  ///< m/s, above which a typical wall contact is cut short
    double t_col_grains = unknown, t_col_walls = unknown;  ///< s, of typical contacts
    double friction_failure_fraction = 0.0;  ///< of the friction loss at walls, by those cut short
    std::vector<std::string> warnings;       ///< that were given of limits
  } validity;
};

/// Means are not a number (null in the file) where no start counts.
struct CurvePoint {
  double v_x = 0.0, v_y = 0.0, dv_x = 0.0, dv_y = 0.0;  ///< m/s
  double contacts = 0.0;                                ///< number of those begun
  double contact_time = 0.0;                            ///< s, sum of their durations
  double max_overlap = 0.0;                             ///< m
  int passed = 0;                       ///< how many starts went through the wall; not in the means
  int stuck = 0;                        ///< how many were given up; not in the means
  double cut_short = 0.0;               ///< mean number of contacts cut short
  double brake_failure_fraction = 0.0;  ///< part of the braking that they did
  Validity verdict = Validity::valid;
  std::string cause = {};  ///< the finding that it follows from; empty for valid points
};

/// What the points of one v_x come to.
struct CurveLine {
  double v_x = 0.0;                                     ///< m/s
  double largest_dv_y = unknown, largest_at = unknown;  ///< m/s, of points where the brake works
  double brake_fails_at = unknown;   ///< m/s, v_y from which half of the braking fails
  double two_contacts_at = unknown;  ///< m/s, v_y from which an impact has two contacts in the mean
};

struct CurveSummary {
  RunSummary run;
  std::vector<CurvePoint> curve;
  std::vector<CurveLine> lines = {};  ///< not read back
};

/// One drop of a column of beads.
struct ColumnPoint {
  double gap_ratio = 0.0;                   ///< gap over velocity times t_col
  double gap = 0.0;                         ///< m
  double restitution = 0.0, rebound = 0.0;  ///< see engine/bead_column.hpp
  double detachment = 0.0;                  ///< see engine/validity.hpp
  double contacts = 0.0;                    ///< number of those begun
  double contact_time = 0.0;                ///< s, sum of their durations
  double max_overlap = 0.0;                 ///< m
  Validity verdict = Validity::valid;
};

struct ColumnSummary {
  RunSummary run;
  double t_col = 0.0;   ///< s, of a bead with the plate
  RigidColumn rigid{};  ///< the limit of hard beads
  std::vector<ColumnPoint> column;
};

/// The text of summary.json.
std::string to_json(const FlowSummary& summary);
std::string to_json(const CurveSummary& summary);
std::string to_json(const ColumnSummary& summary);

inline constexpr auto summary_name = "summary.json";
inline constexpr auto effective_settings_name = "effective.yaml";

}  // namespace riesel::io
