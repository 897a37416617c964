#include "bench/ensemble.hpp"

#include "bench/child.hpp"
#include "bench/scratch_folder.hpp"
#include "engine/hash.hpp"
#include "io/durable_file.hpp"
#include "io/summary.hpp"

#include <fmt/core.h>

#include <array>
#include <fstream>
#include <set>

namespace riesel::bench {

namespace fs = std::filesystem;

namespace {

constexpr auto member = "tube_start";  // each run is one of this case
constexpr int seeds = 6;
constexpr double duration = 0.5;  // s of each run, at full effort

/// What came out of all runs of a sweep.
struct Outcome {
  std::size_t grains = 0;
  double particle_steps = 0.0;
  std::uint64_t hash = 0;  // of the final states
};

Outcome outcome_of(const fs::path& sweep) {
  std::set<fs::path> points;  // in the same order for each sweep: the names come from the settings
  for (const auto& point : fs::directory_iterator(sweep / "points")) points.insert(point.path());
  Outcome outcome;
  Hash hash;
  for (const fs::path& point : points) {
    std::ifstream file(point / io::summary_name);
    const auto summary = nlohmann::json::parse(file);
    const auto grains = summary["grains"].get<std::size_t>();
    outcome.grains += grains;
    outcome.particle_steps += static_cast<double>(grains) * summary["steps"].get<double>();
    hash.add_text(summary["state_hash"].get<std::string>());
  }
  outcome.hash = hash.value();
  return outcome;
}

}  // namespace

void measure_ensemble(const fs::path& riesel, const fs::path& folder, const Effort& effort,
                      Results& results) {
  const ScratchFolder scratch(folder);
  const fs::path plan = scratch.path() / "ensemble.yaml", sweep = scratch.path() / "ensemble";
  io::write_durably(
      plan,
      fmt::format("{{base: {}, set: {{run.duration: {:.3g} s, run.threads: 1}}, seeds: {}}}\n",
                  flow_case(member).settings, duration * effort.work, seeds));

  const std::array jobs = {1, 2};
  std::array<Outcome, 2> outcomes{};
  std::vector<Measurement> measurements;
  for (std::size_t i = 0; i < jobs.size(); ++i)
    measurements.emplace_back([&, i] {
      const double seconds = seconds_of([&] {
        output_of({riesel.string(), "sweep", plan.string(), "--out", sweep.string(), "--jobs",
                   std::to_string(jobs[i])});
      });
      outcomes[i] = outcome_of(sweep);
      fs::remove_all(sweep);
      return seconds;
    });
  const std::vector<Timing> timings = in_turns(measurements, effort.repetitions);

  for (std::size_t i = 0; i < jobs.size(); ++i) {
    add(results, {.case_name = "ensemble",
                  .size = "1.4k",
                  .variant = fmt::format("jobs {}", jobs[i]),
                  .grains = outcomes[i].grains,
                  .threads = jobs[i],  // each job has one
                  .unit = "particle-steps",
                  .work = outcomes[i].particle_steps,
                  .timing = timings[i],
                  .state_hash = outcomes[i].hash});
  }
  if (outcomes[0].hash != outcomes[1].hash)
    results.disagreements.emplace_back("ensemble: the results depend on what runs beside them");
}

}  // namespace riesel::bench
