#include "engine/wall_watch.hpp"

#include <algorithm>
#include <iterator>
#include <limits>
#include <span>
#include <tuple>

namespace riesel {

namespace {

auto visitor(const Contact& c) { return std::tie(c.name.wall, c.name.grain); }

bool earlier(const Contact& a, const Contact& b) {
  return std::tie(a.name.wall, a.name.grain, a.begin, a.name.partner)
         < std::tie(b.name.wall, b.name.grain, b.begin, b.name.partner);
}

/// Whether a contact that is not in the list of the ended ones may belong to a visit that reaches
/// until then.
bool may_go_on(const State& state, const ContactName& of, double until) {
  // A contact that is seen in the next step may have begun up to a step ago.
  if (state.time() <= until + state.time_step) return true;
  const ContactName lowest{of.wall, of.grain, std::numeric_limits<std::int32_t>::min()};
  auto lasting =
      std::lower_bound(state.contacts.begin(), state.contacts.end(), lowest,
                       [](const Contact& c, const ContactName& name) { return c.name < name; });
  for (; lasting != state.contacts.end() && lasting->name.wall == of.wall
         && lasting->name.grain == of.grain;
       ++lasting)
    if (lasting->begin <= until) return true;
  return false;
}

}  // namespace

WallWatch::WallWatch(const State& state, const ContactModel& model)
    : model_(model), mass_(state.grains.size()) {
  for (std::size_t slot = 0; slot < mass_.size(); ++slot)
    mass_[static_cast<std::size_t>(state.grains.id[slot])] = state.grains.mass[slot];
}

double WallWatch::mass(const Contact& contact) const {
  return mass_[static_cast<std::size_t>(contact.name.grain)];
}

void WallWatch::look(State& state) const {
  take_up(state);
  close_visits(state);
}

void WallWatch::take_up(State& state) const {
  std::vector<Contact>& ended = state.tally.ended_at_walls;
  for (const Contact& contact : ended) state.tally.brakes.add(contact, model_, mass(contact));
  std::sort(ended.begin(), ended.end(), earlier);
  const auto old = static_cast<std::ptrdiff_t>(state.visiting.size());
  state.visiting.insert(state.visiting.end(), ended.begin(), ended.end());
  std::inplace_merge(state.visiting.begin(), state.visiting.begin() + old, state.visiting.end(),
                     earlier);
  ended.clear();
}

void WallWatch::close_visits(State& state) const {
  std::vector<Contact>& contacts = state.visiting;
  auto kept = contacts.begin();
  for (auto first = contacts.begin(); first != contacts.end();) {
    const WallLattice& wall = state.walls[static_cast<std::size_t>(first->name.wall)];
    const double spacing = wall.spacing(state.box), m = mass(*first);
    const auto until = [&](const Contact& c) {
      return visit_span(c, m, spacing, state.gravity).end;
    };
    double end = until(*first);
    auto last = std::next(first);
    for (; last != contacts.end() && visitor(*last) == visitor(*first) && last->begin <= end;
         ++last)
      end = std::max(end, until(*last));
    if (may_go_on(state, first->name, end)) {
      kept = std::move(first, last, kept);
    } else {
      const double away = wall.line < 0.5 * state.box.width ? 1.0 : -1.0;
      state.tally.visits.add(std::span(first, last), m, away);
    }
    first = last;
  }
  contacts.erase(kept, contacts.end());
}

}  // namespace riesel
