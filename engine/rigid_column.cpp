#include "engine/rigid_column.hpp"

#include "engine/require.hpp"

#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

namespace riesel {

namespace {

/// The column in units of the initial gap and velocity. v_[0] is that of the plate, always 0; v_[i]
/// that of bead i = 1 ... n, upwards. gap_[i] is below bead i + 1.
class Beads {
public:
  explicit Beads(int n)
      : gap_(static_cast<std::size_t>(n), 1.0), v_(static_cast<std::size_t>(n) + 1, -1.0) {
    v_.front() = 0.0;
  }

  std::size_t size() const { return gap_.size(); }

  /// Moves on to the next collision; false if there is none.
  bool fly() {
    double soonest = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < size(); ++i)
      if (rate(i) < 0.0 && gap_[i] / -rate(i) < soonest) {
        soonest = gap_[i] / -rate(i);
        next_ = i;
      }
    if (std::isinf(soonest)) return false;
    for (std::size_t i = 0; i < size(); ++i) gap_[i] += soonest * rate(i);
    gap_[next_] = 0.0;
    return true;
  }

  /// The collision to which fly() has moved.
  void collide(double restitution_of_beads, double restitution_at_plate) {
    double &below = v_[next_], &above = v_[next_ + 1];
    if (next_ == 0) {
      above *= -restitution_at_plate;
      return;
    }
    const double mean = 0.5 * (above + below), half = 0.5 * (above - below);
    above = mean - restitution_of_beads * half;
    below = mean + restitution_of_beads * half;
  }

  double mean_square_velocity() const {
    double sum = 0.0;
    for (const double v : v_) sum += v * v;
    return sum / static_cast<double>(size());
  }
  double mean_velocity() const {
    double sum = 0.0;
    for (const double v : v_) sum += v;
    return sum / static_cast<double>(size());
  }

private:
  double rate(std::size_t i) const { return v_[i + 1] - v_[i]; }  // of gap i, below bead i + 1

  std::vector<double> gap_, v_;
  std::size_t next_ = 0;  // gap that closes
};

}  // namespace

RigidColumn rigid_column(int beads, double restitution_of_beads, double restitution_at_plate) {
  require(beads > 0, "a column needs beads");
  // A column that does not collapse has about N^2 collisions, or ten times as many close to the
  // threshold of collapse.
  const std::int64_t most_collisions = 100 * static_cast<std::int64_t>(beads) * beads;
  Beads column(beads);
  std::int64_t collisions = 0;
  while (column.fly()) {
    column.collide(restitution_of_beads, restitution_at_plate);
    if (++collisions == most_collisions)
      return {.restitution = 0.0, .rebound = 0.0, .collisions = collisions, .collapsed = true};
  }
  return {.restitution = std::sqrt(column.mean_square_velocity()),
          .rebound = column.mean_velocity(),
          .collisions = collisions,
          .collapsed = false};
}

}  // namespace riesel
