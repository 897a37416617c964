// The memory layout of contacts for vector loops.
#pragma once

#include "engine/aligned.hpp"
#include "engine/contact.hpp"
#include "engine/fixed_point.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>

namespace riesel {

/// Sixteen contacts. Contact number i has lane i of each row: so all that a loop needs of a vector
/// of contacts is close together, at constant offsets. Lanes without a contact begin with zeros,
/// except in `body`, which names a body that may be read; what the loop makes of them is not used.
struct alignas(cache_line) ContactTile {
  static constexpr std::size_t lanes = 16;
  template <class T>
  using Row = std::array<T, lanes>;

  /// A vector in each lane, quanta.
  struct Vectors {
    Row<Fixed> x, y;

    FixedVector at(std::size_t lane) const { return {x[lane], y[lane]}; }
    void set(std::size_t lane, const FixedVector& v) {
      x[lane] = v.x;
      y[lane] = v.y;
    }
  };

  /// The members of BodyMotion for each lane.
  struct Motions {
    Vectors position, u, kick;
  };

  /// The life of a contact: the members of Contact that follow its name, all of them doubles.
  static constexpr std::size_t life_begin = offsetof(Contact, begin);
  static constexpr std::size_t life_members = (sizeof(Contact) - life_begin) / sizeof(double);
  static_assert(life_begin + life_members * sizeof(double) == sizeof(Contact));

  std::array<Row<std::int64_t>, 2> body;  ///< index of the first and the second body in Bodies
  /// At a wall the motion of the point that is touched; else that of the second grain relative to
  /// the first, which the loop carries on from step to step.
  Motions partner;
  Row<double> reach, reduced_mass;              ///< m, kg
  std::array<Row<double>, 2> per_mass, radius;  ///< 1/kg and m, of first and second
  std::array<Row<double>, life_members> life;   ///< see RIESEL_LIFE
  std::array<Row<Fixed>, 2> spin_kick;          ///< of first and second, in the last step
  /// Likewise. x and y stand side by side, as they are added to single grains.
  std::array<Row<FixedVector>, 2> kick;
};

/// Index of the row of a tile's `life` that holds this member of Contact.
#define RIESEL_LIFE(member)                                                                        \
  ((offsetof(Contact, member) - offsetof(Contact, begin)) / sizeof(double))

using Life = std::array<double, ContactTile::life_members>;

inline Life life_of(const Contact& contact) {
  Life life;
  std::memcpy(life.data(), reinterpret_cast<const std::byte*>(&contact) + ContactTile::life_begin,
              sizeof(life));
  return life;
}

using ContactTiles = AlignedVector<ContactTile>;

/// Calls visit(tile, lane) for the contacts begin <= i < end of `tiles`, const or not.
template <class Tile, class Visit>
[[gnu::always_inline]] inline void for_each_lane(std::span<Tile> tiles, std::size_t begin,
                                                 std::size_t end, Visit visit) {
  for (std::size_t i = begin; i < end;) {
    Tile& tile = tiles[i / ContactTile::lanes];
    const std::size_t lane = i % ContactTile::lanes;
    const std::size_t lanes = std::min(ContactTile::lanes - lane, end - i);
    for (std::size_t l = lane; l < lane + lanes; ++l) visit(tile, l);
    i += lanes;
  }
}

}  // namespace riesel
