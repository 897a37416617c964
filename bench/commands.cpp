#include "bench/commands.hpp"

#include "bench/kept_model.hpp"
#include "bench/memory.hpp"
#include "bench/timing.hpp"
#include "engine/observables.hpp"
#include "engine/team_barrier.hpp"
#include "io/checkpoint.hpp"
#include "scenarios/scenario.hpp"

#include <fmt/core.h>
#include <nlohmann/json.hpp>
#include <omp.h>

#include <algorithm>

namespace riesel::bench {

namespace {

using Json = nlohmann::ordered_json;

void print(const Json& json) { fmt::print("{}\n", json.dump(2)); }

Json memory_since(const Memory& before, std::size_t grains) {
  const Memory now = memory_of_this_process();
  const auto per_grain = [&](std::size_t bytes) {
    return (static_cast<double>(bytes) - static_cast<double>(before.resident))
           / static_cast<double>(grains);
  };
  return {{"bytes_per_grain", per_grain(now.resident)},
          {"peak_bytes_per_grain", per_grain(now.peak)}};
}

/// Each contact between grains counts for both.
double contacts_of_grains(const State& state) {
  double sum = 0.0;
  for (const Contact& contact : state.contacts) sum += contact.name.wall == no_wall ? 2.0 : 1.0;
  return sum;
}

Json json(const State& state) {
  const Observables now = observe(state);
  return {{"time", now.time},
          {"mean_vx", now.mean_vx},
          {"mean_vy", now.mean_vy},
          {"kinetic_energy", now.energies.kinetic},
          {"contacts_of_grains", contacts_of_grains(state)},
          {"state_hash", fmt::format("{:016x}", state_hash(state))}};
}

}  // namespace

void make_state(const StartStates& states, const std::string& case_name, const std::string& size,
                const std::vector<std::string>& overrides) {
  const auto path = states.checkpoint(flow_case(case_name), size_named(size), overrides);
  const auto checkpoint = io::read_checkpoint(path);
  const ContactModel model = model_of(checkpoint);
  const auto* linear = std::get_if<LinearLaw>(&model.normal);
  const auto* viscous = std::get_if<ViscousSlip>(&model.slip);
  const auto* spring = std::get_if<SpringSlip>(&model.slip);
  print({{"checkpoint", std::filesystem::absolute(path).string()},
         {"grains", checkpoint.state.grains.size()},
         {"time_step", checkpoint.state.time_step},
         {"gravity", checkpoint.state.gravity.y},
         {"k_n", linear != nullptr ? Json(linear->k_n) : Json()},
         {"gamma_n", linear != nullptr ? Json(linear->gamma_n) : Json()},
         {"mu", model.friction},
         {"gamma_t", viscous != nullptr ? Json(viscous->gamma_t) : Json()},
         {"k_t", spring != nullptr ? Json(spring->k_t) : Json()},
         {"state", json(checkpoint.state)}});
}

void advance(const AdvanceOptions& options) {
  const Memory before = memory_of_this_process();
  io::Checkpoint checkpoint = io::read_checkpoint(options.checkpoint);
  const ContactModel model = model_of(checkpoint);
  const std::size_t grains = checkpoint.state.grains.size();
  const int threads =
      options.variant.threads > 0 ? options.variant.threads : useful_threads(grains);
  Simulation simulation(std::move(checkpoint.state), model, threads, options.variant.stepping,
                        Askew{}, options.variant.sharing);
  simulation.advance(options.warm_up);
  const double seconds = seconds_of([&] { simulation.advance(options.steps); });
  const auto steps = static_cast<double>(options.steps);
  print({{"grains", grains},
         {"threads", threads},
         {"steps", options.steps},
         {"seconds", seconds},
         {"particle_steps_per_second", static_cast<double>(grains) * steps / seconds},
         {"memory", memory_since(before, grains)},
         {"state", json(simulation.state())}});
}

void start_up(const std::string& case_name, const std::string& size, int threads) {
  const Memory before = memory_of_this_process();
  std::size_t grains = 0;
  Json memory;
  const double seconds = seconds_of([&] {
    const io::Settings settings = settings_of(flow_case(case_name), size_named(size));
    auto flow = std::get<scenarios::Flow>(scenarios::problem_of(settings));
    grains = flow.state.grains.size();
    Simulation simulation(std::move(flow.state), flow.model,
                          threads > 0 ? threads : useful_threads(grains));
    simulation.advance(1);
    memory = memory_since(before, grains);
  });
  print({{"grains", grains}, {"threads", threads}, {"seconds", seconds}, {"memory", memory}});
}

void barrier(int threads) {
  constexpr int spells = 200, rounds = 20'000;
  TeamBarrier team(threads);
  Timing timing;
  for (int spell = 0; spell < spells; ++spell)
    timing.seconds.push_back(seconds_of([&] {
#pragma omp parallel num_threads(threads)
      for (int round = 0; round < rounds; ++round)
        team.arrive_and_wait(static_cast<std::size_t>(omp_get_thread_num()));
    }));
  std::sort(timing.seconds.begin(), timing.seconds.end());
  const auto ns = [](double seconds) { return 1e9 * seconds / rounds; };
  print({{"threads", threads},
         {"spells", spells},
         {"ns_per_barrier",
          {{"least", ns(timing.least())},
           {"median", ns(timing.median())},
           {"most", ns(timing.seconds.back())}}}});
}

}  // namespace riesel::bench
