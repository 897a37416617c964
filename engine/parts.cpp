#include "engine/parts.hpp"

#include "engine/require.hpp"
#include "engine/team.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <numeric>
#include <utility>

namespace riesel {

namespace {

/// Factors from the length of a stretch to that of the next: until it is known how long candidates
/// hold; afterwards, if they held for the whole stretch; if they did not.
constexpr double longer_at_first = 1.5, longer = 1.005, shorter = 0.95;

/// Factors of the buffer after a stretch that was in vain, and after any other; the least buffer in
/// mean diameters.
constexpr double wider = 1.4, narrower = 0.998, least_buffer = 1.0;

/// If the buffers take a larger part of the tube than the first number, a stretch in vain makes
/// stretches shorter by this factor instead of buffers wider, but not shorter than the last number.
constexpr double largest_buffers = 0.2, much_shorter = 0.6, fewest_steps = 32.0;

}  // namespace

Parts::Parts(State& state, const ContactModel& model, bool by_flights, int threads, Habits& habits)
    : state_(state),
      model_(model),
      by_flights_(by_flights),
      habits_(habits),
      reach_(largest_reach(state)),
      diameter_(mean_diameter(state.grains)),
      team_(threads),
      weights_(team_.members(), 1.0),
      borders_(team_.members() + 1),
      seconds_(team_.members()),
      agreed_(team_.members()) {
  require(threads > 1, "parts are for two threads or more");
  for (std::size_t i = 0; i < team_.members(); ++i)
    parts_.push_back(std::make_unique<Part>(state, model, by_flights));
}

bool Parts::pay(const State& state, int threads) {
  constexpr double least_diameters = 40.0;
  return state.box.length > least_diameters * threads * mean_diameter(state.grains);
}

void Parts::advance(std::int64_t last, Profile& profile) {
  if (whole_) return;
  as_a_team(static_cast<int>(parts_.size()),
            [&](std::size_t member) { do_stretches(member, last, profile); });
  for (const auto& part : parts_) part->hand_over(state_, profile);
  sort_by_name(state_.contacts);
}

void Parts::fail_if_in_trouble() const {
  if (whole_) whole_->fail_if_in_trouble();
}

void Parts::do_stretches(std::size_t member, std::int64_t last, Profile& profile) {
  if (member == 0) {
    parts_.front()->hold(std::exchange(state_.contacts, {}));
    if (profile.on()) parts_.front()->start_profile();
  }
  while (true) {
    if (member == 0) plan(last);
    team_.arrive_and_wait(member);
    if (over_) return;
    do_stretch(member);
    if (all_agree()) parts_[member]->accept();
    if (member == 0) conclude(last, profile);
  }
}

void Parts::do_stretch(std::size_t member) {
  Part& mine = *parts_[member];
  const auto begin = std::chrono::steady_clock::now();
  mine.cut(state_, parts_, extent_of(member));
  mine.advance(until_, drift_);
  mine.write(next_);
  seconds_[member] =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  team_.arrive_and_wait(member);
  const std::uint64_t farthest = farthest_met();
  agreed_[member] = !mine.in_trouble() && farthest <= margin_ && mine.agrees(next_, farthest);
  team_.arrive_and_wait(member);
}

void Parts::plan(std::int64_t last) {
  over_ = whole_ || state_.step >= last;
  if (over_) return;
  constexpr std::int64_t stretches_per_order = 64;
  if (stretches_ % stretches_per_order == 0) sort();
  // Stretches of equal length, so that the last one is not short.
  const auto steps = static_cast<double>(last - state_.step);
  cut_short_ = steps <= habits_.steps;
  until_ =
      state_.step + static_cast<std::int64_t>(std::ceil(steps / std::ceil(steps / habits_.steps)));
  margin_ = quanta(reach_ + parts_.front()->skin() + habits_.buffer * diameter_);
  drift_ = middle_velocity(state_.grains);
  share_out();
}

/// Sorts the grains so that those of a part are consecutive: threads then hardly share cache lines
/// when they write their results.
void Parts::sort() {
  TeamBarrier alone(1);
  Cells().sort(state_, reach_, alone, 0);
  next_ = state_.grains;
}

/// Places the borders between the parts so that each gets its share of the grains.
void Parts::share_out() {
  constexpr int bits = 12;
  std::array<std::size_t, std::size_t{1} << bits> count{};  // of grains, along the ring
  for (const FixedVector& at : state_.grains.position)
    ++count[static_cast<std::uint64_t>(at.y) >> (64 - bits)];
  const double grains_per_weight = static_cast<double>(state_.grains.size())
                                   / std::accumulate(weights_.begin(), weights_.end(), 0.0);
  double wanted = 0.0;
  std::size_t bin = 0, before = 0;
  for (std::size_t part = 1; part < parts_.size(); ++part) {
    wanted += weights_[part - 1] * grains_per_weight;
    while (bin + 1 < count.size() && static_cast<double>(before) < wanted) before += count[bin++];
    borders_[part] = static_cast<std::uint64_t>(bin) << (64 - bits);
  }
}

/// The last part ends where the first begins: borders_.back() is 0, a whole turn.
Extent Parts::extent_of(std::size_t part) const {
  return {
      .begin = borders_[part], .length = borders_[part + 1] - borders_[part], .margin = margin_};
}

std::uint64_t Parts::quanta(double metres) const {
  return static_cast<std::uint64_t>(std::min(metres / state_.box.quantum_y(), 0x1p63));
}

/// Quanta of y: no grain of a part can have met one that began farther from the part than this.
std::uint64_t Parts::farthest_met() const {
  double wandered = 0.0;
  for (const auto& part : parts_) wandered = std::max(wandered, part->wandered());
  return quanta(reach_ + 2.0 * wandered);
}

bool Parts::all_agree() const {
  return std::all_of(agreed_.begin(), agreed_.end(), [](auto agreed) { return agreed != 0; });
}

void Parts::conclude(std::int64_t last, Profile& profile) {
  ++stretches_;
  if (all_agree()) {
    failures_ = 0;
    for_each_moving_array(next_,
                          [&](auto member) { std::swap(state_.grains.*member, next_.*member); });
    state_.step = until_;
    learn_from_success();
  } else {
    ++in_vain_;
    ++failures_;
    learn_from_failure();
    do_together(last, profile);
  }
}

void Parts::learn_from_success() {
  const bool sorted = std::any_of(parts_.begin(), parts_.end(),
                                  [](const auto& part) { return part->has_sorted(); });
  habits_.steps_known = habits_.steps_known || sorted;
  if (sorted)
    habits_.steps = std::max(1.0, habits_.steps * shorter);
  else if (!cut_short_)
    habits_.steps *= habits_.steps_known ? longer : longer_at_first;
  habits_.buffer = std::max(least_buffer, habits_.buffer * narrower);
  // By little in each stretch, as much of what makes a part slow is chance.
  constexpr double least_change = 0.98, largest_change = 1.02;
  const double mean =
      std::accumulate(seconds_.begin(), seconds_.end(), 0.0) / static_cast<double>(seconds_.size());
  for (std::size_t i = 0; i < weights_.size(); ++i) {
    const double slowness = std::max(seconds_[i], 1e-9) / std::max(mean, 1e-9);
    weights_[i] *= std::clamp(std::pow(slowness, -0.25), least_change, largest_change);
  }
  const double sum = std::accumulate(weights_.begin(), weights_.end(), 0.0);
  for (double& weight : weights_) weight *= static_cast<double>(weights_.size()) / sum;
}

void Parts::learn_from_failure() {
  const double buffers = 2.0 * static_cast<double>(parts_.size()) * habits_.buffer * diameter_;
  if (buffers < largest_buffers * state_.box.length) {
    habits_.buffer *= wider;
  } else {
    habits_.steps = std::min(habits_.steps, std::max(fewest_steps, habits_.steps * much_shorter));
    habits_.steps_known = true;
  }
}

/// Repeats the stretch that was in vain with all grains on one thread, and goes on for longer the
/// more stretches in a row were in vain.
void Parts::do_together(std::int64_t last, Profile& profile) {
  constexpr int most_doublings = 6;
  const std::int64_t steps = (until_ - state_.step) << std::min(failures_ - 1, most_doublings);
  until_ = std::min(last, state_.step + steps);
  for (const auto& part : parts_) part->hand_over(state_, profile);
  whole_.emplace(state_, model_, by_flights_);
  if (profile.on()) whole_->start_profile();
  whole_->advance(until_);
  whole_->complete_state(profile);
  if (whole_->candidates().in_trouble()) return;
  whole_.reset();
  parts_.front()->hold(std::exchange(state_.contacts, {}));
  next_ = state_.grains;
}

}  // namespace riesel
