#include "bench/rigid/rigid_record.hpp"

#include "engine/steady_state.hpp"
#include "engine/time_series.hpp"

#include <fmt/core.h>

#include <cmath>
#include <numeric>
#include <span>

namespace riesel::bench {

RigidRecord::RigidRecord(const RigidFlow& flow, double interval)
    : interval_(interval), grains_(static_cast<double>(flow.size())) {
  for (std::size_t i = 0; i < flow.size(); ++i) mass_ += flow.grain(i).mass;
  add(flow);
}

void RigidRecord::add(const RigidFlow& flow) {
  double vx = 0.0, vx2 = 0.0, vy = 0.0;
  for (std::size_t i = 0; i < flow.size(); ++i) {
    const Grain grain = flow.grain(i);
    vx += grain.vx / grains_;
    vx2 += grain.vx * grain.vx / grains_;
    vy += grain.vy / grains_;
  }
  velocity_.push_back(vy);
  sigma_vx_.push_back(std::sqrt(vx2 - vx * vx));
  counts_.push_back(flow.counts());
}

std::string RigidRecord::columns(double gravity) const {
  const SteadyState found = assess_steady_state(velocity_, gravity * interval_);
  const std::size_t first = found.transient_end, last = velocity_.size() - 1;

  std::vector<double> shares;  // of the weight, in each interval
  for (std::size_t i = 0; i < last; ++i)
    shares.push_back((counts_[i].wall_impulse_y - counts_[i + 1].wall_impulse_y)
                     / (mass_ * gravity * interval_));
  const std::span<const double> all(shares);
  const MeanEstimate share = estimate_mean(all.subspan(first));
  const MeanEstimate at_end = estimate_mean(all.subspan(last - last / 5));
  const MeanEstimate sigma_vx = estimate_mean(std::span<const double>(sigma_vx_).subspan(first));

  const double lasts = static_cast<double>(last - first) * interval_;
  const auto rate = [&](std::int64_t RigidCounts::*count) {
    return static_cast<double>(counts_[last].*count - counts_[first].*count) / (grains_ * lasts);
  };
  const RigidCounts& end = counts_[last];
  return fmt::format(
      "{},{:.5g},{:.5g},{:.5g},{:.5g},{:.5g},{:.5g},{:.5g},{:.5g},{:.5g},{:.5g},{:.3g}",
      name(found.verdict), found.mean, found.error, found.independent_samples,
      static_cast<double>(first) * interval_, share.mean, share.error, at_end.mean, sigma_vx.mean,
      rate(&RigidCounts::impacts), rate(&RigidCounts::wall_impacts),
      static_cast<double>(end.elastic) / static_cast<double>(end.impacts + end.wall_impacts));
}

}  // namespace riesel::bench
