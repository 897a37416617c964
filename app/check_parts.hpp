// What `riesel check` tells of every kind of problem: lines and warnings, contacts, the time step
// and the cost.
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

/// t_col and e_N: of the linear law in closed form, of others at `speed` (m/s) and at a tenth of
/// it.
void print_contact(const char* what, const ContactModel& model, double reduced_mass, double speed);

/// A head-on contact of the kind that a system has.
struct HeadOnContact {
  double reduced_mass;    ///< kg
  double speed;           ///< m/s, the fastest to be expected
  double smaller_radius;  ///< m
};

/// As the verdict on the run will measure it: over the radius of the smaller body.
double expected_overlap_ratio(const NormalLaw& normal, const HeadOnContact& contact);

/// The largest such ratio, and the speed of the impact with it; a warning only if it is too large.
void warn_of_overlap(double ratio, double speed);

/// The spring and the damping of the slip, between bodies of such a reduced mass (kg).
void print_slip(const io::Settings& settings, const SlipLaw& slip, double reduced_mass,
                double time_step);

void warn_of_time_step(const io::Settings& settings);

void print_cost_of_curve(const CurveCost& cost, int threads);

/// The most that this process has used so far, and so many bytes more.
void print_memory(double more);

}  // namespace riesel::app
