#include "scenarios/packing.hpp"

#include "engine/closed_forms.hpp"
#include "engine/observables.hpp"
#include "engine/random.hpp"
#include "engine/simulation.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace riesel::scenarios {

namespace {

/// Columns of sites along y, every second column shifted by half a spacing.
struct Lattice {
  std::size_t columns, rows;
  double x_first, x_spacing, y_spacing;  // m

  std::size_t sites() const { return columns * rows; }
  Place site(std::size_t k) const {
    const std::size_t row = k / columns, column = k % columns;
    const double shift = column % 2 == 0 ? 0.25 : 0.75;
    return {x_first + static_cast<double>(column) * x_spacing,
            (static_cast<double>(row) + shift) * y_spacing};
  }
  /// Smallest distance of two sites: m.
  double closest() const {
    const double along = y_spacing;
    const double across = std::hypot(x_spacing, 0.5 * y_spacing);
    const double second_column = 2.0 * x_spacing;
    return columns == 1   ? along
           : columns == 2 ? std::min(along, across)
                          : std::min({along, across, second_column});
  }
};

/// The lattice with room for n grains whose sites are farthest apart. `radius` (m) keeps the outer
/// columns off the walls.
Lattice widest_lattice(const State& empty, std::size_t n, double radius) {
  const auto [left, right] = std::ranges::minmax(empty.walls, {}, &WallLattice::line);
  const double width = empty.box.width - ((left.radius + radius) + (right.radius + radius));
  const double middle = 0.5 * empty.box.width + 0.5 * (left.radius - right.radius);
  Lattice best{};
  for (std::size_t columns = 1; columns <= n; ++columns) {
    const std::size_t rows = (n + columns - 1) / columns;
    const Lattice lattice{.columns = columns,
                          .rows = rows,
                          .x_first = columns == 1 ? middle : left.radius + radius,
                          .x_spacing =
                              columns == 1 ? 0.0 : width / static_cast<double>(columns - 1),
                          .y_spacing = empty.box.length / static_cast<double>(rows)};
    if (best.columns == 0 || lattice.closest() > best.closest()) best = lattice;
    if (columns > 1 && 2.0 * lattice.x_spacing < best.closest()) break;  // more are ever narrower
  }
  return best;
}

/// n sites of the lattice, chosen at random, in the order of the sites.
std::vector<Place> occupied_sites(const Lattice& lattice, std::size_t n, std::uint64_t seed) {
  const RandomStream stream(seed, Use::vacancy);
  std::vector<std::pair<double, std::size_t>> lots(lattice.sites());
  for (std::size_t k = 0; k < lots.size(); ++k) lots[k] = {stream.uniform(k)[0], k};
  const auto end = lots.begin() + static_cast<std::ptrdiff_t>(n);
  std::nth_element(lots.begin(), end - 1, lots.end());
  std::vector<std::size_t> chosen;
  std::transform(lots.begin(), end, std::back_inserter(chosen),
                 [](auto& lot) { return lot.second; });
  std::sort(chosen.begin(), chosen.end());

  std::vector<Place> places;
  for (const std::size_t k : chosen) places.push_back(lattice.site(k));
  return places;
}

/// Lets soft grains push each other apart. Their radii are slightly inflated, so that a slight
/// overlap that remains is none of the true radii. Stepped plainly and by one thread on all
/// machines, as the step in which a grain pressed far out of the tube is noticed depends on that.
class Relaxation {
public:
  Relaxation(const State& empty, const std::vector<Place>& places, const std::vector<double>& radii)
      : radii_(radii),
        // Slices that go askew (docs/architecture-parallel.md) fail if a grain is thrown far.
        simulation_(start(empty, places, radii), model(), 1, Stepping::plain, Askew::never()) {}

  void push_for_a_while() { simulation_.advance(steps_per_round); }

  /// False if overlaps remain, or if grains were pressed out of the tube.
  bool succeeds() {
    for (int attempt = 0; attempt < max_rounds; ++attempt) {
      push_for_a_while();
      if (largest_overlap() < tolerated_overlap()) return !grain_outside(simulation_.state());
    }
    return false;
  }

