#include "app/check_parts.hpp"

#include "app/plain_words.hpp"
#include "engine/closed_forms.hpp"
#include "engine/impact.hpp"
#include "engine/validity.hpp"
#include "scenarios/contact_settings.hpp"

#include <sys/resource.h>

#include <cmath>

namespace riesel::app {

namespace {

constexpr double few_steps = 20.0;  // per collision

/// For a law whose restitution depends on the speed.
void print_contact_at_speeds(const char* what, const ContactModel& model, double reduced_mass,
                             double speed) {
  const double t_col = collision_time(model.normal, reduced_mass, speed, model.attraction);
  const double slower = 0.1 * speed;
  const auto fast = restitution(model, reduced_mass, speed);
  const auto slow = restitution(model, reduced_mass, slower);
  if (fast && slow) {
    line(what, "t_col = {:.4g} s at {:.3g} m/s, e_N = {:.4f}; {:.4f} at a tenth of that speed",
         t_col, speed, *fast, *slow);
    return;
  }
  line(what, "t_col = {:.4g} s at {:.3g} m/s without damping", t_col, speed);
  warn("{}: too much damping, no rebound at {:.3g} m/s; choose less", what, fast ? slower : speed);
}

}  // namespace

void print_contact(const char* what, const ContactModel& model, double reduced_mass, double speed) {
  const auto linear = linear_contact(model.normal, reduced_mass, model.attraction);
  if (!linear) return print_contact_at_speeds(what, model, reduced_mass, speed);
  line(what, "t_col = {:.4g} s, e_N = {:.4f}", linear->collision_time(), linear->restitution());
}

double expected_overlap_ratio(const NormalLaw& normal, const HeadOnContact& contact) {
  return elastic_max_overlap(elastic_line(normal), contact.reduced_mass, contact.speed)
         / contact.smallest_radius;
}

void warn_of_overlap(const NormalLaw& normal, const HeadOnContact& contact) {
  const double ratio = expected_overlap_ratio(normal, contact);
  line("expected overlap",
       "up to {:.2g} of the radius of the smallest body, in an impact of {:.3g} m/s", ratio,
       contact.speed);
  if (ratio <= suspect_overlap_ratio) return;
  // The largest overlap is proportional to k^(-1/(alpha + 1)): elastic_max_overlap().
  const double power = elastic_line(normal).exponent + 1.0;
  constexpr double enough = 1.05;  // after rounding
  warn("overlaps over {:.3g} of the radius make the run suspect; raise contact.stiffness by a "
       "factor {:.2g}",
       suspect_overlap_ratio, enough * std::pow(ratio / suspect_overlap_ratio, power));
}

void print_slip(const io::Settings& settings, const SlipLaw& slip, double reduced_mass,
                double time_step) {
  const double inertia = scenarios::inertia(settings);
  if (const double time = spring_time(slip, inertia, reduced_mass); std::isfinite(time))
    line("tangential spring", "half a period = {:.4g} s", time);
  constexpr auto damping = "contact.slip_damping";
  const double gamma_t = settings.has(damping) ? settings.number(damping) : 0.0;
  // As the slip is predicted from the last step, its error is then reversed in each step.
  const double stable = 1.0 / slip_gain_by_turning(inertia);
  if (gamma_t * time_step >= stable)
    warn("{} is too strong for the time step: friction would change its sign from step to step; "
         "raise run.steps_per_collision above {:.3g}",
         damping, settings.number("run.steps_per_collision") * gamma_t * time_step / stable);
}

void warn_of_time_step(const io::Settings& settings) {
  const double steps = settings.number("run.steps_per_collision");
  if (steps < few_steps)
    warn(
        "{:.3g} steps per collision are few: errors grow with the square of the step; 50 keep them "
        "below 1e-3",
        steps);
}

void warn_of_impact_speed(const ContactModel& model, double reduced_mass, double speed,
                          double time_step) {
  if (linear_contact(model.normal, reduced_mass, model.attraction)) return;  // same at any speed
  const double steps =
      collision_time(model.normal, reduced_mass, speed, model.attraction) / time_step;
  if (steps < few_steps)
    warn("at {:.3g} m/s the shortest contacts last only {:.2g} steps: raise contact.impact_speed, "
         "from which the time step follows, to that speed",
         speed, steps);
}

void print_cost_of_curve(const CurveCost& cost, int threads) {
  line("steps", "about {:.2g}", cost.steps);
  line("expected time", "{} on {}", readable_time(cost.seconds), so_many(threads, "thread"));
  print_memory(0.0);
}

void print_memory(double more) {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  line("memory", "about {:.0f} MB", (static_cast<double>(usage.ru_maxrss) * 1024.0 + more) / 1e6);
}

}  // namespace riesel::app
