#include "engine/plain_steps.hpp"

#include "engine/contact_loop.hpp"
#include "engine/kicks.hpp"
#include "engine/pair_search.hpp"
#include "engine/vector_kernel.hpp"

#include <algorithm>
#include <cmath>

namespace riesel {

namespace {

/// The arrays of consecutive grains that are to move by one step.
struct Movers {
  FixedVector fallen;
  const FixedVector* u;
  FixedVector* position;
  PackedPoint* coarse;

  [[gnu::always_inline]] void move(std::size_t begin, std::size_t end) const {
#pragma omp simd
    for (std::size_t i = begin; i < end; ++i) {
      const FixedVector now = wrapped_sum(position[i], wrapped_sum(u[i], fallen));
      position[i].x = now.x;
      position[i].y = now.y;
      coarse[i].set(now.x, now.y);
    }
  }
};

/// Moves `count` grains by one step: from the first up to about `turn`, then from the last down to
/// there.
RIESEL_VECTOR_KERNEL void fly(std::size_t count, std::size_t turn, Movers movers) {
  constexpr std::size_t block = slots_in_a_line;
  const std::size_t middle = turn / block * block;
  movers.move(0, middle);
  std::size_t done_from = middle + (count - middle) / block * block;
  movers.move(done_from, count);
  for (; done_from > middle; done_from -= block) movers.move(done_from - block, done_from);
}

}  // namespace

PlainSteps::PlainSteps(State& state, const ContactModel& model, Candidates& candidates,
                       const Askew& askew)
    : state_(state),
      model_(model),
      candidates_(candidates),
      units_(state),
      most_steps_askew_(askew.most_steps(state)),
      progress_(candidates.slices().size()) {
  start_over();
}

void PlainSteps::start_over() {
  coarse_.copy_all(candidates_.when_sorted());
  for (Slice& slice : candidates_.slices())
    for (LiveContacts* contacts : {&slice.pair_contacts, &slice.wall_contacts})
      contacts->pad_with(static_cast<std::int64_t>(slice.begin));
}

void PlainSteps::advance(std::size_t number, std::int64_t now, std::int64_t last) {
  const std::span<Slice> share = candidates_.share(number);
  Member member{
      .number = number, .share = share, .units = units_, .profile = share.front().profile};
  for (const Slice& mine : share) take_up_kicks(state_.grains, mine);
  while (now < last && !candidates_.in_trouble()) {
    member.profile.begin_step(now + 1);
    if (const std::int64_t steps = steps_ahead(member, now, last); steps > 1) {
      step_askew(member, now, now, now + steps);
      now += steps;
    } else {
      now = begin_together(member, now, last);
    }
  }
  for (const Slice& mine : share) give_back_kicks(state_.grains, mine);
  if (number == 0) state_.step = now;
}

void PlainSteps::move(Member& member, Slice& mine, std::int64_t step) {
  Grains& g = state_.grains;
  const std::size_t count = mine.end - mine.begin;
  if (count == 0) return member.profile.done(Profile::Phase::fly);  // there is no first grain
  const FixedVector fallen = wrapped_product(step, member.units.fall);
  // Processors prefetch some thousand bytes ahead in the direction of a loop. Beyond the end of a
  // share, these lines are being written by another thread. So the loop goes from both ends
  // inwards.
  const bool beside_others = candidates_.team().members() > 1 && member.share.size() == 1;
  const std::size_t turn = beside_others ? count / 2 : count;
  const std::size_t first = mine.begin;
  fly(count, turn, {fallen, &g.u[first], &g.position[first], &coarse_.points[first]});
  Candidates::count_motion(mine);
  member.profile.done(Profile::Phase::fly);
}

/// `motion` (m) is a bound on how far any grain in a pair of the slice has moved in this step.
void PlainSteps::touch(Member& member, Slice& mine, std::int64_t step, double motion) {
  mine.inner.spend(motion);
  mine.inner.keep_up(mine.pairs, coarse_, candidates_.units());
  find_overlapping(mine.inner.pairs(), coarse_, candidates_.units(), mine.hits);
  member.profile.done(Profile::Phase::search);
  member.units.move_to(step);
  candidates_.count_way_past_walls(mine, member.units);
  resolve_contacts(mine, state_, member.units, model_);
  give_away_kicks(mine, candidates_.slices().size() - 1);
  member.profile.done(Profile::Phase::forces);
}

void PlainSteps::receive(Member& member, Slice& mine, std::span<const Slice> givers) {
  receive_kicks(state_, candidates_, givers, mine);
  member.profile.done(Profile::Phase::receive);
}

/// All slices move together and check that the candidates hold; then they complete that step
/// together, or several steps askew. Returns the step that they have come to.
std::int64_t PlainSteps::begin_together(Member& member, std::int64_t now, std::int64_t last) {
  const std::int64_t next = now + 1;
  for (Slice& mine : member.share) move(member, mine, next);
  candidates_.compare_inner_lists(member.share);
  candidates_.team().arrive_and_wait(member.number);
  member.profile.done(Profile::Phase::fly);
  const std::int64_t steps = candidates_.ready_for(state_, coarse_, member.share, next,
                                                   std::min(most_steps_askew_, last - now));
  if (steps == 1)
    step_together(member, next);
  else
    step_askew(member, now, next, now + steps);
  return now + steps;
}

void PlainSteps::step_together(Member& member, std::int64_t step) {
  const double motion = candidates_.fastest();
  for (Slice& mine : member.share) touch(member, mine, step, motion);
  candidates_.team().arrive_and_wait(member.number);
  for (Slice& mine : member.share) receive(member, mine, candidates_.slices());
}

/// How many steps slices may go askew from step `now`, which all have completed. 1 or less: they
/// must move together first. All members get the same answer.
std::int64_t PlainSteps::steps_ahead(Member& member, std::int64_t now, std::int64_t last) {
  if (most_steps_askew_ == 1) return 1;
  candidates_.team().arrive_and_wait(member.number);  // all have received
  const std::int64_t steps =
      candidates_.steps_ahead(now + 1, std::min(most_steps_askew_, last - now));
  candidates_.team().arrive_and_wait(member.number);  // all have read the bounds: they may change
  return steps;
}

/// Goes askew from step `now`, which all slices have completed, to step `last`. The grains are at
/// step `moved`: `now` or the next one.
void PlainSteps::step_askew(Member& member, std::int64_t now, std::int64_t moved,
                            std::int64_t last) {
  const auto begin = static_cast<std::size_t>(member.share.data() - candidates_.slices().data());
  const std::span<Progress> progress(&progress_[begin], member.share.size());
  for (Progress& p : progress) {
    p.moved.pass(moved);
    p.touched.pass(now);
    p.received = now;
  }
  candidates_.team().arrive_and_wait(member.number);
  go_askew(
      begin, begin + progress.size(), [&](std::size_t slice) { return go_on(member, slice, last); },
      [&] {
        return std::all_of(progress.begin(), progress.end(),
                           [&](const Progress& p) { return p.received == last; });
      });
  candidates_.team().arrive_and_wait(member.number);
}

/// Does all that this slice can do now, up to step `last`; returns false if that is nothing.
bool PlainSteps::go_on(Member& member, std::size_t slice, std::int64_t last) {
  std::vector<Slice>& slices = candidates_.slices();
  const auto [before, after] = PlaceInRing(slice, slices.size());
  Slice &mine = slices[slice], &next = slices[after];
  Progress& progress = progress_[slice];
  bool any = false;
  while (progress.received < last) {
    const std::int64_t step = progress.received + 1;
    if (progress.moved.passed() < step) {
      move(member, mine, step);
      progress.moved.pass(step);
      any = true;
    }
    if (progress.touched.passed() < step) {
      if (progress_[after].moved.passed() < step) return any;
      // The next slice stays at this step until this one has touched.
      candidates_.catch_strays(state_, coarse_, mine, next, step);
      mine.inner.heed(mine.inner.use());  // its own use decides: no other slice waits for its list
      touch(member, mine, step, std::sqrt(std::max(mine.fastest2, next.fastest2)));
      progress.touched.pass(step);
      any = true;
    }
    if (progress_[before].touched.passed() < step) return any;
    receive(member, mine, std::span(&slices[before], 1));
    progress.received = step;
    any = true;
  }
  return any;
}

}  // namespace riesel
