#include "io/state_columns.hpp"

namespace riesel::io {

std::vector<std::size_t> slots_by_id(const Grains& grains) {
  std::vector<std::size_t> slots(grains.size());
  for (std::size_t slot = 0; slot < grains.size(); ++slot) {
    slots[static_cast<std::size_t>(grains.id[slot])] = slot;
  }
  return slots;
}

}  // namespace riesel::io
