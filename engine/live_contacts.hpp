// The contacts that last: stepped from beginning to end in place, side by side, by vector
// instructions.
//
// Whoever steps the grains finds out which contacts begin; from then on nobody looks for them. A
// contact costs its force and the book-keeping of its life, both in one loop over tiles, and its
// end is noticed there.
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

  /// Tiles are filled up with lanes that are no contacts. These look at the body in this place
  /// instead of the first of all, which others may be changing.
  void pad_with(std::int64_t place);

  std::size_t size() const { return meetings_.size(); }
  const Meeting& meeting(std::size_t i) const { return meetings_[i]; }
  Contact contact(std::size_t i) const;
  std::int64_t first(std::size_t i) const { return tile(i).body[0][lane(i)]; }
  std::int64_t second(std::size_t i) const { return tile(i).body[1][lane(i)]; }
  /// What the last step() gives to the bodies.
  BodyKick kick_of_first(std::size_t i) const { return kick_of(tile(i), 0, lane(i)); }
  BodyKick kick_of_second(std::size_t i) const { return kick_of(tile(i), 1, lane(i)); }
  /// Calls give(place, kick) for all of them.
  template <class Give>
  void for_each_kick(Give give) const {
    if (turning_)
      give_kicks<true>(give);
    else
      give_kicks<false>(give);
  }

  void clear();
  /// A contact that lasts already.
  void add(const Meeting& meeting, const Contact& contact);
  /// A contact that begins in the step that is done next.
  void begin(const Meeting& meeting) {
    add(meeting, {.name = meeting.name});
    ++beginning_;
  }
  /// Its bodies stand elsewhere now.
  void move(std::size_t i, std::int64_t first, std::int64_t second) {
    tile(i).body[0][lane(i)] = first;
    tile(i).body[1][lane(i)] = second;
  }

  /// Computes the kicks of this step and carries the lives on. `bodies` are at the step of `units`.
  /// What has ended then stands in ended() and gives no kick.
  void step(const Bodies& bodies, const StepUnits& units, const ContactModel& model);

  /// Indices of the contacts that the last step() found apart, decreasing; to be removed in this
  /// order before the next.
  const std::vector<std::size_t>& ended() const { return ended_; }
  /// The last contact takes the place of contact `i`.
  void remove(std::size_t i);

  /// The first by name of the contacts whose kick in the last step() was no usable number, so that
  /// it gave none.
  const std::optional<ContactName>& trouble() const { return trouble_; }

private:
  ContactTile& tile(std::size_t i) { return tiles_[i / ContactTile::lanes]; }
  const ContactTile& tile(std::size_t i) const { return tiles_[i / ContactTile::lanes]; }
  static std::size_t lane(std::size_t i) { return i % ContactTile::lanes; }
  template <bool turning = true>
  static BodyKick kick_of(const ContactTile& tile, std::size_t body, std::size_t lane) {
    return {tile.kick[body].at(lane), turning ? tile.spin_kick[body][lane] : 0};
  }
  template <bool turning, class Give>
  void give_kicks(Give give) const {
    for_each_lane(std::span(tiles_), 0, size(), [&](const ContactTile& tile, std::size_t lane) {
      give(tile.body[0][lane], kick_of<turning>(tile, 0, lane));
      if (partner_ == Partner::grain) give(tile.body[1][lane], kick_of<turning>(tile, 1, lane));
    });
  }
  void make_harmless(std::size_t i);
  void follow_walls(const Bodies& bodies, const StepUnits& units);

  Partner partner_;
  std::size_t beginning_ = 0;  // contacts at the end that begin in the next step
  std::size_t followed_ = 0;   // so many have been stepped; the others have been added since
  bool any_level_ = false;     // with smooth walls
  bool turning_ = false;       // the bodies rotate
  std::vector<Meeting> meetings_;
  std::int64_t padding_body_ = 0;
  ContactTiles tiles_;
  ContactFindings found_;  // by the last step
  std::vector<std::size_t> ended_;
  std::optional<ContactName> trouble_;
};

}  // namespace riesel