  std::vector<Place> places() const {
    const State& state = simulation_.state();
    const GrainView grains(state);
    std::vector<Place> places(radii_.size());
    for (std::size_t slot = 0; slot < places.size(); ++slot) {
      const Grain grain = grains[slot];
      places[static_cast<std::size_t>(state.grains.id[slot])] = {grain.x, grain.y};
    }
    return places;
  }

private:
  static constexpr double inflation = 2e-3;
  static constexpr double restitution = 0.1;  // with pull; without, as here, it is 0.25
  static constexpr double steps_per_collision = 30.0;
  static constexpr std::int64_t steps_per_round = 500;
  static constexpr int max_rounds = 200;
  // The values do not matter: together they only set the unit of time.
  static constexpr double stiffness = 1.0, mass = 1.0;

  static ContactModel model() {
    return {.normal = LinearLaw{stiffness, damping_for_restitution(restitution, stiffness,
                                                                   0.5 * mass, Attraction::keep)},
            .slip = CappedSlip{},
            .friction = 0.0,
            .attraction = Attraction::clip};
  }

  static State start(const State& empty, const std::vector<Place>& places,
                     const std::vector<double>& radii) {
    State state = empty;
    state.gravity = {};
    for (WallLattice& wall : state.walls) wall.motion = {};  // time here is not that of the run
    state.time_step = collision_time(model().normal, 0.5 * mass, 0.0) / steps_per_collision;
    for (std::size_t i = 0; i < places.size(); ++i)
      add_grain(state, {.x = places[i].x,
                        .y = places[i].y,
                        .vx = 0.0,
                        .vy = 0.0,
                        .radius = radii[i] * (1.0 + inflation),
                        .mass = mass});
    return state;
  }

  double largest_overlap() const {
    double largest = 0.0;
    for (const Contact& contact : simulation_.state().contacts)
      largest = std::max(largest, contact.overlap);
    return largest;
  }

  /// m: half of what inflation adds to the sum of the radii of the smallest pair.
  double tolerated_overlap() const {
    return inflation * *std::min_element(radii_.begin(), radii_.end());
  }

  const std::vector<double>& radii_;
  Simulation simulation_;
};

/// The places after relaxation; nothing if it does not succeed.
std::optional<std::vector<Place>> pushed_apart(const State& empty, const std::vector<Place>& places,
                                               const std::vector<double>& radii) {
  try {
    Relaxation relaxation(empty, places, radii);
    if (relaxation.succeeds()) return relaxation.places();
  } catch (const RunFailure&) {
    // pressed out of the tube
  }
  return std::nullopt;
}

std::vector<double> scaled(const std::vector<double>& radii, double scale) {
  std::vector<double> all = radii;
  for (double& radius : all) radius *= scale;
  return all;
}

/// The same room with planes at the tips of the wall grains in place of these: grains that are
/// still small would slip through between wall grains.
State between_planes(const State& empty) {
  State room = empty;
  for (WallLattice& wall : room.walls) {
    const double inwards = wall.inwards(room.box) * wall.radius;
    wall = WallLattice::smooth_at(wall.line + inwards, {});
  }
  return room;
}

/// Lets grains grow from a size at which they do not touch, and push each other aside meanwhile.
std::optional<std::vector<Place>> grown(const State& empty, std::vector<Place> places,
                                        const std::vector<double>& radii, double first_scale) {
  constexpr double deepest = 0.2;  // overlap by one growth, over the radius of the smallest grain
  const auto [smallest, largest] = std::minmax_element(radii.begin(), radii.end());
  const double growth = deepest * *smallest / (2.0 * *largest);
  const State room = between_planes(empty);
  try {
    for (double scale = first_scale + growth; scale < 1.0; scale += growth) {
      const std::vector<double> radii_now = scaled(radii, scale);
      Relaxation relaxation(room, places, radii_now);
      relaxation.push_for_a_while();
      places = relaxation.places();
    }
  } catch (const RunFailure&) {
    return std::nullopt;
  }
  return pushed_apart(empty, places, radii);
}

}  // namespace

std::optional<std::vector<Place>> pack(const State& empty, const std::vector<double>& radii,
                                       std::uint64_t seed) {
  if (radii.empty()) return std::vector<Place>{};
  const double largest = *std::max_element(radii.begin(), radii.end());
  const Lattice lattice = widest_lattice(empty, radii.size(), largest);
  std::vector<Place> places = occupied_sites(lattice, radii.size(), seed);
  if (lattice.closest() >= 2.0 * largest) return places;

  if (auto found = pushed_apart(empty, places, radii)) return found;
  return grown(empty, places, radii, lattice.closest() / (2.0 * largest));
}

}  // namespace riesel::scenarios
