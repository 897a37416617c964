// One step of the contacts in tiles by vector instructions: from the motion of the bodies to the
// kicks and the updated lives of the contacts.
#pragma once

#include "engine/contact_law.hpp"
#include "engine/contact_tile.hpp"
#include "engine/encounter.hpp"
#include "engine/lane_masks.hpp"
#include "engine/meeting.hpp"

#include <cstddef>
#include <cstdint>
#include <span>

namespace riesel {

/// The kind of the second body of a contact.
enum class Partner { grain, wall };

/// The numbers of contacts in tiles, whose lanes they fill in order.
struct ContactCounts {
  std::size_t all;
  std::size_t followed;  ///< the first ones have been stepped before, the others added since
  std::size_t lasting;   ///< the first ones have begun before, the others begin in this step
};

/// What a step finds out about each contact, as bits in masks. Few contacts are stepped in blocks
/// of one vector of doubles, many in blocks of two (LaneMasks).
class ContactFindings {
public:
  /// Numbers of the findings: the bodies do not overlap any more; the kick is not finite or too
  /// large.
  static constexpr std::size_t apart = 0, unusable = 1;

  ContactFindings() { of_few_.resize(Few::lanes); }

  void resize(std::size_t tiles) { of_many_.resize(tiles * ContactTile::lanes); }
  /// Calls use(masks) with the masks for `count` contacts.
  template <class Use>
  void with_masks(std::size_t count, Use use) {
    if (count <= Few::lanes)
      use(of_few_);
    else
      use(of_many_);
  }

private:
  using Few = LaneMasks<std::uint64_t>;
  using Many = LaneMasks<std::uint32_t>;
  static_assert(Many::lanes == ContactTile::lanes);
  Few of_few_;
  Many of_many_;
};

/// Computes the kicks of this step, updates the lives and writes what it finds to `found`.
/// `bodies`, and the points of walls in the tiles, must be at the step of `units`. counts.all > 0.
void step_tiles(Partner partner, std::span<ContactTile> tiles, const ContactCounts& counts,
                const Bodies& bodies, const StepUnits& units, const ContactModel& model,
                ContactFindings& found);

/// Completes the life of a contact whose end no step sees: adds to its friction_loss what friction
/// took in its last step, and what is left in its spring. `meeting` must be that of meeting_of(),
/// with name.grain as the first body.
void add_last_loss(Contact& contact, const Meeting& meeting, const Bodies& bodies,
                   const SlipLaw& slip, const StepUnits& units);

}  // namespace riesel
