// riesel check: what a settings file means, before hours are spent on it.
#include "app/commands.hpp"
#include "app/cost.hpp"
#include "app/exit_status.hpp"
#include "app/plain_words.hpp"
#include "app/schedule.hpp"
#include "app/stepping.hpp"
#include "engine/closed_forms.hpp"
#include "engine/observables.hpp"
#include "engine/validity.hpp"
#include "io/trajectory_file.hpp"
#include "scenarios/contact_settings.hpp"
#include "scenarios/run_length.hpp"
#include "scenarios/scenario.hpp"

#include <fmt/core.h>
#include <sys/resource.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace riesel::app {

namespace {

template <class... Parts>
void line(const char* what, fmt::format_string<Parts...> format, Parts&&... parts) {
  fmt::print("  {:<22}{}\n", what, fmt::format(format, std::forward<Parts>(parts)...));
}

template <class... Parts>
void warn(fmt::format_string<Parts...> format, Parts&&... parts) {
  fmt::print("  warning: {}\n", fmt::format(format, std::forward<Parts>(parts)...));
}

/// t_col and e_N, the latter in closed form for the linear law only.
void print_contact(const char* what, const NormalLaw& normal, double reduced_mass, double speed) {
  const double t_col = collision_time(normal, reduced_mass, speed);
  if (const auto* linear = std::get_if<LinearLaw>(&normal)) {
    const LinearContact contact{linear->k_n, linear->gamma_n, reduced_mass};
    line(what, "t_col = {:.4g} s, e_N = {:.4f}", t_col, contact.restitution());
  } else {
    line(what, "t_col = {:.4g} s at {:.3g} m/s", t_col, speed);
  }
}

/// A head-on contact of the kind that a system has.
struct Pair {
  double reduced_mass;    // kg
  double speed;           // m/s, the fastest to be expected
  double smaller_radius;  // m
};

/// As the verdict on the run will measure it: over the radius of the smaller body.
double expected_overlap_ratio(const NormalLaw& normal, const Pair& pair) {
  return std::visit(
      [&](const auto& law) {
        return elastic_max_overlap(law.elastic_line(), pair.reduced_mass, pair.speed)
               / pair.smaller_radius;
      },
      normal);
}

void warn_of_overlap(double ratio, double speed) {
  line("expected overlap",
       "up to {:.2g} of the radius of the smaller body, in an impact of {:.3g} m/s", ratio, speed);
  if (ratio > suspect_overlap_ratio)
    warn("overlaps over {:.3g} of the radius make the run suspect; raise contact.stiffness by a "
         "factor {:.2g}",
         suspect_overlap_ratio, std::pow(ratio / suspect_overlap_ratio, 2.0));
}

/// The spring and the damping of the slip, between bodies of such a reduced mass (kg).
void print_slip(const io::Settings& settings, const SlipLaw& slip, double reduced_mass,
                double time_step) {
  const double inertia = scenarios::inertia(settings);
  if (const double time = spring_time(slip, inertia, reduced_mass); std::isfinite(time))
    line("tangential spring", "half a period = {:.4g} s", time);
  constexpr auto damping = "contact.slip_damping";
  const double gamma_t = settings.has(damping) ? settings.number(damping) : 0.0;
  const double stable = 2.0 / slip_gain_by_turning(inertia);
  if (gamma_t * time_step >= stable)
    warn("{} is too strong for the time step: friction would change its sign from step to step; "
         "raise run.steps_per_collision above {:.3g}",
         damping, settings.number("run.steps_per_collision") * gamma_t * time_step / stable);
}

void warn_of_time_step(const io::Settings& settings) {
  const double steps = settings.number("run.steps_per_collision");
  if (steps < 20.0)
    warn(
        "{:.3g} steps per collision are few: errors grow with the square of the step; 50 keep them "
        "at 1e-4",
        steps);
}

double memory_in_use() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) * 1024.0;
}

void print_critical_velocity(double chord_length, double t_col, double fastest) {
  const double v_crit = chord_length / t_col;
  line("v_crit",
       "{:.3g} m/s at a wall grain (chord {:.2g} m over t_col) with the random velocity of the "
       "start; lower in a cooler flow",
       v_crit, chord_length);
  if (fastest > v_crit)
    warn("velocities up to {:.3g} m/s are above v_crit: grains pass wall grains sooner than the "
         "contact "
         "can push them away (brake failure)",
         fastest);
}

