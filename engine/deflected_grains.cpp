#include "engine/deflected_grains.hpp"

#include "engine/vector_kernel.hpp"

#include <algorithm>
#include <cstdlib>

namespace riesel {

namespace {

/// Along one axis; `count` is a multiple of `lanes`.
template <std::size_t lanes>
RIESEL_VECTOR_KERNEL void move_lanes(std::size_t count, Fixed fallen, const Fixed* kick, Fixed* u,
                                     Fixed* position, Fixed* off_u, Fixed* off) {
  for (std::size_t block = 0; block < count; block += lanes) {
#pragma omp simd
    for (std::size_t lane = 0; lane < lanes; ++lane) {
      const std::size_t i = block + lane;
      u[i] = wrapped_sum(u[i], kick[i]);
      position[i] = wrapped_sum(position[i], wrapped_sum(u[i], fallen));
      off_u[i] = wrapped_sum(off_u[i], kick[i]);
      off[i] = wrapped_sum(off[i], off_u[i]);
    }
  }
}

/// One axis of the deviation from the course.
struct Deviation {
  const Fixed *kick, *off_u, *off;
  Fixed tolerance;
};

/// Sets flags where the next step leads beyond the tolerance along an axis, and blocks[b] where one
/// of its lanes has.
template <std::size_t lanes>
RIESEL_VECTOR_KERNEL void flag_strays(std::size_t count, Deviation x, Deviation y,
                                      std::int64_t* flags, std::int64_t* blocks) {
  for (std::size_t block = 0; block < count; block += lanes) {
    std::int64_t any = 0;
#pragma omp simd reduction(| : any)
    for (std::size_t lane = 0; lane < lanes; ++lane) {
      const std::size_t i = block + lane;
      const Fixed next_x = wrapped_sum(x.off[i], wrapped_sum(x.off_u[i], x.kick[i]));
      const Fixed next_y = wrapped_sum(y.off[i], wrapped_sum(y.off_u[i], y.kick[i]));
      const std::int64_t beyond_x = next_x > x.tolerance || next_x < -x.tolerance ? 1 : 0;
      const std::int64_t beyond_y = next_y > y.tolerance || next_y < -y.tolerance ? 1 : 0;
      flags[i] = beyond_x | beyond_y;
      any |= beyond_x | beyond_y;
    }
    blocks[block / lanes] = any;
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

void DeflectedGrains::move(const Fall& fallen) {
  auto& c = columns_;
  move_lanes<Strays::lanes>(padded_size(), fallen.x, c[at_kick_x].data(), c[at_ux].data(),
                            c[at_x].data(), c[off_ux].data(), c[off_x].data());
  move_lanes<Strays::lanes>(padded_size(), fallen.y, c[at_kick_y].data(), c[at_uy].data(),
                            c[at_y].data(), c[off_uy].data(), c[off_y].data());
  for (std::size_t i = 0; i < spin_.size(); ++i) spin_[i] = wrapped_sum(spin_[i], spin_kick_[i]);
}

void DeflectedGrains::clear_kicks() {
  for (const Column c : {at_kick_x, at_kick_y})
    std::fill_n(columns_[c].begin(), padded_size(), Fixed{0});
  std::fill(spin_kick_.begin(), spin_kick_.end(), 0);
}

/// The next move takes up the kick: the course is that of then.
void DeflectedGrains::set_course(Place place) {
  columns_[off_x][place] = columns_[off_y][place] = 0;
  columns_[off_ux][place] = wrapped_difference(0, columns_[at_kick_x][place]);
  columns_[off_uy][place] = wrapped_difference(0, columns_[at_kick_y][place]);
}

const std::vector<DeflectedGrains::Place>& DeflectedGrains::straying(Fixed tolerance_x,
                                                                     Fixed tolerance_y) {
  const auto& c = columns_;
  flag_strays<Strays::lanes>(padded_size(),
                             {.kick = c[at_kick_x].data(),
                              .off_u = c[off_ux].data(),
                              .off = c[off_x].data(),
                              .tolerance = tolerance_x},
                             {.kick = c[at_kick_y].data(),
                              .off_u = c[off_uy].data(),
                              .off = c[off_y].data(),
                              .tolerance = tolerance_y},
                             strays_.of_lanes.data(), strays_.of_blocks.data());
  straying_.clear();
  strays_.for_each_set(end(), [this](std::size_t place, std::int64_t) {
    straying_.push_back(static_cast<Place>(place));
  });
  return straying_;
}

}  // namespace riesel
