// The contacts of one slice in one step, side by side, so that their forces are computed by vector
// instructions.
#pragma once

#include "engine/aligned.hpp"
#include "engine/contact.hpp"
#include "engine/contact_force.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace riesel {

/// The second body of a contact with a wall.
inline constexpr std::uint32_t no_slot = UINT32_MAX;

class ContactBatch {
public:
  /// Whose contact it is.
  struct Who {
    std::uint64_t key;  ///< place in the order of the search
    ContactName name;
    std::uint32_t first;   ///< slot
    std::uint32_t second;  ///< slot, or no_slot for a wall grain
  };

  void clear() { who_.clear(); }
  void add(const Who& who, const Encounter& encounter);

  /// Computes all contacts.
  void touch_all(const ContactModel& model, double dt);

  std::size_t size() const { return who_.size(); }
  const Who& who(std::size_t i) const { return who_[i]; }
  Touch touch(std::size_t i) const;

private:
  static constexpr std::size_t inputs = sizeof(Encounter) / sizeof(double);
  static constexpr std::size_t outputs = sizeof(Touch) / sizeof(double);

  std::vector<Who> who_;
  std::array<AlignedVector<double>, inputs> input_;    // one array for each member of Encounter
  std::array<AlignedVector<double>, outputs> output_;  // and of Touch
};

}  // namespace riesel
