#include "bench/rigid/beside_windows.hpp"

#include "bench/kept_model.hpp"
#include "bench/rigid/rigid_flow.hpp"
#include "bench/timing.hpp"
#include "engine/simulation.hpp"
#include "io/checkpoint.hpp"

#include <fmt/core.h>

#include <cstdint>

namespace riesel::bench {

namespace {

std::int64_t impacts_begun(const Tally& tally) { return tally.grains.begun + tally.walls.begun; }
std::int64_t impacts(const RigidCounts& counts) { return counts.impacts + counts.wall_impacts; }

}  // namespace

void beside_windows(const std::filesystem::path& path, double duration, int rounds) {
  const io::Checkpoint checkpoint = io::read_checkpoint(path);
  const ContactModel model = model_of(checkpoint);
  RigidFlow rigid(checkpoint.state, model, usual_interval);
  Simulation soft(checkpoint.state, model, 1, Stepping::windows);
  const auto steps = static_cast<std::int64_t>(duration / checkpoint.state.time_step);

  fmt::print("{} grains, {} s or {} steps at a time\n{:>10} {:>12} {:>10} {:>12} {:>7}\n",
             rigid.size(), duration, steps, "rigid, s", "impacts/s", "windows, s", "impacts/s",
             "ratio");
  Timing ratios;
  for (int round = 0; round < rounds; ++round) {
    const std::int64_t rigid_before = impacts(rigid.counts());
    const std::int64_t soft_before = impacts_begun(soft.state().tally);
    const double of_rigid = seconds_of([&] { rigid.advance(duration); });
    const double of_soft = seconds_of([&] { soft.advance(steps); });
    const auto rigid_done = static_cast<double>(impacts(rigid.counts()) - rigid_before);
    const auto soft_done = static_cast<double>(impacts_begun(soft.state().tally) - soft_before);
    fmt::print("{:10.4f} {:12.0f} {:10.4f} {:12.0f} {:7.2f}\n", of_rigid, rigid_done / of_rigid,
               of_soft, soft_done / of_soft, of_soft / of_rigid);
    ratios.seconds.push_back(of_soft / of_rigid);
  }
  fmt::print("median {:49.2f}\n", ratios.median());
}

}  // namespace riesel::bench
