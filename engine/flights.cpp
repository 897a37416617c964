#include "engine/flights.hpp"

#include <algorithm>
#include <cmath>

namespace riesel {

Flights::Flights(State& state, const ContactModel& model, Candidates& candidates,
                 const Askew& askew)
    : airspace_(state, model, candidates),
      askew_(askew),
      most_steps_askew_(askew.most_steps(state)),
      may_go_askew_(
          askew.slices_per_thread(state, static_cast<int>(candidates.team().members()), true) > 1),
      progress_(candidates.slices().size()) {
  for (std::size_t number = 0; number < candidates.team().members(); ++number) {
    const std::span<Slice> share = candidates.share(number);
    Profile& profile = share.front().profile;
    const std::size_t begin = regions_.size(), end = begin + share.size();
    for (std::size_t slice = begin; slice < end; ++slice)
      regions_.push_back(std::make_unique<FlightRegion>(airspace_, slice, profile));
    members_.push_back(
        {.number = number, .begin = begin, .end = end, .share = share, .profile = profile});
  }
}

void Flights::start_over() {
  airspace_.courses.resize();
  for (Member& member : members_) member.trouble = member.under_way = false;
}

void Flights::advance(std::size_t number, std::int64_t now, std::int64_t last) {
  Member& member = members_[number];
  take_off(member, now);
  member.ill_cut = false;  // the caller has just decided on the number of slices
  while (!member.trouble && !member.ill_cut && now < last) {
    const std::int64_t askew = steps_askew(member, now, last);
    if (askew == 0) member.hold_until = now;  // the next step sorts
    const std::int64_t steps = std::max<std::int64_t>(1, askew);
    member.profile.begin_steps(now + 1, steps);
    if (steps > 1)
      step_askew(member, now, now + steps);
    else
      step_together(member, now + 1);
    now += steps;
  }
  land(member, now);
}

template <class Do>
void Flights::for_each_region(const Member& member, Do something) {
  for (std::size_t i = member.begin; i < member.end; ++i) something(*regions_[i]);
}

/// Waits for the other threads, and meanwhile calls something(region) for each region of the
/// member. That must touch nothing that other threads use, and be work that can also be done later:
/// a team of one skips it.
template <class Do>
void Flights::wait_and_meanwhile(const Member& member, Do something) {
  TeamBarrier& barrier = airspace_.candidates.team();
  if (barrier.members() == 1) return;
  barrier.arrive(member.number);
  for_each_region(member, something);
  barrier.wait(member.number);
}

void Flights::take_off(Member& member, std::int64_t step) {
  if (!member.under_way) {
    member.profile.begin_build();
    begin(member, step, FlightRegion::Kicks::to_come);
    member.profile.done_build();
    member.under_way = true;
    return;
  }
  if (member.leads()) airspace_.courses.set_origin(step);
  wait(member);
  for_each_region(member, [&](FlightRegion& region) { region.set_out_again(step); });
  wait(member);
  heed(member);
  for_each_region(member, [&](FlightRegion& r) { r.foresee(step, member.hold_until); });
}

/// Makes the appointments of all candidates, which have just been listed. All grains are at `step`.
/// If kicks are taken up already, in the middle of a step, candidates can be due in this same step.
void Flights::begin(Member& member, std::int64_t step, FlightRegion::Kicks kicks) {
  if (member.leads()) {
    airspace_.courses.start_over(step);
    airspace_.candidates.forget_cells();
  }
  member.leeway = airspace_.leeway();
  for_each_region(member, [&](FlightRegion& region) { region.start_over(step, member.leeway); });
  wait(member);
  for_each_region(member, [&](FlightRegion& region) { region.take_up_contacts(step); });
  wait(member);
  for_each_region(member, [&](FlightRegion& region) { region.set_out(step, kicks); });
  wait(member);
  heed(member);
  member.ill_cut = ill_cut();
  const std::int64_t earliest = kicks == FlightRegion::Kicks::taken_up ? step : step + 1;
  for_each_region(member, [&](FlightRegion& region) {
    region.make_all_appointments(step, earliest, member.hold_until);
  });
}

void Flights::land(Member& member, std::int64_t step) {
  wait(member);
  for_each_region(member, [&](FlightRegion& region) { region.land(step); });
  if (member.leads()) airspace_.state.step = step;
}

/// Sorts and lists anew, as the candidates do not hold any more; the grains have moved to `step`.
void Flights::renew(Member& member, std::int64_t step) {
  member.profile.begin_build();
  land(member, step);
  airspace_.candidates.sort_anew(airspace_.state, member.share, step);
  begin(member, step, FlightRegion::Kicks::taken_up);
  member.profile.done_build();
}

/// Combines what all slices have announced before the last barrier.
void Flights::heed(Member& member) const {
  const auto& all = airspace_.announcements;
  member.hold_until = all.front().hold_until;
  member.fastest2 = 0.0;
  for (const Announcement& one : all) {
    member.hold_until = std::min(member.hold_until, one.hold_until);
    member.fastest2 = std::max(member.fastest2, one.fastest2);
    member.trouble = member.trouble || one.trouble;
  }
}

/// Whether several slices per thread would be better, or only one, by the numbers of contacts that
/// were announced when the candidates were listed. All members get the same answer.
bool Flights::ill_cut() const {
  if (!may_go_askew_) return false;
  std::size_t contacts = 0;
  for (const Announcement& one : airspace_.announcements) contacts += one.contacts;
  const bool askew = regions_.size() > members_.size();
  return askew_.flights_gain(contacts, airspace_.state.grains.size(), askew) != askew;
}

/// One step of all regions together. Between the two barriers each takes up what others have done
/// to its grains, and changes what others know of them, which nobody reads then. What concerns only
/// grains inside of a slice, which are most, is done while waiting at the barriers.
void Flights::step_together(Member& member, std::int64_t step) {
  for_each_region(member, [&](FlightRegion& region) { region.move(step); });
  if (step >= member.hold_until) renew(member, step);
  for_each_region(member, [&](FlightRegion& region) { region.collide(step); });
  wait_and_meanwhile(member, [&](FlightRegion& region) { region.settle_inside(step); });
  for_each_region(member, [&](FlightRegion& region) { region.settle(step); });
  wait_and_meanwhile(member, [&](FlightRegion& r) { r.foresee_inside(step, member.hold_until); });
  heed(member);
  for_each_region(member, [&](FlightRegion& r) { r.foresee(step, member.hold_until); });
  member.profile.done(Profile::Phase::appointments);
}

/// How many steps slices may go askew from `now` on; 1 if none; 0 if none because it is time to
/// sort. All members get the same answer.
///
/// No sorting is possible meanwhile, and how fast grains will be is not known. It is expected that
/// none becomes more than twice as fast as the fastest, or as an oscillating wall makes it, and a
/// part of the room is left in case one does. The first step after a sorting is done together, as
/// grains at the start of a run may overlap and have no contacts yet.
std::int64_t Flights::steps_askew(const Member& member, std::int64_t now, std::int64_t last) const {
  const std::int64_t steps = std::min(most_steps_askew_, last - now);
  const std::int64_t age = now - airspace_.courses.sorted_at();
  if (steps <= 1 || age == 0 || !airspace_.candidates.slices_are_thick()) return 1;
  const double fastest = std::sqrt(member.fastest2), room = 0.9 * member.leeway.room;
  const double gone = static_cast<double>(age) * fastest;
  const double expected = std::max(2.0 * fastest, fastest + 2.0 * airspace_.shaking);
  const double ahead = static_cast<double>(steps) * expected;
  if (gone + ahead <= room && now + steps <= member.hold_until) return steps;
  // Sorting pays if much of the room is used up, and the last sorting has served for some time.
  const bool time_to_sort = gone > 0.5 * room && age >= 2 * most_steps_askew_;
  return time_to_sort ? 0 : 1;
}

/// Goes askew from step `now`, which all slices have completed, to step `last`.
void Flights::step_askew(Member& member, std::int64_t now, std::int64_t last) {
  for (std::size_t i = member.begin; i < member.end; ++i) {
    Progress& p = progress_[i];
    p.collided.pass(now);
    p.settled.pass(now);
    p.foreseen = now;
    p.fetched = false;
    regions_[i]->need_candidates_until(last);
  }
  wait(member);
  go_askew(
      member.begin, member.end, [&](std::size_t slice) { return go_on(member, slice, last); },
      [&] {
        return std::all_of(progress_.data() + member.begin, progress_.data() + member.end,
                           [&](const Progress& p) { return p.foreseen == last; });
      });
  wait(member);
  heed(member);
  for_each_region(member, [](FlightRegion& region) {
    region.need_candidates_until(FlightRegion::nobody_asks);
  });
}

/// Does all that this slice can do now, up to step `last`; returns false if that is nothing.
///
/// Other slices need two things of a step: the slice after this one its collisions, and the slice
/// before it how it has settled. A slice does not begin another step before both have had them.
bool Flights::go_on(const Member& member, std::size_t slice, std::int64_t last) {
  const auto [before, after] = PlaceInRing(slice, progress_.size());
  FlightRegion& region = *regions_[slice];
  Progress& p = progress_[slice];
  bool any = false;
  while (p.foreseen < last) {
    const std::int64_t step = p.foreseen + 1;
    if (p.collided.passed() < step) {
      if (!p.fetched) region.fetch();
      p.fetched = true;
      region.move(step);
      region.collide(step);
      region.watch_strays(step);
      p.collided.pass(step);
      any = true;
    }
    if (p.settled.passed() < step) {
      if (progress_[before].collided.passed() < step) return any;
      region.settle(step);
      p.settled.pass(step);
      any = true;
    }
    if (progress_[after].settled.passed() < step) return any;
    region.foresee(step, member.hold_until);
    member.profile.done(Profile::Phase::appointments);
    p.foreseen = step;
    any = true;
  }
  return any;
}

}  // namespace riesel
