// What `riesel check` prints about problems of every kind: lines and warnings, contacts, the time
// step and the cost.
#pragma once

#include "app/cost.hpp"
#include "engine/contact_law.hpp"
#include "io/settings.hpp"

#include <fmt/core.h>

#include <utility>

namespace riesel::app {

template <class... Parts>
void line(const char* what, fmt::format_string<Parts...> format, Parts&&... parts) {
  fmt::print("  {:<22}{}\n", what, fmt::format(format, std::forward<Parts>(parts)...));
}

template <class... Parts>
void warn(fmt::format_string<Parts...> format, Parts&&... parts) {
  fmt::print("  warning: {}\n", fmt::format(format, std::forward<Parts>(parts)...));
}

/// Prints t_col and e_N: for linear laws in closed form, for other laws at `speed` (m/s), and
/// e_N also at a tenth of it. `reduced_mass`: kg.
void print_contact(const char* what, const ContactModel& model, double reduced_mass, double speed);

/// The most violent head-on contact to be expected between two kinds of bodies.
struct HeadOnContact {
  double reduced_mass;     ///< kg
  double speed;            ///< m/s
  double smallest_radius;  ///< m, of all bodies of the smaller kind
};

/// The largest overlap over the smallest radius, as the verdict on the run measures it; without
/// damping.
double expected_overlap_ratio(const NormalLaw& normal, const HeadOnContact& contact);

/// Prints that ratio, and warns if it is too large, with the factor by which the stiffness is too
/// small.
void warn_of_overlap(const NormalLaw& normal, const HeadOnContact& contact);

/// Prints half a period of the tangential spring between bodies of this reduced mass (kg), and
/// warns if the tangential damping is too strong for `time_step` (s).
void print_slip(const io::Settings& settings, const SlipLaw& slip, double reduced_mass,
                double time_step);

void warn_of_time_step(const io::Settings& settings);

/// Warns if contacts of bodies with this reduced mass (kg), at `speed` (m/s), last few time steps
/// (s) though run.steps_per_collision is not small: contact.impact_speed was too slow a guess.
void warn_of_impact_speed(const ContactModel& model, double reduced_mass, double speed,
                          double time_step);

void print_cost_of_curve(const CurveCost& cost, int threads);

/// Prints the peak memory of this process so far plus `more` bytes.
void print_memory(double more);

}  // namespace riesel::app
