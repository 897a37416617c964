#include "app/check_impacts.hpp"

#include "app/check_parts.hpp"
#include "app/cost.hpp"
#include "app/stepping.hpp"
#include "engine/closed_forms.hpp"

#include <algorithm>
#include <limits>

namespace riesel::app {

void check_impacts(const io::Settings& settings, const scenarios::ImpactCurve& curve) {
  const ImpactSetup& setup = curve.setup;
  constexpr double none = std::numeric_limits<double>::infinity();
  double fastest_normal = 0.0, fastest = 0.0, slowest = none;
  double longest_step = 0.0, shortest_step = none;
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
  print_contact("grain and wall", setup.model, setup.grain_mass, speed);
  line("time step", "{:.4g} s, down to {:.3g} s where passages are short", longest_step,
       shortest_step);
  warn_of_time_step(settings);
  print_slip(settings, setup.model.slip, setup.grain_mass, longest_step);
  const double smaller = std::min(setup.grain_radius, setup.wall_grain_radius);
  if (fastest_normal > 0.0)
    warn_of_overlap(setup.model.normal, {setup.grain_mass, fastest_normal, smaller});
  const double path = setup.single_wall_grain()
                          ? chord(setup.reach(), curve.impacts.front().x)
                          : chord_of_impact(setup.reach(), fastest_normal, setup.collision_time);
  line("v_crit", "{:.3g} m/s: above it a grain passes a wall grain sooner than t_col",
       critical_velocity(path, setup.collision_time));
  const int threads = threads_for_curve(settings);
  print_cost_of_curve(measured_cost(curve, threads, 50), threads);
}

}  // namespace riesel::app
