// The inner list never misses a pair that overlaps, and is as short as the motion allows.
#include "engine/inner_pairs.hpp"
#include "engine/pair_search.hpp"
#include "tests/catch.hpp"
#include "tests/engine/systems.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

using namespace systems;

namespace {

constexpr double diameter = 1e-3, outer_skin = 0.35e-3;
const Box small_box{.width = 20e-3, .length = 20e-3};

/// Points that go straight on, all pairs within the outer skin, and their inner list. As long as
/// nobody goes farther than half of the outer skin, the candidates hold.
class Cloud {
public:
  explicit Cloud(std::size_t count) : dice_(count) {
    for (std::size_t i = 0; i < count; ++i) {
      x_.push_back(dice_.between(0.0, small_box.width));
      y_.push_back(dice_.between(0.0, small_box.length));
      angle_.push_back(dice_.between(0.0, 2.0 * std::numbers::pi));
    }
    positions_.points.resize(count);
    list_anew();
  }

  /// All pairs within the outer skin.
  void list_anew() {
    place();
    candidates_.clear();
    for (std::uint32_t i = 0; i < x_.size(); ++i)
      for (std::uint32_t j = i + 1; j < x_.size(); ++j)
        if (positions_.squared_distance(i, j, units_)
            < units_.generous_square(diameter + outer_skin))
          candidates_.add(i, j, units_.generous_square(diameter));
    inner_.start_over(outer_skin);
    left_ = 0.5 * outer_skin;
  }

  /// Each goes so far (m), in its own direction.
  void step(double motion) {
    inner_.heed(inner_.use());
    left_ -= motion;
    for (std::size_t i = 0; i < x_.size(); ++i) {
      x_[i] += motion * std::cos(angle_[i]);
      y_[i] += motion * std::sin(angle_[i]);
    }
    inner_.spend(motion);
    if (left_ < 0.0)
      list_anew();
    else
      place();
    inner_.keep_up(candidates_, positions_, units_);
  }

  std::set<std::uint32_t> overlapping() const { return overlapping_in(candidates_); }
  std::set<std::uint32_t> overlapping_in_list() const {
    std::set<std::uint32_t> found;
    for (const std::uint32_t pair : overlapping_in(inner_.pairs()))
      found.insert(inner_.candidate(pair));
    return found;
  }

  InnerPairs& inner() { return inner_; }
  const CandidatePairs& candidates() const { return candidates_; }

private:
  void place() {
    for (std::size_t i = 0; i < x_.size(); ++i) {
      positions_.points[i].set(small_box.fixed_x(x_[i]), small_box.fixed_y(y_[i]));
    }
  }

  std::set<std::uint32_t> overlapping_in(const CandidatePairs& pairs) const {
    Selection hits;
    find_overlapping(pairs, positions_, units_, hits);
    return {hits.items().begin(), hits.items().end()};
  }

  Dice dice_;
  CoarseUnits units_{small_box};
  std::vector<double> x_, y_, angle_;
  PackedPositions positions_;
  CandidatePairs candidates_;
  InnerPairs inner_;
  double left_ = 0.0;
};

}  // namespace

TEST_CASE("the inner list has every pair that overlaps, however fast grains are") {
  const double motion = GENERATE(1e-9, 1e-7, 2e-6, 3e-5, 1.7e-4, 1e-3);  // m per step
  CAPTURE(motion);
  Cloud cloud(400);
  std::size_t seen = 0;
  for (int step = 0; step < 300; ++step) {
    cloud.step(motion);
    const auto all = cloud.overlapping();
    CHECK(cloud.overlapping_in_list() == all);
    seen += all.size();
  }
  CHECK(seen > 0);
}

TEST_CASE("the inner list follows grains that become fast, and slow again") {
  Cloud cloud(400);
  for (const double motion : {1e-8, 3e-5, 1e-8})
    for (int step = 0; step < 100; ++step) {
      cloud.step(motion);
      CHECK(cloud.overlapping_in_list() == cloud.overlapping());
    }
}

TEST_CASE("the slower the grains, the fewer pairs are tested") {
  const auto tested = [](double motion) {
    Cloud cloud(400);
    for (int step = 0; step < 300; ++step) cloud.step(motion);
    // Without those that overlap all the time: nobody takes them out here.
    return cloud.inner().pairs().size() - cloud.overlapping().size();
  };
  const std::size_t fast = tested(1e-5), slow = tested(1e-7), at_rest = tested(0.0);
  CHECK(fast > 2 * slow);
  CHECK(slow > 2 * at_rest);
}

TEST_CASE("a pair in contact is not found, and found again when the contact has ended") {
  Cloud cloud(400);
  cloud.step(1e-6);
  const auto before = cloud.overlapping_in_list();
  REQUIRE_FALSE(before.empty());
  const std::uint32_t one = *before.begin();
  InnerPairs& inner = cloud.inner();
  for (std::size_t pair = 0; pair < inner.pairs().size(); ++pair)
    if (inner.candidate(pair) == one) inner.leave_out(pair);
  auto others = before;
  others.erase(one);
  CHECK(cloud.overlapping_in_list() == others);
  inner.take_back(cloud.candidates(), one);
  CHECK(cloud.overlapping_in_list() == before);
}

TEST_CASE("a list of no candidates at all serves until there are some") {
  Cloud one(1);
  for (int step = 0; step < 50; ++step) one.step(1e-3);
  CHECK(one.inner().pairs().size() == 0);
  InnerPairs& inner = one.inner();
  PackedPositions positions;
  positions.points.resize(2);
  CandidatePairs both;
  const CoarseUnits units(small_box);
  both.add(0, 1, units.generous_square(diameter));
  inner.start_over(outer_skin);
  inner.keep_up(both, positions, units);
  CHECK(inner.pairs().size() == 1);
}
