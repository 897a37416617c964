// The present contacts of a slice: each stays in a lane of a tile from beginning to end, where
// vector instructions step it.
//
// Plain stepping or flights find out which contacts begin; from then on no search looks for them.
// One loop over the tiles computes the forces, updates the lives and notices which contacts end.
#pragma once

#include "engine/contact.hpp"
#include "engine/contact_kernel.hpp"
#include "engine/contact_law.hpp"
#include "engine/contact_tile.hpp"
#include "engine/meeting.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace riesel {

class LiveContacts {
public:
  explicit LiveContacts(Partner partner) : partner_(partner) {}

  /// Sets the body that lanes without a contact read: one of this slice, as another thread may be
  /// writing to body 0.
  void pad_with(std::int64_t place);

  std::size_t size() const { return meetings_.size(); }
  const Meeting& meeting(std::size_t i) const { return meetings_[i]; }
  Contact contact(std::size_t i) const;
  std::int64_t first(std::size_t i) const { return tile(i).body[0][lane(i)]; }
  std::int64_t second(std::size_t i) const { return tile(i).body[1][lane(i)]; }
  /// The kick that contact i gives to its first, or second, body in the last step().
  BodyKick kick_of_first(std::size_t i) const { return kick_of(tile(i), 0, lane(i)); }
  BodyKick kick_of_second(std::size_t i) const { return kick_of(tile(i), 1, lane(i)); }
  /// Calls give(place, kick) for the kicks of all contacts; `place` is the index in Bodies.
  template <class Give>
  [[gnu::always_inline]] void for_each_kick(Give& give) const {
    if (turning_)
      give_kicks<true>(give);
    else
      give_kicks<false>(give);
  }

  void clear();
  /// Adds a contact that has begun before.
  void add(const Meeting& meeting, const Contact& contact);
  /// Adds a contact that begins in the next step().
  void begin(const Meeting& meeting) {
    add(meeting, {.name = meeting.name});
    ++beginning_;
  }
  /// Tells where the bodies of contact i are in Bodies from now on.
  void move(std::size_t i, std::int64_t first, std::int64_t second) {
    tile(i).body[0][lane(i)] = first;
    tile(i).body[1][lane(i)] = second;
  }

  /// Computes the kicks of this step and updates the lives. `bodies` must be at the step of
  /// `units`. Contacts that have ended are then in ended() and give no kick.
  void step(const Bodies& bodies, const StepUnits& units, const ContactModel& model);

  /// Indices of the contacts that the last step() found apart, decreasing. They must be removed in
  /// this order before anything else is added or stepped.
  const std::vector<std::size_t>& ended() const { return ended_; }
  /// Removes contact `i`. The last contact gets its index.
  void remove(std::size_t i);

  /// The first by name of the contacts whose kick in the last step() was not finite or too large:
  /// these gave no kick.
  const std::optional<ContactName>& trouble() const { return trouble_; }

private:
  ContactTile& tile(std::size_t i) { return tiles_[i / ContactTile::lanes]; }
  const ContactTile& tile(std::size_t i) const { return tiles_[i / ContactTile::lanes]; }
  static std::size_t lane(std::size_t i) { return i % ContactTile::lanes; }
  template <bool turning = true>
  [[gnu::always_inline]] static BodyKick kick_of(const ContactTile& tile, std::size_t body,
                                                 std::size_t lane) {
    return {tile.kick[body][lane], turning ? tile.spin_kick[body][lane] : 0};
  }
  template <bool turning, class Give>
  [[gnu::always_inline]] void give_kicks(Give& give) const {
    const bool has_second = partner_ == Partner::grain;
    for_each_lane(std::span(tiles_), 0, size(), [&](const ContactTile& tile, std::size_t lane) {
      give(tile.body[0][lane], kick_of<turning>(tile, 0, lane));
      if (has_second) give(tile.body[1][lane], kick_of<turning>(tile, 1, lane));
    });
  }
  void make_harmless(std::size_t i);
  void follow_walls(const Bodies& bodies, const StepUnits& units);

  Partner partner_;
  std::size_t beginning_ = 0;  // contacts at the end that begin in the next step
  std::size_t followed_ = 0;   // the first ones have been stepped; the others added since
  bool any_level_ = false;     // some contact is with a smooth wall
  bool turning_ = false;       // the bodies rotate
  std::vector<Meeting> meetings_;
  std::int64_t padding_body_ = 0;
  ContactTiles tiles_;
  ContactFindings found_;  // by the last step
  std::vector<std::size_t> ended_;
  std::optional<ContactName> trouble_;
};

}  // namespace riesel
