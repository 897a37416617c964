#include "engine/deflected_grains.hpp"

#include "engine/vector_kernel.hpp"

#include <algorithm>
#include <cstring>

namespace riesel {

namespace {

// The loops below treat each axis separately, because GCC does not vectorise loops over
// FixedVectors.

/// Moves `count` grains, a multiple of `lanes`, to the next step.
template <std::size_t lanes>
RIESEL_VECTOR_KERNEL void move_lanes(std::size_t count, FixedVector* position, FixedVector* u,
                                     const FixedVector* kick, const FixedVector& fallen) {
  const FixedVector f = fallen;  // through the reference it would be loaded anew after each store
  for (std::size_t block = 0; block < count; block += lanes) {
#pragma omp simd
    for (std::size_t i = block; i < block + lanes; ++i) {
      const Fixed ux = wrapped_sum(u[i].x, kick[i].x), uy = wrapped_sum(u[i].y, kick[i].y);
      u[i].x = ux;
      u[i].y = uy;
      position[i].x = wrapped_sum(position[i].x, wrapped_sum(ux, f.x));
      position[i].y = wrapped_sum(position[i].y, wrapped_sum(uy, f.y));
    }
  }
}

/// Extrapolates how far grains are off their courses to the next step, and finds those that will be
/// beyond the tolerance (quanta) along an axis.
template <class OffCourse>
RIESEL_VECTOR_KERNEL void find_off_course(std::size_t count, FixedVector* off, FixedVector* off_u,
                                          const FixedVector* kick, Fixed tolerance_x,
                                          Fixed tolerance_y, std::uint64_t* block_masks) {
  for (std::size_t block = 0; block < count / OffCourse::lanes; ++block) {
    std::uint64_t mask = 0;
#pragma omp simd reduction(| : mask)
    for (std::size_t lane = 0; lane < OffCourse::lanes; ++lane) {
      const std::size_t i = block * OffCourse::lanes + lane;
      const Fixed ux = wrapped_sum(off_u[i].x, kick[i].x), uy = wrapped_sum(off_u[i].y, kick[i].y);
      const Fixed x = wrapped_sum(off[i].x, ux), y = wrapped_sum(off[i].y, uy);
      off_u[i].x = ux;
      off_u[i].y = uy;
      off[i].x = x;
      off[i].y = y;
      const std::uint64_t off_x = x > tolerance_x || x < -tolerance_x ? 1 : 0;
      const std::uint64_t off_y = y > tolerance_y || y < -tolerance_y ? 1 : 0;
      mask |= OffCourse::bit_if(off_x | off_y, lane);
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
    if (position_.size() < padded_size()) {
      for_each_vector([this](auto& vectors) { vectors.resize(2 * padded_size()); });
      if (rotate())
        for (auto* column : {&spin_, &spin_kick_}) column->resize(2 * padded_size());
      masks_.resize(2 * padded_size());
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
  position_[place] = motion.position;
  u_[place] = motion.u;
  kick_[place] = motion.kick;
  set_course(place);
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
  for_each_vector([](auto& vectors) { std::fill(vectors.begin(), vectors.end(), FixedVector{}); });
  for (auto* column : {&spin_, &spin_kick_}) std::fill(column->begin(), column->end(), 0);
}

Motion DeflectedGrains::motion(Place place) const {
  return {.position = position_[place],
          .u = u_[place],
          .kick = kick_[place],
          .spin = rotate() ? spin_[place] : 0,
          .spin_kick = rotate() ? spin_kick_[place] : 0};
}

Bodies DeflectedGrains::bodies() const {
  return {.position = position_.data(),
          .u = u_.data(),
          .kick = kick_.data(),
          .spin = spin_.data(),
          .spin_kick = spin_kick_.data(),
          .inertia = inertia_};
}

void DeflectedGrains::move(const FixedVector& fallen) {
  move_lanes<OffCourse::lanes>(padded_size(), position_.data(), u_.data(), kick_.data(), fallen);
  for (std::size_t i = 0; i < spin_.size(); ++i) spin_[i] = wrapped_sum(spin_[i], spin_kick_[i]);
}

void DeflectedGrains::clear_kicks() {
  if (kick_.empty()) return;  // memset must have memory, also for no bytes
  std::memset(kick_.data(), 0, padded_size() * sizeof(FixedVector));
  std::fill(spin_kick_.begin(), spin_kick_.end(), 0);
}

void DeflectedGrains::set_course(Place place) { off_[place] = off_u_[place] = {}; }

const std::vector<DeflectedGrains::Place>& DeflectedGrains::off_course(Fixed tolerance_x,
                                                                       Fixed tolerance_y) {
  find_off_course<OffCourse>(padded_size(), off_.data(), off_u_.data(), kick_.data(), tolerance_x,
                             tolerance_y, masks_.of_blocks.data());
  off_course_.clear();
  masks_.for_each_found(
      end(), [this](std::size_t place) { off_course_.push_back(static_cast<Place>(place)); });
  return off_course_;
}

}  // namespace riesel
