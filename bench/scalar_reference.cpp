#include "bench/scalar_reference.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>

namespace riesel::bench {

namespace {

/// The state, if it is known how to step it.
const State& known(const State& state, const ContactModel& model) {
  const auto like_first_and_at_rest = [&](const WallLattice& wall) {
    const WallLattice& first = state.walls.front();
    return !wall.smooth() && wall.count == first.count && wall.radius == first.radius
           && !wall.motion.is_ever_away();
  };
  const bool is_known =
      std::holds_alternative<LinearLaw>(model.normal)
      && std::holds_alternative<CappedSlip>(model.slip) && model.attraction == Attraction::keep
      && !state.grains.rotate() && state.gravity.x == 0.0 && state.walls.size() == 2
      && std::all_of(state.walls.begin(), state.walls.end(), like_first_and_at_rest);
  if (!is_known)
    throw std::invalid_argument("the scalar reference knows only the tube of the paper");
  return state;
}

}  // namespace

ScalarReference::ScalarReference(const State& state, const ContactModel& model)
    : n_(known(state, model).grains.size()),
      length_(state.box.length),
      width_(state.box.width),
      gravity_(state.gravity.y),
      dt_(state.time_step),
      wall_radius_(state.walls.front().radius),
      wall_spacing_(state.walls.front().spacing(state.box)),
      k_n_(std::get<LinearLaw>(model.normal).k_n),
      gamma_n_(std::get<LinearLaw>(model.normal).gamma_n),
      mu_(model.friction),
      fx_(n_, 0.0),
      fy_(n_, 0.0) {
  for (std::size_t i = 0; i < n_; ++i) {
    const Grain g = grain_at(state, i);
    x_.push_back(g.x);
    y_.push_back(g.y);
    vx_.push_back(g.vx);
    vy_.push_back(g.vy);
    radius_.push_back(g.radius);
    mass_.push_back(g.mass);
  }
  skin_ =
      0.3 * 2.0 * std::accumulate(radius_.begin(), radius_.end(), 0.0) / static_cast<double>(n_);
  rebuild();
}

double ScalarReference::mean_vy() const {
  return std::accumulate(vy_.begin(), vy_.end(), 0.0) / static_cast<double>(n_);
}

double ScalarReference::kinetic_energy() const {
  double sum = 0.0;
  for (std::size_t i = 0; i < n_; ++i) sum += 0.5 * mass_[i] * (vx_[i] * vx_[i] + vy_[i] * vy_[i]);
  return sum;
}

void ScalarReference::advance(std::int64_t steps) {
  for (std::int64_t s = 0; s < steps; ++s) step();
}

void ScalarReference::step() {
  for (std::size_t i = 0; i < n_; ++i) {
    vx_[i] += 0.5 * dt_ * fx_[i] / mass_[i];
    vy_[i] += 0.5 * dt_ * (fy_[i] / mass_[i] + gravity_);
    x_[i] += dt_ * vx_[i];
    y_[i] += dt_ * vy_[i];
  }
  if (moved_too_far()) rebuild();
  forces();
  for (std::size_t i = 0; i < n_; ++i) {
    vx_[i] += 0.5 * dt_ * fx_[i] / mass_[i];
    vy_[i] += 0.5 * dt_ * (fy_[i] / mass_[i] + gravity_);
  }
}

double ScalarReference::nearest(double dy) const {
  if (dy > 0.5 * length_) return dy - length_;
  if (dy < -0.5 * length_) return dy + length_;
  return dy;
}

/// Measured from the common fall, as the engine does.
bool ScalarReference::moved_too_far() const {
  double drift = 0.0;
  for (std::size_t i = 0; i < n_; ++i) drift += y_[i] - y_built_[i];
  drift /= static_cast<double>(n_);
  double farthest2 = 0.0;
  for (std::size_t i = 0; i < n_; ++i) {
    const double dx = x_[i] - x_built_[i], dy = y_[i] - y_built_[i] - drift;
    farthest2 = std::max(farthest2, dx * dx + dy * dy);
  }
  return farthest2 > 0.25 * skin_ * skin_;
}

void ScalarReference::rebuild() {
  for (double& y : y_) y -= length_ * std::floor(y / length_);
  const double range = 2.0 * *std::max_element(radius_.begin(), radius_.end()) + skin_;
  columns_ = static_cast<std::size_t>(std::max(1.0, width_ / range));
  rows_ = static_cast<std::size_t>(std::max(3.0, length_ / range));
  sort_by_cell();
  first_.assign(1, 0);
  neighbours_.clear();
  for (std::size_t i = 0; i < n_; ++i) {
    list_neighbours(i);
    first_.push_back(static_cast<std::uint32_t>(neighbours_.size()));
  }
  x_built_ = x_;
  y_built_ = y_;
}

std::size_t ScalarReference::cell_of(std::size_t i) const {
  const double across = std::clamp(x_[i] / width_, 0.0, 1.0 - 1e-12);
  const auto column = static_cast<std::size_t>(across * static_cast<double>(columns_));
  const auto row = static_cast<std::size_t>(y_[i] / length_ * static_cast<double>(rows_)) % rows_;
  return row * columns_ + column;
}

/// So that neighbours lie together.
void ScalarReference::sort_by_cell() {
  std::vector<std::size_t> order(n_), cell(n_);
  std::iota(order.begin(), order.end(), std::size_t{0});
  for (std::size_t i = 0; i < n_; ++i) cell[i] = cell_of(i);
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return cell[a] < cell[b]; });
  for (auto* values : {&x_, &y_, &vx_, &vy_, &fx_, &fy_, &radius_, &mass_}) {
    std::vector<double> sorted(n_);
    for (std::size_t i = 0; i < n_; ++i) sorted[i] = (*values)[order[i]];
    values->swap(sorted);
  }
  start_.assign(columns_ * rows_ + 1, 0);
  for (std::size_t i = 0; i < n_; ++i) ++start_[cell[i] + 1];
  std::partial_sum(start_.begin(), start_.end(), start_.begin());
}

