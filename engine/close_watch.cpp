#include "engine/close_watch.hpp"

#include "engine/vector_kernel.hpp"

namespace riesel {

namespace {

/// The columns that the loop needs.
struct Watched {
  const std::int64_t* second;  // place
  Fixed *x, *y;
  const Fixed *ux, *uy;
  const Fixed *rest_x, *rest_y;
  const double *reach2, *far2;
};

/// The numbers of the step: the fall in it, and metres per quantum.
struct Sight {
  FixedVector fallen;
  double metre_x, metre_y;
};

/// -1 (all bits set) if `place` is that of a flying grain, 0 if it is that of a deflected one.
[[gnu::always_inline]] inline Fixed flies(std::int64_t place) {
  static_assert(Courses::flying < 0);
  return place >> 63;
}

/// Moves the second grain of pair k along its course if it flies, and tells whether the pair is
/// due.
template <class Numbers>
[[gnu::always_inline]] inline bool is_due(const Watched& w, std::size_t k, const Sight& s) {
  const Fixed goes_on = flies(w.second[k]);
  w.x[k] = wrapped_sum(w.x[k], wrapped_sum(w.ux[k], s.fallen.x) & goes_on);
  w.y[k] = wrapped_sum(w.y[k], wrapped_sum(w.uy[k], s.fallen.y) & goes_on);
  const double dx = Numbers::real(wrapped_sum(w.x[k], w.rest_x[k])) * s.metre_x;
  const double dy = Numbers::real(wrapped_sum(w.y[k], w.rest_y[k])) * s.metre_y;
  const double distance2 = dx * dx + dy * dy;
  return distance2 < w.reach2[k] || distance2 > w.far2[k];
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
  for (auto& column : c.slot) visit(column);
  for (auto& column : c.place) visit(column);
  for (auto* column : {&c.x, &c.y, &c.ux, &c.uy}) visit(*column);
  for (auto* column : {&c.reach2, &c.far2}) visit(*column);
}

void CloseWatch::add(std::uint32_t pair, std::uint32_t first, std::uint32_t second, double reach,
                     double far, std::int64_t step) {
  const std::size_t i = pairs_.size();
  pairs_.push_back(pair);
  const std::size_t room = Due::padded(pairs_.size());
  if (columns_.x.size() < room) {
    for_each_column([room](auto& column) { column.resize(2 * room); });
    for (auto* column : {&rest_x_, &rest_y_}) column->resize(2 * room);
    are_due_.resize(2 * room);
  }
  columns_.slot[0][i] = first;
  columns_.slot[1][i] = second;
  columns_.place[0][i] = courses_.place(first);
  columns_.place[1][i] = courses_.place(second);
  const Motion on_course = courses_.deflected(second) ? Motion{} : courses_.motion(second, step);
  columns_.x[i] = on_course.position.x;
  columns_.y[i] = on_course.position.y;
  columns_.ux[i] = on_course.u.x;
  columns_.uy[i] = on_course.u.y;
  columns_.reach2[i] = reach * reach;
  columns_.far2[i] = far * far;
}

void CloseWatch::remove(std::size_t i) {
  const std::size_t last = pairs_.size() - 1;
  pairs_[i] = pairs_[last];
  pairs_.pop_back();
  for_each_column([i, last](auto& column) { column[i] = column[last]; });
}

bool CloseWatch::holds(std::size_t i) const {
  const Columns& c = columns_;
  const auto is_there = [&](std::size_t grain) {
    return courses_.place(c.slot[grain][i]) == c.place[grain][i];
  };
  return is_there(0) && is_there(1);
}

/// Reads the positions of the deflected grains; in a scalar loop, as vector gathers are not faster.
void CloseWatch::look_up(const Bodies& bodies) {
  const Columns& c = columns_;
  for (std::size_t i = 0; i < pairs_.size(); ++i) {
    const Fixed stands = ~flies(c.place[1][i]);
    const std::int64_t first = c.place[0][i], second = c.place[1][i] & stands;
    rest_x_[i] = wrapped_difference(bodies.position[second].x & stands, bodies.position[first].x);
    rest_y_[i] = wrapped_difference(bodies.position[second].y & stands, bodies.position[first].y);
  }
}

const std::vector<std::uint32_t>& CloseWatch::due_in(const StepUnits& units,
                                                     const DeflectedGrains& deflected) {
  due_.clear();
  const std::size_t count = pairs_.size();
  if (count == 0) return due_;
  look_up(deflected.bodies());
  const Columns& c = columns_;
  const Watched watched{.second = c.place[1].data(),
                        .x = columns_.x.data(),
                        .y = columns_.y.data(),
                        .ux = c.ux.data(),
                        .uy = c.uy.data(),
                        .rest_x = rest_x_.data(),
                        .rest_y = rest_y_.data(),
                        .reach2 = c.reach2.data(),
                        .far2 = c.far2.data()};
  const Sight sight{.fallen = units.fallen, .metre_x = units.metre_x, .metre_y = units.metre_y};
  constexpr std::size_t few = 5;  // so soon, a vector load would wait for the scalar stores
  if (count <= few) {
    for (std::size_t i = 0; i < count; ++i)
      if (is_due<ByConversion>(watched, i, sight)) due_.push_back(pairs_[i]);
  } else {
    run_vector_loop<WatchLoop>(Due::blocks(count), watched, sight, are_due_.of_blocks.data());
    are_due_.for_each_found(count, [this](std::size_t i) { due_.push_back(pairs_[i]); });
  }
  return due_;
}

}  // namespace riesel
