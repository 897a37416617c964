#include "app/wall_forces.hpp"

#include "engine/time_series.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

namespace riesel::app {

namespace {

/// The impulses of each wall on the grains.
struct Names {
  std::string left, right;
};

Names names_of(Axis axis) {
  return axis == Axis::across ? Names{"left_wall_impulse_x", "right_wall_impulse_x"}
                              : Names{"left_wall_impulse_y", "right_wall_impulse_y"};
}

/// N. Walls take the momentum that gravity gives, except for the difference between the grains'
/// momentum at the end and at the beginning. So the error of their mean force is the scatter of
/// that difference over the time between. This is less than the increments by themselves suggest,
/// as much of what is taken in one is missing in the next.
double error_by_balance(const State& state, const std::vector<double>& velocities,
                        double interval) {
  if (velocities.size() < 2) return unknown;
  // The scatter about the true mean: that of a short series is off by its error.
  const double deviation =
      std::hypot(standard_deviation(velocities), mean_with_error(velocities).error);
  const double of_difference = std::numbers::sqrt2 * deviation * total_mass(state.grains);
  return of_difference / (interval * static_cast<double>(velocities.size() - 1));
}

/// Errors of the forces of both walls, N: by their increments, of their sum as the balance has it,
/// and of their difference.
struct Errors {
  double sum, balanced_sum, difference;

  /// Of one of them; `own` and that of the `other` are by their increments. Its force is half of
  /// the sum plus or minus the difference, which are correlated where one wall has more of both; it
  /// is also what the other one leaves of the sum.
  double of_one(double own, double other) const {
    const double covariance = (own * own - other * other) * (balanced_sum / sum);
    const double squares = balanced_sum * balanced_sum + difference * difference;
    const double of_half = 0.5 * std::sqrt(std::max(0.0, squares + 2.0 * covariance));
    // What is not known is not less than anything.
    return std::min({own, balanced_sum + other, of_half});
  }
};

}  // namespace

std::vector<double> velocities_by_mass(const io::RunFile& file, const State& state,
                                       std::size_t first, Axis axis) {
  const Names names = names_of(axis);
  const std::vector<double> time = file.series("time");
  const std::vector<double> left = file.series(names.left), right = file.series(names.right);
  const double mass = total_mass(state.grains);
  const double before = axis == Axis::along ? state.origin.momentum_y : 0.0;
  const double gravity = axis == Axis::along ? state.gravity.y : state.gravity.x;
  std::vector<double> velocities;
  for (std::size_t row = first; row < time.size(); ++row)
    velocities.push_back((before + left[row] + right[row]) / mass + gravity * time[row]);
  return velocities;
}

WallForces wall_forces(const CumulativeSeries& series, const State& state, Axis axis,
                       const std::vector<double>& velocities, double interval) {
  const Names names = names_of(axis);
  const io::Measured left = series.rate(names.left), right = series.rate(names.right);
  const double of_sum = series.error_of_sum(names.left, names.right, 1.0);
  const Errors errors{.sum = of_sum,
                      .balanced_sum =
                          std::min(of_sum, error_by_balance(state, velocities, interval)),
                      .difference = series.error_of_sum(names.left, names.right, -1.0)};
  WallForces forces{.both = {.value = left.value + right.value, .error = errors.balanced_sum},
                    .left = {.value = left.value, .error = errors.of_one(left.error, right.error)},
                    .right = {}};
  if (state.walls.size() > 1)
    forces.right = {.value = right.value, .error = errors.of_one(right.error, left.error)};
  return forces;
}

}  // namespace riesel::app