/// Those with a larger index in the nine cells around grain i.
void ScalarReference::list_neighbours(std::size_t i) {
  const std::size_t home = cell_of(i), row = home / columns_, column = home % columns_;
  const std::size_t left = column == 0 ? 0 : column - 1;
  const std::size_t right = std::min(column + 1, columns_ - 1);
  for (std::size_t shift = 0; shift < 3; ++shift) {
    const std::size_t other = (row + rows_ + shift - 1) % rows_ * columns_;
    for (std::size_t j = std::max(i + 1, start_[other + left]); j < start_[other + right + 1];
         ++j) {
      const double dx = x_[j] - x_[i], dy = nearest(y_[j] - y_[i]);
      const double reach = radius_[i] + radius_[j] + skin_;
      if (dx * dx + dy * dy < reach * reach) neighbours_.push_back(static_cast<std::uint32_t>(j));
    }
  }
}

void ScalarReference::forces() {
  std::fill(fx_.begin(), fx_.end(), 0.0);
  std::fill(fy_.begin(), fy_.end(), 0.0);
  for (std::size_t i = 0; i < n_; ++i) {
    for (std::uint32_t p = first_[i]; p < first_[i + 1]; ++p) pair_force(i, neighbours_[p]);
    const double reach = radius_[i] + wall_radius_;
    if (x_[i] < reach) wall_force(i, 0.0);
    if (x_[i] > width_ - reach) wall_force(i, width_);
  }
}

namespace {

struct Force {
  double x, y;
};

/// On the first body; (dx, dy) from the first to the second, (dvx, dvy) the velocity of the second
/// relative to it.
Force contact(double dx, double dy, double distance, double overlap, double dvx, double dvy,
              double m_red, double k_n, double gamma_n, double mu, double dt) {
  const double nx = dx / distance, ny = dy / distance;
  const double f_n = k_n * overlap - gamma_n * m_red * (dvx * nx + dvy * ny);
  const double slip = dvx * ny - dvy * nx;
  const double most = mu * std::abs(f_n);
  const double f_s = std::clamp(-m_red * slip / dt, -most, most);
  return {-f_n * nx - f_s * ny, -f_n * ny + f_s * nx};
}

}  // namespace

void ScalarReference::pair_force(std::size_t i, std::size_t j) {
  const double dx = x_[j] - x_[i], dy = nearest(y_[j] - y_[i]);
  const double reach = radius_[i] + radius_[j];
  const double d2 = dx * dx + dy * dy;
  if (d2 >= reach * reach) return;
  const double distance = std::sqrt(d2);
  const Force f = contact(dx, dy, distance, reach - distance, vx_[j] - vx_[i], vy_[j] - vy_[i],
                          mass_[i] * mass_[j] / (mass_[i] + mass_[j]), k_n_, gamma_n_, mu_, dt_);
  fx_[i] += f.x;
  fy_[i] += f.y;
  fx_[j] -= f.x;
  fy_[j] -= f.y;
}

void ScalarReference::wall_force(std::size_t i, double line) {
  const double reach = radius_[i] + wall_radius_;
  const double dx = line - x_[i];
  const double nearest_wall_grain = std::nearbyint(y_[i] / wall_spacing_) * wall_spacing_;
  for (const double offset : {-wall_spacing_, 0.0, wall_spacing_}) {
    const double dy = nearest_wall_grain + offset - y_[i];
    const double d2 = dx * dx + dy * dy;
    if (d2 >= reach * reach) continue;
    const double distance = std::sqrt(d2);
    const Force f = contact(dx, dy, distance, reach - distance, -vx_[i], -vy_[i], mass_[i], k_n_,
                            gamma_n_, mu_, dt_);
    fx_[i] += f.x;
    fy_[i] += f.y;
  }
}

}  // namespace riesel::bench