void warn_of_open_walls(const State& state) {
  const WallLattice& wall = state.walls.front();
  const double gap = wall.spacing(state.box) - 2.0 * wall.radius;
  const double smallest =
      2.0 * *std::min_element(state.grains.radius.begin(), state.grains.radius.end());
  if (smallest < gap)
    warn("grains of {:.3g} m fit between the wall grains, {:.3g} m apart, and may leave the tube; "
         "choose wall.spacing below {:.3g} m",
         smallest, gap, smallest + 2.0 * wall.radius);
}

void print_trajectory(const io::Settings& settings, const State& state, double steps) {
  const std::int64_t steps_per_frame = Schedule(settings, state.time_step).steps_per_frame;
  if (steps_per_frame == 0) return;
  const double frames = std::floor(steps / static_cast<double>(steps_per_frame)) + 1.0;
  line("trajectory", "{:.0f} frames, {:.1f} MB", frames,
       frames * static_cast<double>(io::bytes_per_frame(state)) / 1e6);
}

/// One restitution is that of one mass.
void print_contacts_of_sizes(const NormalLaw& normal, const Grains& grains, double speed) {
  const auto [lightest, heaviest] = std::ranges::minmax(grains.mass);
  constexpr double alike = 1.5;
  if (heaviest < alike * lightest) return;
  print_contact("two lightest grains", normal, 0.5 * lightest, speed);
  print_contact("two heaviest grains", normal, 0.5 * heaviest, speed);
}

