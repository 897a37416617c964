// The first suite: particle-steps per second of the tube of scenarios/periodic_tube.yaml, from 1.4
// thousand to a million grains, beside a straightforward scalar code in the same run.
//
//   build/bench/bench/speed [seconds per measurement]
#include "bench/scalar_reference.hpp"
#include "engine/simulation.hpp"
#include "io/build_info.hpp"
#include "io/settings.hpp"
#include "scenarios/scenario.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdlib>
#include <string>
#include <vector>

namespace {

using namespace riesel;

struct Size {
  const char* name;
  double width, length;  // m
};

/// The tube at area fraction 0.55, stretched.
constexpr std::array sizes = {Size{"1.4 k", 0.020, 0.100}, Size{"10 k", 0.020, 0.714},
                              Size{"100 k", 0.0632, 2.259}, Size{"1 M", 0.200, 7.140}};

scenarios::Flow tube(const Size& size) {
  const std::string text =
      fmt::format("{{scenario: periodic_tube, contact: {{stiffness: 2000, restitution: 0.92}}, "
                  "tube: {{width: {}, length: {}}}, run: {{duration: 1}}}}",
                  size.width, size.length);
  const auto settings = io::Settings::from_text(text, "benchmark", scenarios::settings_tables());
  return std::get<scenarios::Flow>(scenarios::named("periodic_tube").prepare(settings));
}

/// Particle-steps per second: the median of several measurements after a warm-up.
template <class System>
double speed(System& system, std::size_t grains, double seconds) {
  using Clock = std::chrono::steady_clock;
  const auto chunk = std::max<std::int64_t>(10, 2'000'000 / static_cast<std::int64_t>(grains));
  // Long enough for the lattice to melt where that takes seconds only.
  system.advance(
      std::clamp<std::int64_t>(300'000'000 / static_cast<std::int64_t>(grains), 200, 3000));
  std::vector<double> measured;
  for (int repetition = 0; repetition < 5; ++repetition) {
    std::int64_t steps = 0;
    double spent = 0.0;
    const auto start = Clock::now();
    while (spent < seconds / 5.0) {
      system.advance(chunk);
      steps += chunk;
      spent = std::chrono::duration<double>(Clock::now() - start).count();
    }
    measured.push_back(static_cast<double>(grains) * static_cast<double>(steps) / spent);
  }
  std::sort(measured.begin(), measured.end());
  return measured[measured.size() / 2];
}

double engine_speed(const scenarios::Flow& flow, int threads, Stepping stepping, double seconds) {
  Simulation simulation(flow.state, flow.model, threads, stepping);
  return speed(simulation, flow.state.grains.size(), seconds);
}

}  // namespace

int main(int argc, char** argv) {
  const double seconds = argc > 1 ? std::atof(argv[1]) : 2.0;
  fmt::print("riesel {} {}, {} {}\n", build_info().version, build_info().git_commit,
             build_info().compiler, build_info().flags);
  fmt::print("million particle-steps per second (median of five), slow tube, k_N = 2000 N/m\n\n");
  fmt::print("{:>8} {:>10} {:>10} {:>10} {:>10} {:>10}\n", "grains", "scalar", "plain 1", "plain 2",
             "windows", "plain/scalar");
  for (const Size& size : sizes) {
    const scenarios::Flow flow = tube(size);
    bench::ScalarReference reference(flow.state, flow.model);
    const double scalar = speed(reference, flow.state.grains.size(), seconds);
    const double one = engine_speed(flow, 1, Stepping::plain, seconds);
    const double two = engine_speed(flow, 2, Stepping::plain, seconds);
    const double windows = engine_speed(flow, 1, Stepping::windows, seconds);
    fmt::print("{:>8} {:>10.1f} {:>10.1f} {:>10.1f} {:>10.1f} {:>10.2f}\n", size.name, scalar / 1e6,
               one / 1e6, two / 1e6, windows / 1e6, one / scalar);
    std::fflush(stdout);
  }
}
