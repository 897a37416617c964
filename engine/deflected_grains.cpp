#include "engine/deflected_grains.hpp"

#include "engine/vector_kernel.hpp"

#include <algorithm>
#include <cstdlib>

namespace riesel {

struct DeflectedGrains::Axis {
  const Fixed* kick;
  Fixed *u, *position;
  Fixed *off_u, *off;
};

namespace {

/// Place i moves on by a step.
template <class Axis>
[[gnu::always_inline]] inline void move_along(const Axis& a, std::size_t i, Fixed fallen) {
  const Fixed u = wrapped_sum(a.u[i], a.kick[i]);
  a.u[i] = u;
  a.position[i] = wrapped_sum(a.position[i], wrapped_sum(u, fallen));
}

/// `count` is a multiple of `lanes`.
template <std::size_t lanes, class Axis>
RIESEL_VECTOR_KERNEL void move_lanes(std::size_t count, const Axis& along_x, const Axis& along_y,
                                     const Fall& fallen) {
  const Axis x = along_x, y = along_y;  // what others refer to may change with each store
  const Fall f = fallen;
  for (std::size_t block = 0; block < count; block += lanes) {
#pragma omp simd
    for (std::size_t lane = 0; lane < lanes; ++lane) {
      move_along(x, block + lane, f.x);
      move_along(y, block + lane, f.y);
    }
  }
}

/// Carries on by the next step what place i is off its course; 1 if that is beyond the tolerance
/// (quanta).
template <class Axis>
[[gnu::always_inline]] inline std::uint64_t strays_along(const Axis& a, std::size_t i,
                                                         Fixed tolerance) {
  const Fixed off_u = wrapped_sum(a.off_u[i], a.kick[i]);
  const Fixed off = wrapped_sum(a.off[i], off_u);
  a.off_u[i] = off_u;
  a.off[i] = off;
  return off > tolerance || off < -tolerance ? 1 : 0;
}

/// Finds where the next step leads beyond the tolerance along an axis.
template <class Strays, class Axis>
RIESEL_VECTOR_KERNEL void find_strays(std::size_t count, const Axis& along_x, const Axis& along_y,
                                      Fixed tolerance_x, Fixed tolerance_y,
                                      std::uint64_t* block_masks) {
  const Axis x = along_x, y = along_y;
  for (std::size_t block = 0; block < count / Strays::lanes; ++block) {
    std::uint64_t mask = 0;
#pragma omp simd reduction(| : mask)
    for (std::size_t lane = 0; lane < Strays::lanes; ++lane) {
      const std::size_t i = block * Strays::lanes + lane;
      mask |=
          Strays::bit_if(strays_along(x, i, tolerance_x) | strays_along(y, i, tolerance_y), lane);
    }
    block_masks[block] = mask;
  }
}

}  // namespace

DeflectedGrains::Place DeflectedGrains::take(std::uint32_t slot, const Motion& motion) {
  if (free_.empty()) {
    free_.push_back(end());
    slots_.push_back(no_slot);
    contacts_.push_back(0);
    if (columns_[at_x].size() < padded_size()) {
      for (auto& column : columns_) column.resize(2 * padded_size());
      if (rotate())
        for (auto* column : {&spin_, &spin_kick_}) column->resize(2 * padded_size());
      strays_.resize(2 * padded_size());
    }
  }
  const Place place = free_.back();
  free_.pop_back();
  slots_[place] = slot;
  contacts_[place] = 0;
  put(place, motion);
  return place;
}

void DeflectedGrains::put(Place place, const Motion& motion) {
  const std::array values{motion.x, motion.y, motion.ux, motion.uy, motion.kick_x, motion.kick_y};
  for (std::size_t c = 0; c < column_count; ++c)
    columns_[c][place] = c < values.size() ? values[c] : 0;
  if (!rotate()) return;
  spin_[place] = motion.spin;
  spin_kick_[place] = motion.spin_kick;
}

void DeflectedGrains::release(Place place) {
  slots_[place] = no_slot;
  put(place, {});
  free_.push_back(place);
}

void DeflectedGrains::clear() {
  slots_.clear();
  contacts_.clear();
  free_.clear();
  for (auto& column : columns_) std::fill(column.begin(), column.end(), 0);
  for (auto* column : {&spin_, &spin_kick_}) std::fill(column->begin(), column->end(), 0);
}

Motion DeflectedGrains::motion(Place place) const {
  return {.x = columns_[at_x][place],
          .y = columns_[at_y][place],
          .ux = columns_[at_ux][place],
          .uy = columns_[at_uy][place],
          .kick_x = columns_[at_kick_x][place],
          .kick_y = columns_[at_kick_y][place],
          .spin = rotate() ? spin_[place] : 0,
          .spin_kick = rotate() ? spin_kick_[place] : 0};
}

Bodies DeflectedGrains::bodies() const {
  return {.x = columns_[at_x].data(),
          .y = columns_[at_y].data(),
          .ux = columns_[at_ux].data(),
          .uy = columns_[at_uy].data(),
          .kick_x = columns_[at_kick_x].data(),
          .kick_y = columns_[at_kick_y].data(),
          .spin = spin_.data(),
          .spin_kick = spin_kick_.data(),
          .inertia = inertia_};
}

DeflectedGrains::Axis DeflectedGrains::along(std::size_t axis) {
  const auto column = [&](Column of_x) {
    return columns_[static_cast<std::size_t>(of_x) + axis].data();
  };
  return {.kick = column(at_kick_x),
          .u = column(at_ux),
          .position = column(at_x),
          .off_u = column(off_ux),
          .off = column(off_x)};
}

void DeflectedGrains::move(const Fall& fallen) {
  move_lanes<Strays::lanes>(padded_size(), along(x_axis), along(y_axis), fallen);
  for (std::size_t i = 0; i < spin_.size(); ++i) spin_[i] = wrapped_sum(spin_[i], spin_kick_[i]);
}

void DeflectedGrains::clear_kicks() {
  for (const Column c : {at_kick_x, at_kick_y})
    std::fill_n(columns_[c].begin(), padded_size(), Fixed{0});
  std::fill(spin_kick_.begin(), spin_kick_.end(), 0);
}

void DeflectedGrains::set_course(Place place) {
  for (const Column c : {off_x, off_y, off_ux, off_uy}) columns_[c][place] = 0;
}

const std::vector<DeflectedGrains::Place>& DeflectedGrains::straying(Fixed tolerance_x,
                                                                     Fixed tolerance_y) {
  find_strays<Strays>(padded_size(), along(x_axis), along(y_axis), tolerance_x, tolerance_y,
                      strays_.of_blocks.data());
  straying_.clear();
  strays_.for_each_found(
      end(), [this](std::size_t place) { straying_.push_back(static_cast<Place>(place)); });
  return straying_;
}

}  // namespace riesel
