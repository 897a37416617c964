#include "app/check_flow.hpp"

#include "app/check_parts.hpp"
#include "app/cost.hpp"
#include "app/flow_failures.hpp"
#include "app/plain_words.hpp"
#include "app/schedule.hpp"
#include "app/series.hpp"
#include "app/stepping.hpp"
#include "engine/observables.hpp"
#include "engine/typical_contacts.hpp"
#include "io/trajectory_file.hpp"
#include "scenarios/run_length.hpp"
#include "scenarios/run_limits.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>

namespace riesel::app {

namespace {

void print_critical_velocity(const TypicalContacts& typical, double fastest) {
  line("v_crit",
       "{:.3g} m/s at a wall grain (chord {:.2g} m over t_col) for the transverse velocities at "
       "the start; lower in a cooler flow",
       typical.v_crit, typical.chord);
  if (fastest > typical.v_crit)
    warn("velocities up to {:.3g} m/s are above v_crit: grains pass wall grains sooner than the "
         "contact can push them away (brake failure)",
         fastest);
}

void warn_of_open_walls(const State& state) {
  const double smallest = 2.0 * std::ranges::min(state.grains.radius);
  if (const auto way = way_through_a_wall(state, smallest)) warn("{}", *way);
}

/// Bytes in run.h5.
double bytes_of_series(double rows) {
  return rows * static_cast<double>(series_columns().size() * sizeof(double));
}

/// Number of frames, and bytes of a trajectory and of its index. The index is made anew in memory
/// with each save.
struct TrajectorySize {
  double frames = 0.0, file = 0.0, index = 0.0;
};

TrajectorySize size_of_trajectory(const State& state, std::int64_t steps_per_frame, double steps) {
  if (steps_per_frame == 0) return {};
  const io::FrameSize frame = io::size_of_frame(state);
  const double frames = std::floor(steps / static_cast<double>(steps_per_frame)) + 1.0;
  return {.frames = frames,
          .file = frames * static_cast<double>(frame.file),
          .index = frames * static_cast<double>(frame.index)};
}

/// Memory, in bytes, that a save takes in addition to stepping: a copy of the state, run.h5 and the
/// checkpoint as they are written, and what grows: the series and the index of the trajectory.
/// Measured: 140 to 390 bytes per grain, least where there are many grains; 1.3 times the series.
double bytes_to_save(std::size_t grains, double rows, const TrajectorySize& trajectory) {
  constexpr double per_grain = 200.0, per_byte_of_series = 1.3;
  return per_grain * static_cast<double>(grains) + per_byte_of_series * bytes_of_series(rows)
         + trajectory.index;
}

/// Prints the size of the series if it is large, and warns if there are too few or too many rows.
/// `duration`: s, simulated.
void print_series(double rows, double duration) {
  constexpr double hardly_any = 3, few = 1e5, many = 1e6;
  if (rows < hardly_any)
    warn("{} in the series, which is too little for a mean: choose output.interval shorter, or run "
         "longer",
         so_many(static_cast<std::int64_t>(rows), "row"));
  if (rows < few) return;
  line("series", "{:.3g} rows, {:.1f} MB", rows, bytes_of_series(rows) / 1e6);
  if (rows > many)
    warn("each save writes all rows, and the summary reads them: choose output.interval longer, "
         "{:.2g} s for {:.0g} rows",
         duration / few, few);
}

void print_trajectory(const TrajectorySize& size) {
  if (size.frames == 0.0) return;
  constexpr double large_index = 100e6;
  line("trajectory", "{:.0f} frames, {:.1f} MB, and {:.1f} MB in {}", size.frames, size.file / 1e6,
       size.index / 1e6, io::trajectory_index_name);
  if (size.index > large_index)
    warn("each save writes all of {}: choose output.trajectory_interval longer, or several runs",
         io::trajectory_index_name);
}

/// Contacts of heavier grains last longer, and under most laws lose another part of the energy.
/// Prints nothing if all grains are about equally heavy.
void print_contacts_of_sizes(const ContactModel& model, const Grains& grains, double speed) {
  const auto [lightest, heaviest] = std::ranges::minmax(grains.mass);
  constexpr double alike = 1.5;
  if (heaviest < alike * lightest) return;
  print_contact("two lightest grains", model, 0.5 * lightest, speed);
  print_contact("two heaviest grains", model, 0.5 * heaviest, speed);
}

/// The motion of walls that shake, as a grain lying on them would feel it.
void print_shaking(const State& state) {
  const WallMotion& motion = state.walls.front().motion;
  if (!motion.oscillates()) return;
  const double omega = 2.0 * std::numbers::pi * motion.frequency;
  const double speed = motion.fastest_oscillation();
  if (speed == 0.0) return;  // it has been stopped, but away from its place
  const double gravity = std::hypot(state.gravity.x, state.gravity.y);
  line("walls shake", "up to {:.3g} m/s and {:.3g} m/s^2{}, {:.0f} steps per period", speed,
       omega * speed, gravity > 0.0 ? fmt::format(" ({:.3g} g)", omega * speed / gravity) : "",
       1.0 / (motion.frequency * state.time_step));
}

void print_bodies(const State& state) {
  double area = 0.0;
  for (const double radius : state.grains.radius) area += std::numbers::pi * radius * radius;
  line("grains", "{}, area fraction {:.4f}", state.grains.size(),
       area / (state.box.width * state.box.length));
  const WallLattice& wall = state.walls.front();
  print_shaking(state);
  if (wall.smooth()) {
    line("walls", "smooth");
    return;
  }
  line("wall grains", "{} per wall, spacing {:.6g} m", wall.count, wall.spacing(state.box));
  warn_of_open_walls(state);
}

/// Warns if grains that start upwards could, without collisions, rise so high that they are lost.
void warn_of_low_chute(const State& state) {
  if (state.walls.size() > 1 || state.gravity.x >= 0.0) return;
  const GrainView grains(state);
  double highest = 0.0;
  for (std::size_t slot = 0; slot < state.grains.size(); ++slot) {
    const Grain g = grains[slot];
    const double up = std::max(g.vx, 0.0);
    highest = std::max(highest, g.x - up * up / (2.0 * state.gravity.x));
  }
  const double lost = 2.0 * state.box.width;
  if (highest > lost)
    warn("grains start upwards so fast that they may rise to {:.2g} m; the run ends where one is "
         "higher than {:.2g} m, twice chute.height: choose that larger, or a slower start",
         highest, lost);
}

/// For grains of mean mass, as in the summary of a run; overlaps over the radius of the smallest,
/// as in its verdict. `random`: m/s, root mean square of the random velocities at the start, per
/// component; `mean_vx`: m/s, which all grains share, so that it counts in collisions with walls
/// only.
void print_contacts(const io::Settings& settings, const scenarios::Flow& flow, double random,
                    double mean_vx) {
  const State& state = flow.state;
  const double mass = mean_mass(state.grains);
  const double smallest = std::ranges::min(state.grains.radius);
  // In a normal distribution grains are rarely faster than four standard deviations.
  const double fastest = std::max(4.0 * random, 1e-3);
  const double both_fastest = std::numbers::sqrt2 * fastest;
  const HeadOnContact grains{
      .reduced_mass = 0.5 * mass, .speed = both_fastest, .smallest_radius = smallest};
  const double fastest_at_wall =
      fastest + std::abs(mean_vx) + state.walls.front().motion.fastest_oscillation();
  const HeadOnContact wall{.reduced_mass = mass,
                           .speed = fastest_at_wall,
                           .smallest_radius = state.walls.front().smaller_radius(smallest)};
  print_contact("grain and grain", flow.model, grains.reduced_mass, grains.speed);
  print_contact("grain and wall", flow.model, wall.reduced_mass, wall.speed);
  print_contacts_of_sizes(flow.model, state.grains, both_fastest);
  line("time step", "{:.4g} s", state.time_step);
  warn_of_time_step(settings);
  warn_of_impact_speed(flow.model, 0.5 * std::ranges::min(state.grains.mass), both_fastest,
                       state.time_step);
  print_slip(settings, flow.model.slip, 0.5 * mass, state.time_step);
  const auto ratio = [&](const HeadOnContact& c) {
    return expected_overlap_ratio(flow.model.normal, c);
  };
  warn_of_overlap(flow.model.normal, ratio(grains) > ratio(wall) ? grains : wall);
}

/// `across`: m/s, the typical velocity towards a wall. If grains start at rest in that direction,
/// how fast they will be is not known, and there is no v_crit to print.
void print_brake(const scenarios::Flow& flow, double across, double mean_vy) {
  if (flow.state.walls.front().smooth()) return;
  if (across < slowest_across) {
    constexpr double about_at_rest = 0.01;  // m/s
    if (std::abs(mean_vy) > about_at_rest)
      warn("all grains start with the same velocity and almost none towards the walls, so that any "
           "axial velocity exceeds v_crit (brake failure): set start.random_velocity");
    return;
  }
  print_critical_velocity(typical_contacts(flow.state, flow.model, across), std::abs(mean_vy));
}

/// Warns of limits that the run would exceed from its beginning.
void warn_of_limits(const io::Settings& settings, const State& state) {
  const scenarios::RunLimits limits = scenarios::run_limits(settings);
  if (const double speed = fastest_grain(state).speed; limits.speed && speed > *limits.speed)
    warn("limits.speed is exceeded from the start on, by grains of {:.3g} m/s", speed);
  const double steps = settings.number("run.steps_per_collision");
  if (limits.steps_per_contact && *limits.steps_per_contact > steps)
    warn("limits.steps_per_contact is above run.steps_per_collision, the {:.3g} steps of the "
         "shortest contact of two",
         steps);
}

void print_cost(const io::Settings& settings, const scenarios::Flow& flow) {
  constexpr double seconds_to_measure = 0.3;
  const std::size_t grains = flow.state.grains.size();
  const Schedule schedule(settings, flow.state.time_step);
  const auto steps = static_cast<double>(schedule.last_step);
  const double rows = std::floor(steps / static_cast<double>(schedule.steps_per_row)) + 1.0;
  const int threads = threads_for(settings, grains);
  const double speed = measured_speed(settings, flow, threads, seconds_to_measure);
  const auto precision = scenarios::run_length(settings).relative_error;
  if (precision) line("ends", "when the mean is known to {:.3g} %", 100.0 * *precision);
  line("steps", "{}{:.0f}", precision ? "at most " : "", steps);
  const double seconds = static_cast<double>(grains) * steps / speed + rows * seconds_per_row(flow);
  line("expected time", "{}{} on {} ({:.0f} million particle-steps/s, measured just now)",
       precision ? "at most " : "", readable_time(seconds), so_many(threads, "thread"),
       speed / 1e6);
  const TrajectorySize trajectory = size_of_trajectory(flow.state, schedule.steps_per_frame, steps);
  print_memory(bytes_to_save(grains, rows, trajectory));
  print_series(rows, steps * flow.state.time_step);
  print_trajectory(trajectory);
}

}  // namespace

void check_flow(const io::Settings& settings, const scenarios::Flow& flow) {
  const Observables start = observe(flow.state);
  const double random = start.sigma_vx;  // along the walls there may be a profile
  print_bodies(flow.state);
  print_contacts(settings, flow, random, start.mean_vx);
  print_brake(flow, std::hypot(random, start.mean_vx), start.mean_vy);
  warn_of_low_chute(flow.state);
  warn_of_limits(settings, flow.state);
  print_cost(settings, flow);
}

}  // namespace riesel::app
