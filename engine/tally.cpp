#include "engine/tally.hpp"

#include <algorithm>
#include <tuple>

namespace riesel {

namespace {

/// Whether `a` is deeper than `b`; of equals, whether it is the first by name, then the earlier.
bool comes_before(const Contact& a, const Contact& b) {
  return a.max_overlap != b.max_overlap ? a.max_overlap > b.max_overlap
                                        : std::tie(a.name, a.begin) < std::tie(b.name, b.begin);
}

/// Notes `contact` if it comes before the deepest one of the tally so far.
void note_deepest(ContactTally& tally, const Contact& contact) {
  if (contact.max_overlap < tally.max_overlap) return;
  if (!tally.deepest || comes_before(contact, *tally.deepest)) tally.deepest = contact;
  tally.max_overlap = contact.max_overlap;
}

}  // namespace

void ContactTally::add(const Contact& contact) {
  note_deepest(*this, contact);
  duration.add(contact.duration());
  slip_path.add(contact.slip_path);
  normal_loss.add(contact.normal_loss);
  friction_loss.add(contact.friction_loss);
  energy_won.add(std::max(0.0, -(contact.normal_loss + contact.friction_loss)));
  impulse_y.add(contact.impulse_y);
  impulse_y_times_time.add(contact.impulse_y_times_time / era);
}

void ContactTally::merge(const ContactTally& other) {
  begun += other.begun;
  ended += other.ended;
  if (other.deepest) note_deepest(*this, *other.deepest);
  duration.add(other.duration);
  slip_path.add(other.slip_path);
  normal_loss.add(other.normal_loss);
  friction_loss.add(other.friction_loss);
  energy_won.add(other.energy_won);
  impulse_y.add(other.impulse_y);
  impulse_y_times_time.add(other.impulse_y_times_time);
  durations.merge(other.durations);
  overlaps.merge(other.overlaps);
}

void WallImpulses::merge(const WallImpulses& other) {
  for (std::size_t wall = 0; wall < most_walls; ++wall) {
    x[wall].add(other.x[wall]);
    y[wall].add(other.y[wall]);
  }
  work.add(other.work);
}

void StepTally::end(const Contact& contact, double reach) {
  ContactTally& kind = of(contact.name);
  ++kind.ended;
  kind.add(contact);
  kind.durations.add(contact.duration());
  kind.overlaps.add(contact.max_overlap / reach);
  if (contact.name.wall == no_wall) return;
  impulses.add(contact);
  ended_at_walls.push_back(contact);
}

void StepTally::merge(const StepTally& other) {
  grains.merge(other.grains);
  walls.merge(other.walls);
  impulses.merge(other.impulses);
  ended_at_walls.insert(ended_at_walls.end(), other.ended_at_walls.begin(),
                        other.ended_at_walls.end());
}

}  // namespace riesel
