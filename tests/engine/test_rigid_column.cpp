// Rigid beads that collide one after the other: by hand, and where they collapse.
#include "engine/rigid_column.hpp"
#include "tests/catch.hpp"

#include <cmath>
#include <numbers>

using namespace riesel;
using Catch::Matchers::WithinRel;

namespace {

/// The restitution below which a column of n collapses, by the wave that Bernu and Mazighi (1990)
/// follow through it; exact for two beads.
double threshold(int n) {
  const double t = std::tan(std::numbers::pi / 4.0 * (1.0 - 1.0 / n));
  return t * t;
}

}  // namespace

TEST_CASE("a rigid bead alone comes back with the restitution of the plate") {
  const RigidColumn one = rigid_column(1, 0.3, 0.8);
  CHECK_THAT(one.restitution, WithinRel(0.8, 1e-15));
  CHECK_THAT(one.rebound, WithinRel(0.8, 1e-15));
  CHECK(one.collisions == 1);
}

TEST_CASE("two rigid beads do as worked out by hand") {
  // Of e = 1/2 both: the lower bead comes back with 1/2 and meets -1: mean -1/4, half of the
  // difference -3/4, so that it leaves with -1/4 - 3/8 = -5/8, the upper one with 1/8. The plate
  // sends it back with 5/16, mean 7/32, half 3/32: 7/32 + 3/64 = 17/64 and 11/64 stay apart.
  const RigidColumn two = rigid_column(2, 0.5, 0.5);
  CHECK(two.collisions == 4);
  const double upper = 17.0 / 64.0, lower = 11.0 / 64.0;
  CHECK_THAT(two.rebound, WithinRel(0.5 * (upper + lower), 1e-14));
  CHECK_THAT(two.restitution, WithinRel(std::sqrt(0.5 * (upper * upper + lower * lower)), 1e-14));
}

TEST_CASE("elastic beads come back as they came") {
  const int n = GENERATE(1, 2, 7, 30);
  const RigidColumn elastic = rigid_column(n, 1.0, 1.0);
  CHECK_THAT(elastic.restitution, WithinRel(1.0, 1e-12));
  CHECK_THAT(elastic.rebound, WithinRel(1.0, 1e-12));
  CHECK(elastic.collisions == n * (n + 1) / 2);
}

TEST_CASE("a column collapses below the restitution of Bernu and Mazighi") {
  // For two beads (1 - e)^2 = 4 e, that is 3 - 2 sqrt(2); for more the wave is an estimate.
  CHECK_THAT(threshold(2), WithinRel(3.0 - 2.0 * std::numbers::sqrt2, 1e-14));
  const int n = GENERATE(2, 5, 10);
  const double e = threshold(n);
  CHECK(rigid_column(n, 0.98 * e, 0.98 * e).collapsed);
  CHECK(rigid_column(n, 0.98 * e, 0.98 * e).restitution == 0.0);
  CHECK_FALSE(rigid_column(n, 1.02 * e, 1.02 * e).collapsed);
}
