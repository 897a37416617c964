// One step of the contacts of tiles: from where the bodies are to kicks and longer lives, by vector
// instructions.
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

/// What the second body of a contact is.
enum class Partner { grain, wall };

/// The contacts of tiles, which fill their lanes in order.
struct ContactCounts {
  std::size_t all;
  std::size_t followed;  ///< those before have been stepped, the others added since
  std::size_t lasting;   ///< those before last already, the others begin in this step
};

/// What a step finds of each contact: a vector of masks serves so few, or there are more.
class ContactFindings {
public:
  /// No overlap any more; a kick that is no usable number.
  static constexpr std::size_t apart = 0, unusable = 1;

  ContactFindings() { of_few_.resize(Few::lanes); }

  void resize(std::size_t tiles) { of_many_.resize(tiles * ContactTile::lanes); }
  /// Calls use(masks) with those that serve `count` contacts.
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

/// Computes the kicks of this step, carries the lives on and tells what it finds.
/// `bodies` are at the step of `units`; the points of walls must be so, too. There is a contact.
void step_tiles(Partner partner, std::span<ContactTile> tiles, const ContactCounts& counts,
                const Bodies& bodies, const StepUnits& units, const ContactModel& model,
                ContactFindings& found);

/// For a contact that no step sees the end of: what friction took in its last step, and what is
/// left in its spring. The meeting is that of name.grain and its partner, as meeting_of() has it.
void add_last_loss(Contact& contact, const Meeting& meeting, const Bodies& bodies,
                   const SlipLaw& slip, const StepUnits& units);

}  // namespace riesel
