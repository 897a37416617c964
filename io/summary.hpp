// summary.json: the result of a run in one small file, for people and scripts. SI units.
//
// The names of its members are a contract, described in docs/files.md.
#pragma once

#include "engine/density_waves.hpp"
#include "engine/estimate.hpp"
#include "engine/observables.hpp"
#include "engine/rigid_column.hpp"
#include "engine/steady_state.hpp"
#include "engine/validity.hpp"
#include "engine/wall_visits.hpp"

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace riesel::io {

/// Version of the contents of the file: raised when a name that a reader needs changes its meaning,
/// is removed, or is added. Version 1 had no number; names were added to version 2 until riesel
/// 0.5.0.
inline constexpr int summary_format = 2;

/// What every summary contains.
struct RunSummary {
  std::string scenario;
  std::int64_t grains = 0;
  std::int64_t steps = 0;
  std::uint64_t state_hash = 0;  ///< written as 16 hexadecimal digits
  double wall_seconds = 0.0;
  double particle_steps_per_second = 0.0;
  int threads = 1;
};

/// A mean with its error. NaN is null in the file.
using Measured = Estimate;

/// Why a run ended.
enum class EndedBy {
  duration,   ///< its duration was over
  precision,  ///< its mean has the precision that was asked for
  at_most     ///< it has not, but the time was up
};

/// The series by which a flow is judged steady.
enum class JudgedBy { mean_vy, granular_temperature, rotational_temperature };

/// The word that stands in the file, for JudgedBy also the name of the series.
std::string_view name(EndedBy ended_by);
std::string_view name(JudgedBy judged_by);

/// The inverse of name(); nothing for any other text.
std::optional<EndedBy> ended_by_named(std::string_view text);
std::optional<JudgedBy> judged_by_named(std::string_view text);

/// Means are over the samples after the transient.
struct FlowSummary {
  RunSummary run;
  double time = 0.0;           ///< s, simulated
  double transient_end = 0.0;  ///< s
  EndedBy ended_by = EndedBy::duration;
  SteadyVerdict state = SteadyVerdict::too_short;
  JudgedBy judged_by = JudgedBy::mean_vy;
  std::optional<JudgedBy> held_back_by;  ///< another series, if the judged one is steady
  Measured mean_axial_velocity;          ///< m/s; while a flow accelerates its error is unknown
  Measured mass_flow_rate{unknown, unknown};  ///< kg/s, through a section of the tube; likewise
  double independent_samples = 0.0;   ///< of the series that holds back, else of the judged one
  double granular_temperature = 0.0;  ///< (m/s)^2

  /// The scatter of the grains' velocities over the whole tube at one moment.
  struct Fluctuations {
    Measured sigma_vx, sigma_vy;    ///< m/s
    Measured granular_temperature;  ///< (m/s)^2
  } fluctuations;

  std::array<Measured, density_waves> structure_factor{};  ///< along the tube, n = 1, 2, ...

  /// A part of the tube's width, see engine/tube_profiles.hpp.
  struct Zone {
    Measured area_fraction;
    Measured mean_axial_velocity;                       ///< m/s
    Measured temperature_x, temperature_y;              ///< (m/s)^2
    Measured stress_xx, stress_yy;                      ///< N/m
    Measured stress_xy{unknown, unknown};               ///< N/m
    Measured shear_rate{unknown, unknown};              ///< 1/s
    Measured mean_spin{unknown, unknown};               ///< rad/s
    Measured rotational_temperature{unknown, unknown};  ///< (m/s)^2
  } core, wall_layers;

  /// Eq. (9) of the paper: in a steady state n_dot dv_y = gravity.
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
    std::optional<Measured> right;    ///< N; none for a chute, which has only its bottom
    double weight = unknown;          ///< N, of all grains
  } braking_force;

  /// With which the grains press each wall outwards, per length of the wall.
  struct WallPressure {
    Measured left{unknown, unknown};  ///< N/m
    std::optional<Measured> right;    ///< N/m; none for a chute
  } wall_pressure;

  /// J; totals since the start, except that kinetic, rotational and elastic energy are those at the
  /// end.
  struct Energy {
    double initial = 0.0, kinetic = 0.0, rotational = 0.0, elastic = 0.0, gravity_work = 0.0,
           wall_work = 0.0, normal_loss = 0.0, friction_loss = 0.0, residual = 0.0;
    /// What the residual is compared with, here as in the verdict.
    double turned_over() const { return energy_turned_over(initial, gravity_work, wall_work); }
  } energy;

  /// What happens to grains between their arrival at a wall and their departure.
  struct WallVisits {
    double visits = 0.0;  ///< how many of them the means are over
    Measured contacts;    ///< per visit
    Measured dv_y;        ///< m/s, axial velocity lost
    Measured dv_x;        ///< m/s, velocity gained away from the wall
    Measured entry_rate;  ///< m/s, normal velocity at the beginning of the first contact
    Measured entry_slip;  ///< m/s, slip speed at that moment
    /// Numbers of visits since the start, see VisitTally::of_contacts.
    std::array<std::int64_t, VisitTally::longest> of_contacts{};
  } wall_visits;

  struct Validity {
    ValidityVerdict verdict{};
    double v_crit = 0.0;  ///< m/s, above which a typical wall contact is cut short
    double t_col_grains = unknown, t_col_walls = unknown;  ///< s, of typical contacts
    /// Part of the friction loss at walls that is due to contacts cut short.
    double friction_failure_fraction = 0.0;
    std::vector<std::string> warnings;  ///< about exceeded limits, one line each
  } validity;
};

/// Means are over the starts that count; NaN (null in the file) if none does.
struct CurvePoint {
  double v_x = 0.0, v_y = 0.0, dv_x = 0.0, dv_y = 0.0;  ///< m/s
  double contacts = 0.0;                                ///< number of contacts begun
  double contact_time = 0.0;                            ///< s, sum of their durations
  double max_overlap = 0.0;                             ///< m, of all these starts, not a mean
  int passed = 0;                       ///< how many starts went through the wall; not in the means
  int stuck = 0;                        ///< how many starts were given up; not in the means
  double cut_short = 0.0;               ///< mean number of contacts cut short
  double brake_failure_fraction = 0.0;  ///< part of the braking that was due to these
  Validity verdict = Validity::valid;
  std::string cause = {};  ///< the finding that decided the verdict; empty for valid points
};

/// Where a curve rises through a level, interpolated between two points: for a single start it may
/// rise at once, and all that is known is between which points.
struct Rise {
  double at = unknown;      ///< m/s, v_y
  double within = unknown;  ///< m/s, how far apart the two points are
};

/// What follows from the points with the same v_x.
struct CurveLine {
  double v_x = 0.0;                                     ///< m/s
  double largest_dv_y = unknown, largest_at = unknown;  ///< m/s, of points where the brake works
  /// From where on half of the braking fails, and from where on an impact has two contacts on
  /// average.
  Rise brake_fails = {}, two_contacts = {};
};

struct CurveSummary {
  RunSummary run;
  std::vector<CurvePoint> curve;
  std::vector<CurveLine> lines = {};  ///< not read back
};

/// One drop of a column of beads.
struct ColumnPoint {
  double gap_ratio = 0.0;                   ///< gap / (velocity * t_col)
  double gap = 0.0;                         ///< m
  double restitution = 0.0, rebound = 0.0;  ///< see engine/bead_column.hpp
  double detachment = 0.0;                  ///< see engine/validity.hpp
  double contacts = 0.0;                    ///< number of contacts begun
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
