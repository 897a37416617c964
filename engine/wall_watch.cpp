#include "engine/wall_watch.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

namespace riesel {

namespace {

constexpr double never = std::numeric_limits<double>::infinity();

bool earlier(const WallVisit& a, const WallVisit& b) {
  return std::tie(a.wall, a.grain, a.span.begin) < std::tie(b.wall, b.grain, b.span.begin);
}

bool same_visitor(const WallVisit& a, const WallVisit& b) {
  return a.wall == b.wall && a.grain == b.grain;
}

/// s, when the first of the lasting contacts of this grain with this wall began; `never` if there
/// is none.
double lasting_since(const State& state, const WallVisit& visit) {
  const ContactName lowest{visit.wall, visit.grain, std::numeric_limits<std::int32_t>::min()};
  auto contact =
      std::lower_bound(state.contacts.begin(), state.contacts.end(), lowest,
                       [](const Contact& c, const ContactName& name) { return c.name < name; });
  double since = never;
  for (; contact != state.contacts.end() && contact->name.wall == visit.wall
         && contact->name.grain == visit.grain;
       ++contact)
    since = std::min(since, contact->begin);
  return since;
}

}  // namespace

WallWatch::WallWatch(const State& state, const ContactModel& model)
    : model_(model), mass_(state.grains.size()) {
  for (std::size_t slot = 0; slot < mass_.size(); ++slot)
    mass_[static_cast<std::size_t>(state.grains.id[slot])] = state.grains.mass[slot];
}

void WallWatch::look(State& state) const {
  take_up(state);
  join_and_close(state);
}

void WallWatch::take_up(State& state) const {
  std::vector<WallVisit>& visits = state.open_visits;
  const auto old = static_cast<std::ptrdiff_t>(visits.size());
  const double gravity = std::hypot(state.gravity.x, state.gravity.y);
  for (const Contact& contact : state.tally.ended_at_walls) {
    const double m = mass(contact.name.grain);
    const WallLattice& wall = state.wall(contact.name.wall);
    state.tally.brakes.add(contact, model_, m, wall.smooth());
    visits.emplace_back(contact, visit_span(contact, m, wall.spacing(state.box), gravity));
  }
  state.tally.ended_at_walls.clear();
  std::sort(visits.begin() + old, visits.end(), earlier);
  std::inplace_merge(visits.begin(), visits.begin() + old, visits.end(), earlier);
}

void WallWatch::join_and_close(State& state) const {
  std::vector<WallVisit>& visits = state.open_visits;
  auto kept = visits.begin();
  for (auto next = visits.begin(); next != visits.end();) {
    WallVisit visit = *next++;
    // A lasting contact will join all whose spans end after it began.
    const double lasting = lasting_since(state, visit);
    while (next != visits.end() && same_visitor(*next, visit)
           && std::min(next->span.begin, lasting) <= visit.span.end)
      visit.join(*next++);
    // A contact that is found in the next step may have begun up to a step before now.
    const bool over = visit.span.end < std::min(state.time() - state.time_step, lasting);
    if (over)
      close(state, visit);
    else
      *kept++ = visit;
  }
  visits.erase(kept, visits.end());
}

void WallWatch::close(State& state, const WallVisit& visit) const {
  const WallLattice& wall = state.wall(visit.wall);
  state.tally.visits.add(visit, mass(visit.grain), wall.inwards(state.box));
}

}  // namespace riesel
