// A straightforward scalar code for the tube, to compare with: double precision, structure of
// arrays, a Verlet list with a skin, velocity Verlet with the linear law and capped Coulomb
// friction. No integers, no vectors, no windows; compiled with the same flags. It computes the same
// physics to first order in its treatment of friction.
#pragma once

#include "engine/contact_law.hpp"
#include "engine/state.hpp"

#include <cstdint>
#include <utility>
#include <vector>

namespace riesel::bench {

class ScalarReference {
public:
  /// Throws std::invalid_argument if there is something that it does not know: another law, grains
  /// that rotate, gravity across the tube, no or moving walls.
  ScalarReference(const State& state, const ContactModel& model);

  void advance(std::int64_t steps);
  double mean_vy() const;         ///< m/s
  double kinetic_energy() const;  ///< J

private:
  void step();
  void rebuild();
  std::size_t cell_of(std::size_t i) const;
  void sort_by_cell();
  void list_neighbours(std::size_t i);
  bool moved_too_far() const;
  void forces();
  void pair_force(std::size_t i, std::size_t j);
  void wall_force(std::size_t i, double line);
  double nearest(double dy) const;

  std::size_t n_;
  double length_, width_, gravity_, dt_, skin_, wall_radius_, wall_spacing_, k_n_, gamma_n_, mu_;
  std::vector<double> x_, y_, vx_, vy_, fx_, fy_, radius_, mass_;
  std::vector<double> x_built_, y_built_;

  // The cells of the last rebuild
  std::size_t columns_ = 1, rows_ = 1;
  std::vector<std::size_t> start_;
  std::vector<std::uint32_t> first_, neighbours_;
};

}  // namespace riesel::bench
