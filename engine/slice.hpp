// The share of one thread: a range of slots and all that is derived from it between two sortings.
#pragma once

#include "engine/aligned.hpp"
#include "engine/contact_batch.hpp"
#include "engine/contact_book.hpp"
#include "engine/fixed_point.hpp"
#include "engine/tally.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace riesel {

/// Pairs of slots that can touch before the next sorting, ordered by the first. Arrays of equal
/// size.
struct CandidatePairs {
  AlignedVector<std::uint32_t> first, second;
  AlignedVector<float>
      reach2;  ///< m^2, (sum of radii)^2 plus the resolution of the coarse positions

  std::size_t size() const { return first.size(); }
  void clear() {
    first.clear();
    second.clear();
    reach2.clear();
  }
  void add(std::uint32_t i, std::uint32_t j, float square) {
    first.push_back(i);
    second.push_back(j);
    reach2.push_back(square);
  }
};

/// A grain that can touch a wall before the next sorting.
struct NearWall {
  std::uint32_t slot;
  std::int32_t wall;
};

/// The place of a wall contact in the order of the search: by place in near_walls, then by wall
/// grain.
constexpr std::uint64_t wall_contact_key(std::size_t place, std::int32_t wall_grain) {
  return static_cast<std::uint64_t>(place) << 32 | static_cast<std::uint32_t>(wall_grain);
}

/// What one contact adds to the velocity of one grain in one step.
struct Kick {
  std::uint32_t slot;
  Fixed x, y;
};

struct Slice {
  std::size_t begin = 0, end = 0;  ///< slots
  CandidatePairs pairs;            ///< their first grain is in the slice, the second anywhere
  std::vector<NearWall> near_walls;

  std::vector<std::uint32_t> hits;       ///< indices of pairs that may overlap in this step
  std::vector<std::uint32_t> wall_hits;  ///< indices of near_walls that may touch in this step
  ContactBatch batch;                    ///< the contacts that are being resolved
  ContactBook pair_contacts;
  ContactBook wall_contacts;
  std::vector<Kick> kicks;     ///< of this step, by contacts of the slice on grains of any slice
  std::vector<Kick> received;  ///< of this step, by contacts of any slice on grains of the slice
  double fastest2 = 0.0;  ///< (m per step)^2, bound on the own grains' speeds relative to the drift
  double farthest = 0.0;  ///< m, largest own displacement relative to the drift since the sorting
  double budget = 0.0;    ///< m, displacement that leaves the candidates valid; equal in all slices

  Tally tally;                         ///< of contacts that began or ended in the last advance
  std::optional<ContactName> trouble;  ///< a contact whose force is no usable number
  std::optional<std::int32_t> lost;    ///< id of a grain that has left the representable space
};

}  // namespace riesel
