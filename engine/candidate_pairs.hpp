// Pairs of grains that may come to touch.
#pragma once

#include "engine/aligned.hpp"

#include <cmath>
#include <cstddef>
#include <cstdint>

namespace riesel {

struct SlotPair {
  std::uint32_t first, second;
};

/// Pairs of slots that can touch before the next sorting, ordered by `first`, except that pairs
/// added later stand at the end. Arrays of equal size.
struct CandidatePairs {
  AlignedVector<std::uint32_t> first, second;
  /// Whether each step searches them for overlaps. If not, reach2 is empty, which saves a third of
  /// the memory.
  bool searched = true;
  /// m^2, CoarseUnits::generous_square() of the sum of radii; negative while the pair is in
  /// contact, so that the search does not find it.
  AlignedVector<float> reach2;

  std::size_t size() const { return first.size(); }
  /// Whether it has the pair, in either order. Linear search.
  bool has(std::uint32_t i, std::uint32_t j) const {
    for (std::size_t p = 0; p < size(); ++p)
      if ((first[p] == i && second[p] == j) || (first[p] == j && second[p] == i)) return true;
    return false;
  }
  std::size_t capacity() const { return first.capacity(); }
  void clear() {
    first.clear();
    second.clear();
    reach2.clear();
  }
  void reserve(std::size_t n) {
    first.reserve(n);
    second.reserve(n);
    if (searched) reach2.reserve(n);
  }
  void resize(std::size_t n) {
    first.resize(n);
    second.resize(n);
    if (searched) reach2.resize(n);
  }
  void set(std::size_t pair, std::uint32_t i, std::uint32_t j, float square) {
    first[pair] = i;
    second[pair] = j;
    if (searched) reach2[pair] = square;
  }
  void add(std::uint32_t i, std::uint32_t j, float square) {
    first.push_back(i);
    second.push_back(j);
    if (searched) reach2.push_back(square);
  }
  void set_copy(std::size_t pair, const CandidatePairs& of, std::size_t copied) {
    set(pair, of.first[copied], of.second[copied], of.reach2[copied]);
  }
  void add_copy(const CandidatePairs& of, std::size_t pair) {
    add(of.first[pair], of.second[pair], of.reach2[pair]);
  }
  void begin_contact(std::size_t pair) {
    if (searched) reach2[pair] = -std::abs(reach2[pair]);
  }
  void end_contact(std::size_t pair) {
    if (searched) reach2[pair] = std::abs(reach2[pair]);
  }
};

}  // namespace riesel
