// What a run with rigid grains comes to, as columns of a table: the same judgement of the same
// series as for soft grains.
#pragma once

#include "bench/rigid/rigid_flow.hpp"

#include <string>
#include <vector>

namespace riesel::bench {

class RigidRecord {
public:
  /// `interval` (s) lies between two rows.
  RigidRecord(const RigidFlow& flow, double interval);

  void add(const RigidFlow& flow);

  /// Velocities in m/s. Of what comes after the transient: mean velocity, share of the weight that
  /// the wall carries (and that in the last fifth of all), standard deviation of v_x, impacts per
  /// grain and second; and the part of all impacts that were made elastic.
  static constexpr auto names =
      "state,velocity,velocity_error,independent_samples,transient_end,share,share_error,share_5,"
      "sigma_vx,impact_rate,wall_impact_rate,elastic";
  std::string columns(double gravity) const;

private:
  double interval_, mass_ = 0.0, grains_;
  std::vector<double> velocity_, sigma_vx_;  // by row, the first one at the start
  std::vector<RigidCounts> counts_;          // likewise
};

}  // namespace riesel::bench
