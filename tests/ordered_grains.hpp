// Grains as they were put in, however they have been sorted since.
#pragma once

#include "engine/state.hpp"

#include <cstddef>
#include <vector>

namespace riesel {

/// A copy in which the slots are ordered by id.
inline Grains ordered_by_id(const Grains& grains) {
  Grains ordered = grains;
  const std::vector<std::size_t> slots = slots_by_id(grains);
  for_each_array_of(ordered, [&](auto& array) {
    const auto by_slot = array;
    for (std::size_t id = 0; id < slots.size(); ++id) array[id] = by_slot[slots[id]];
  });
  return ordered;
}

}  // namespace riesel