/// Seen by what lies on it, in units of gravity where there is some.
void print_shaking(const State& state) {
  const WallMotion& motion = state.walls.front().motion;
  if (!motion.oscillates()) return;
  const double omega = 2.0 * std::numbers::pi * motion.frequency;
  const double speed = motion.fastest_oscillation();
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

/// `random`: m/s, root mean square of the random velocities at the start, per component.
void print_contacts(const io::Settings& settings, const scenarios::Flow& flow, double random) {
  const State& state = flow.state;
  const NormalLaw& normal = flow.model.normal;
  const double mass = settings.number("grains.mass");
  const double radius = 0.5 * settings.number("grains.diameter");
  // Grains of a normal distribution are rarely faster than four standard deviations; the common
  // fall brings no two together.
  const double fastest = std::max(4.0 * random, 1e-3);
  const double both_fastest = std::numbers::sqrt2 * fastest;
  const double smaller = state.walls.front().smaller_radius(radius);
  const Pair grains{.reduced_mass = 0.5 * mass, .speed = both_fastest, .smaller_radius = radius};
  const double fastest_at_wall = fastest + state.walls.front().motion.fastest_oscillation();
  const Pair wall{.reduced_mass = mass, .speed = fastest_at_wall, .smaller_radius = smaller};
  print_contact("grain and grain", normal, grains.reduced_mass, grains.speed);
  print_contact("grain and wall", normal, wall.reduced_mass, wall.speed);
  print_contacts_of_sizes(normal, state.grains, both_fastest);
  line("time step", "{:.4g} s", state.time_step);
  warn_of_time_step(settings);
  print_slip(settings, flow.model.slip, 0.5 * mass, state.time_step);
  const double of_grains = expected_overlap_ratio(normal, grains);
  const double at_wall = expected_overlap_ratio(normal, wall);
  warn_of_overlap(std::max(of_grains, at_wall), of_grains > at_wall ? grains.speed : wall.speed);
}

void print_brake(const io::Settings& settings, const scenarios::Flow& flow, double random,
                 double mean_vy) {
  const WallLattice& wall = flow.state.walls.front();
  if (wall.smooth()) return;
  const double t_col =
      collision_time(flow.model.normal, settings.number("grains.mass"), std::max(random, 1e-3));
  const double reach = 0.5 * settings.number("grains.diameter") + wall.radius;
  print_critical_velocity(chord_of_impact(reach, random, t_col), t_col, std::abs(mean_vy));
}

void print_cost(const io::Settings& settings, const scenarios::Flow& flow) {
  constexpr double seconds_to_measure = 0.3;
  const auto n = static_cast<double>(flow.state.grains.size());
  const double steps = steps_of(settings, flow);
  const int threads = threads_for(settings, flow.state.grains.size());
  const double speed = measured_speed(settings, flow, threads, seconds_to_measure);
  const auto precision = scenarios::run_length(settings).relative_error;
  if (precision) line("ends", "when the mean is known to {:.3g} %", 100.0 * *precision);
  line("steps", "{}{:.0f}", precision ? "at most " : "", steps);
  line("expected time", "{}{} on {} thread{} ({:.0f} million particle-steps/s, measured just now)",
       precision ? "at most " : "", readable_time(n * steps / speed), threads,
       threads == 1 ? "" : "s", speed / 1e6);
  line("memory", "about {:.0f} MB", memory_in_use() / 1e6);
  print_trajectory(settings, flow.state, steps);
}

void check_flow(const io::Settings& settings, const scenarios::Flow& flow) {
  const Observables start = observe(flow.state);
  const double random = std::sqrt(start.granular_temperature);
  print_bodies(flow.state);
  print_contacts(settings, flow, random);
  print_brake(settings, flow, random, start.mean_vy);
  print_cost(settings, flow);
}

template <class Curve>
void print_cost(const io::Settings& settings, const Curve& curve, std::size_t sample) {
  const int threads = threads_for_curve(settings);
  const CurveCost cost = measured_cost(curve, threads, sample);
  line("steps", "about {:.2g}", cost.steps);
  line("expected time", "{} on {} thread{}", readable_time(cost.seconds), threads,
       threads == 1 ? "" : "s");
  line("memory", "about {:.0f} MB", memory_in_use() / 1e6);
}

void check_curve(const io::Settings& settings, const scenarios::ImpactCurve& curve) {
  const ImpactSetup& setup = curve.setup;
  double fastest_normal = 0.0, fastest = 0.0, slowest = 1e300, longest_step = 0.0,
         shortest_step = 1e300;
  for (const Impact& impact : curve.impacts) {
    fastest_normal = std::max(fastest_normal, impact.v_x);
    fastest = std::max(fastest, impact.v_y);
    slowest = std::min(slowest, impact.v_y);
    longest_step = std::max(longest_step, impact.time_step);
    shortest_step = std::min(shortest_step, impact.time_step);
  }
  line("impacts", "{} in {} points, v_y = {:.3g} ... {:.3g} m/s", curve.impacts.size(),
       curve.points.size(), slowest, fastest);
  const double speed = std::max(fastest_normal, slowest);
  print_contact("grain and wall", setup.model.normal, setup.grain_mass, speed);
  line("time step", "{:.4g} s, down to {:.3g} s where passages are short", longest_step,
       shortest_step);
  warn_of_time_step(settings);
  print_slip(settings, setup.model.slip, setup.grain_mass, longest_step);
  const double smaller = std::min(setup.grain_radius, setup.reach() - setup.grain_radius);
  if (fastest_normal > 0.0)
    warn_of_overlap(
        expected_overlap_ratio(setup.model.normal, {setup.grain_mass, fastest_normal, smaller}),
        fastest_normal);
  const double path = setup.single_wall_grain()
                          ? chord(setup.reach(), curve.impacts.front().x)
                          : chord_of_impact(setup.reach(), fastest_normal, setup.collision_time);
  line("v_crit", "{:.3g} m/s: above it a grain passes a wall grain sooner than t_col",
       path / setup.collision_time);
  print_cost(settings, curve, 50);
}

void check_column(const io::Settings& settings, const scenarios::ColumnCurve& curve) {
  const ColumnSetup& setup = curve.setup;
  const auto [smallest, widest] = std::ranges::minmax(curve.gap_ratios);
  line("drops", "{} of {} beads, gaps of {:.3g} ... {:.3g} m", curve.gap_ratios.size(), setup.beads,
       curve.gap(smallest), curve.gap(widest));
  const Pair at_plate{setup.bead_mass, setup.velocity, setup.bead_radius};
  print_contact("bead and bead", setup.model.normal, 0.5 * setup.bead_mass, setup.velocity);
  print_contact("bead and plate", setup.model.normal, at_plate.reduced_mass, at_plate.speed);
  line("time step", "{:.4g} s", setup.time_step);
  warn_of_time_step(settings);
  warn_of_overlap(expected_overlap_ratio(setup.model.normal, at_plate), at_plate.speed);
  line("hard beads", "{}", description_of(curve.rigid));
  if (smallest < 1.0)
    warn("t_col is longer than the time between two impacts at the plate, down to {:.2g} of it: "
         "beads touch several others at once, and keep more energy than hard ones",
         smallest);
  print_cost(settings, curve, 5);
}

}  // namespace

int check(const CheckOptions& options) {
  const auto settings =
      io::Settings::from_file(options.file, scenarios::settings_tables(), options.overrides);
  const scenarios::Problem problem = scenarios::named(settings.scenario()).prepare(settings);
  fmt::print("{}: {}\n", options.file.string(), settings.scenario());
  if (const auto* flow = std::get_if<scenarios::Flow>(&problem))
    check_flow(settings, *flow);
  else if (const auto* column = std::get_if<scenarios::ColumnCurve>(&problem))
    check_column(settings, *column);
  else
    check_curve(settings, std::get<scenarios::ImpactCurve>(problem));
  return exit_done;
}

}  // namespace riesel::app
