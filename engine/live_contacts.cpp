#include "engine/live_contacts.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <type_traits>

namespace riesel {

namespace {

/// Converts between the friction on name.grain and that on the first body, where these differ. 0 -
/// x instead of -x, which would make -0 of 0.
void see_from_the_other(Contact& contact) {
  contact.friction_x = 0.0 - contact.friction_x;
  contact.friction_y = 0.0 - contact.friction_y;
  contact.rolling_torque = 0.0 - contact.rolling_torque;
}

/// Moves the content of a lane to another one and leaves zeros.
void move_lane(ContactTile& from, std::size_t lane, ContactTile& to, std::size_t new_lane) {
  using Row = ContactTile::Row<std::uint64_t>;  // all rows before the kicks are of 64-bit words
  constexpr std::size_t end = offsetof(ContactTile, kick);
  static_assert(std::is_trivially_copyable_v<ContactTile> && end % sizeof(Row) == 0);
  auto* const old_words = reinterpret_cast<std::byte*>(&from) + lane * sizeof(std::uint64_t);
  auto* const new_words = reinterpret_cast<std::byte*>(&to) + new_lane * sizeof(std::uint64_t);
  for (std::size_t row = 0; row < end; row += sizeof(Row)) {
    std::uint64_t word = 0;
    std::memcpy(&word, old_words + row, sizeof(word));
    std::memcpy(new_words + row, &word, sizeof(word));
    std::memset(old_words + row, 0, sizeof(word));
  }
  for (std::size_t body = 0; body < from.kick.size(); ++body) {
    to.kick[body][new_lane] = from.kick[body][lane];
    from.kick[body][lane] = {};
  }
}

}  // namespace

Contact LiveContacts::contact(std::size_t i) const {
  Contact contact{.name = meetings_[i].name};
  // Each word is written where it stays. By way of an array, which is copied in wider words, the
  // copy would have to wait until the narrower stores are complete.
  auto* const life = reinterpret_cast<std::byte*>(&contact) + ContactTile::life_begin;
  for (std::size_t m = 0; m < ContactTile::life_members; ++m)
    std::memcpy(life + m * sizeof(double), &tile(i).life[m][lane(i)], sizeof(double));
  if (meetings_[i].turned) see_from_the_other(contact);
  return contact;
}

/// Removes the kicks and all numbers that are not finite from contact `i`, so that the state that
/// is left by a run that fails can be kept and inspected.
void LiveContacts::make_harmless(std::size_t i) {
  ContactTile& t = tile(i);
  for (auto& kicks : t.kick) kicks[lane(i)] = {};
  for (auto& kicks : t.spin_kick) kicks[lane(i)] = 0;
  for (auto& member : t.life)
    if (!std::isfinite(member[lane(i)])) member[lane(i)] = 0.0;
}

/// Updates the points of walls: those of smooth walls follow their grains, those of moving walls
/// the walls.
void LiveContacts::follow_walls(const Bodies& bodies, const StepUnits& units) {
  for (std::size_t i = 0; i < size(); ++i) {
    const BodyMotion point = wall_point(meetings_[i], bodies, first(i), units);
    ContactTile::Motions& points = tile(i).partner;
    points.position.set(lane(i), point.position);
    points.u.set(lane(i), point.u);
    points.kick.set(lane(i), point.kick);
  }
}

void LiveContacts::pad_with(std::int64_t place) {
  padding_body_ = place;
  for (std::size_t i = size(); i < tiles_.size() * ContactTile::lanes; ++i) move(i, place, place);
}

void LiveContacts::clear() {
  meetings_.clear();
  beginning_ = followed_ = 0;
  any_level_ = false;
  tiles_.clear();
}

void LiveContacts::add(const Meeting& meeting, const Contact& contact) {
  const std::size_t i = size();
  meetings_.push_back(meeting);
  any_level_ = any_level_ || meeting.level;
  if (i == tiles_.size() * ContactTile::lanes) {
    for (auto& bodies : tiles_.emplace_back().body) bodies.fill(padding_body_);
    found_.resize(tiles_.size());
  }
  ContactTile& t = tile(i);
  const std::size_t l = lane(i);
  move(i, meeting.first, meeting.second);
  t.partner.position.set(l, {meeting.line, meeting.y});
  t.reach[l] = meeting.reach();
  t.reduced_mass[l] = meeting.reduced_mass();
  const BodyPair bodies = meeting.bodies();
  t.per_mass[0][l] = bodies.per_mass_first;
  t.per_mass[1][l] = bodies.per_mass_second;
  t.radius[0][l] = bodies.radius_first;
  t.radius[1][l] = bodies.radius_second;
  Contact seen = contact;
  if (meeting.turned) see_from_the_other(seen);
  const auto life = life_of(seen);
  for (std::size_t m = 0; m < life.size(); ++m) t.life[m][l] = life[m];
}

void LiveContacts::remove(std::size_t i) {
  const std::size_t last = size() - 1;
  meetings_[i] = meetings_[last];
  meetings_.pop_back();
  --followed_;
  move_lane(tile(last), lane(last), tile(i), lane(i));
  move(last, padding_body_, padding_body_);
}

void LiveContacts::step(const Bodies& bodies, const StepUnits& units, const ContactModel& model) {
  ended_.clear();
  trouble_.reset();
  if (size() == 0) return;
  if (any_level_ || (partner_ == Partner::wall && units.walls_move)) follow_walls(bodies, units);
  step_tiles(partner_, tiles_, {size(), followed_, size() - beginning_}, bodies, units, model,
             found_);
  beginning_ = 0;
  followed_ = size();
  turning_ = bodies.rotate();
  found_.with_masks(size(), [&](const auto& masks) {
    masks.for_each_found(
        size(), [&](std::size_t i) { ended_.push_back(i); }, ContactFindings::apart);
    masks.for_each_found(
        size(),
        [&](std::size_t i) {
          trouble_ = first_of(trouble_, meetings_[i].name);
          make_harmless(i);
        },
        ContactFindings::unusable);
  });
  std::reverse(ended_.begin(), ended_.end());
}

}  // namespace riesel
