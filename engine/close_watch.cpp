#include "engine/close_watch.hpp"

#include "engine/vector_kernel.hpp"

#include <algorithm>

namespace riesel {

namespace {

struct Watched {
  std::array<const std::int64_t*, 2> slot, place;
  Fixed *x, *y;
  const Fixed *ux, *uy;
  const double *reach2, *far2;
};

/// What they are looked at with.
struct Sight {
  const std::int32_t* place;  // by slot
  const Fixed *deflected_x, *deflected_y;
  Fall fallen;
  double metre_x, metre_y;
};

/// Whether pair k is due. Its second grain goes on along its course.
template <class Numbers>
[[gnu::always_inline]] inline bool is_due(const Watched& w, std::size_t k, const Sight& s) {
  const std::int64_t first = w.place[0][k], second = w.place[1][k];
  const std::int64_t elsewhere = (s.place[w.slot[0][k]] - first) | (s.place[w.slot[1][k]] - second);
  w.x[k] = wrapped_sum(w.x[k], wrapped_sum(w.ux[k], s.fallen.x));
  w.y[k] = wrapped_sum(w.y[k], wrapped_sum(w.uy[k], s.fallen.y));
  const std::int64_t second_or_any = second < 0 ? 0 : second;
  const Fixed x = second < 0 ? w.x[k] : s.deflected_x[second_or_any];
  const Fixed y = second < 0 ? w.y[k] : s.deflected_y[second_or_any];
  const double dx = Numbers::real(wrapped_difference(x, s.deflected_x[first])) * s.metre_x;
  const double dy = Numbers::real(wrapped_difference(y, s.deflected_y[first])) * s.metre_y;
  const double distance2 = dx * dx + dy * dy;
  return distance2 < w.reach2[k] || distance2 > w.far2[k] || elsewhere != 0;
}

struct WatchLoop {
  /// Finds the pairs that are due.
  template <class Numbers>
  [[gnu::always_inline]] static void run(std::size_t blocks, Watched w, Sight s,
                                         std::uint64_t* block_masks) {
    using Due = LaneMasks<std::uint64_t>;
    for (std::size_t block = 0; block < blocks; ++block) {
      std::uint64_t mask = 0;
#pragma omp simd reduction(| : mask)
      for (std::size_t lane = 0; lane < Due::lanes; ++lane)
        mask |= Due::bit_if(is_due<Numbers>(w, block * Due::lanes + lane, s) ? 1 : 0, lane);
      block_masks[block] = mask;
    }
  }
};

}  // namespace

template <class Visit>
void CloseWatch::for_each_column(Visit visit) {
  Columns& c = columns_;
  for (auto* both : {&c.slot, &c.place})
    for (auto& column : *both) visit(column);
  for (auto* column : {&c.x, &c.y, &c.ux, &c.uy}) visit(*column);
  for (auto* column : {&c.reach2, &c.far2}) visit(*column);
}

void CloseWatch::start_over(std::uint32_t own_slot) {
  pairs_.clear();
  own_slot_ = own_slot;
  for (auto& slots : columns_.slot) std::fill(slots.begin(), slots.end(), own_slot);
}

void CloseWatch::add(std::uint32_t pair, std::uint32_t first, std::uint32_t second, double reach,
                     double far, std::int64_t step) {
  const std::size_t i = pairs_.size();
  pairs_.push_back(pair);
  const std::size_t room = Due::padded(pairs_.size());
  if (columns_.x.size() < room) {
    for (auto& slots : columns_.slot) slots.resize(2 * room, own_slot_);
    for_each_column([room](auto& column) { column.resize(2 * room); });
    are_due_.resize(2 * room);
  }
  columns_.slot[0][i] = first;
  columns_.slot[1][i] = second;
  columns_.place[0][i] = courses_.place(first);
  columns_.place[1][i] = courses_.place(second);
  const Motion on_course = courses_.motion(second, step);
  columns_.x[i] = on_course.x;
  columns_.y[i] = on_course.y;
  columns_.ux[i] = on_course.ux;
  columns_.uy[i] = on_course.uy;
  columns_.reach2[i] = reach * reach;
  columns_.far2[i] = far * far;
}

void CloseWatch::remove(std::size_t i) {
  const std::size_t last = pairs_.size() - 1;
  pairs_[i] = pairs_[last];
  pairs_.pop_back();
  for_each_column([i, last](auto& column) { column[i] = column[last]; });
}

const std::vector<std::uint32_t>& CloseWatch::due_in(const StepUnits& units,
                                                     const DeflectedGrains& deflected) {
  due_.clear();
  leaving_.clear();
  const std::size_t count = pairs_.size();
  if (count == 0) return due_;
  const Columns& c = columns_;
  const Watched watched{.slot = {c.slot[0].data(), c.slot[1].data()},
                        .place = {c.place[0].data(), c.place[1].data()},
                        .x = columns_.x.data(),
                        .y = columns_.y.data(),
                        .ux = c.ux.data(),
                        .uy = c.uy.data(),
                        .reach2 = c.reach2.data(),
                        .far2 = c.far2.data()};
  const Bodies bodies = deflected.bodies();
  const Sight sight{.place = courses_.places().data(),
                    .deflected_x = bodies.x,
                    .deflected_y = bodies.y,
                    .fallen = units.fallen,
                    .metre_x = units.metre_x,
                    .metre_y = units.metre_y};
  constexpr std::size_t few = 5;  // for which gathering them into vectors takes too long
  if (count <= few) {
    for (std::size_t i = 0; i < count; ++i)
      if (is_due<ByConversion>(watched, i, sight)) leaving_.push_back(i);
  } else {
    run_vector_loop<WatchLoop>(Due::blocks(count), watched, sight, are_due_.of_blocks.data());
    are_due_.for_each_found(count, [this](std::size_t i) { leaving_.push_back(i); });
  }
  // From the end, as the last pair takes the place of the one that goes.
  std::reverse(leaving_.begin(), leaving_.end());
  for (const std::size_t i : leaving_) {
    due_.push_back(pairs_[i]);
    remove(i);
  }
  return due_;
}

}  // namespace riesel
