#include "app/check_column.hpp"

#include "app/check_parts.hpp"
#include "app/cost.hpp"
#include "app/plain_words.hpp"
#include "app/stepping.hpp"

#include <algorithm>

namespace riesel::app {

void check_column(const io::Settings& settings, const scenarios::ColumnCurve& curve) {
  const ColumnSetup& setup = curve.setup;
  const auto [smallest, widest] = std::ranges::minmax(curve.gap_ratios);
  line("drops", "{} of {} beads, gaps of {:.3g} ... {:.3g} m", curve.gap_ratios.size(), setup.beads,
       curve.gap(smallest), curve.gap(widest));
  const HeadOnContact at_plate{setup.bead_mass, setup.velocity, setup.bead_radius};
  print_contact("bead and bead", setup.model, 0.5 * setup.bead_mass, setup.velocity);
  print_contact("bead and plate", setup.model, at_plate.reduced_mass, at_plate.speed);
  line("time step", "{:.4g} s", setup.time_step);
  warn_of_time_step(settings);
  warn_of_overlap(setup.model.normal, at_plate);
  line("hard beads", "{}", description_of(curve.rigid));
  if (smallest < 1.0)
    warn("t_col is longer than the time between two impacts at the plate, down to {:.2g} of it: "
         "beads touch several others at once, and keep more energy than hard ones",
         smallest);
  const int threads = threads_for_curve(settings);
  print_cost_of_curve(measured_cost(curve, threads, 5), threads);
}

}  // namespace riesel::app
