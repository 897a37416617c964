#include "bench/other_rows.hpp"

#include "bench/child.hpp"
#include "bench/scratch_folder.hpp"
#include "io/checkpoint.hpp"
#include "io/settings.hpp"
#include "scenarios/scenario.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <variant>

namespace riesel::bench {

namespace {

constexpr auto fresh_tube = "tube_start";

}  // namespace

void measure_impacts(const ImpactCase& one, const Effort& effort, Results& results) {
  const auto settings =
      io::Settings::from_text(one.settings, one.name, scenarios::settings_tables());
  const auto curve = std::get<scenarios::ImpactCurve>(scenarios::problem_of(settings));
  const int rounds = std::max(1, static_cast<int>(one.rounds * effort.work));

  const std::array threads = {1, 2};
  std::array<std::uint64_t, 2> hashes{};
  std::vector<Measurement> measurements;
  for (std::size_t i = 0; i < threads.size(); ++i)
    measurements.emplace_back([&, i] {
      return seconds_of([&] {
        for (int round = 0; round < rounds; ++round)
          hashes[i] = hash_of(follow_all(curve.setup, curve.impacts, threads[i]));
      });
    });
  const std::vector<Timing> timings = in_turns(measurements, effort.repetitions);
  for (std::size_t i = 0; i < threads.size(); ++i)
    add(results, {.case_name = one.name,
                  .size = "1",
                  .variant = fmt::format("threads {}", threads[i]),
                  .grains = 1,
                  .threads = threads[i],
                  .unit = "impacts",
                  .work = static_cast<double>(rounds) * static_cast<double>(curve.impacts.size()),
                  .timing = timings[i],
                  .state_hash = hashes[i]});
  if (hashes[0] != hashes[1])
    results.disagreements.push_back(one.name + ": the results depend on the number of threads");
}

void measure_checkpoint(const Size& size, const StartStates& states, const Effort& effort,
                        Results& results) {
  const auto original = io::read_checkpoint(states.checkpoint(flow_case(fresh_tube), size));
  const ScratchFolder scratch(states.folder());
  const auto path = scratch.path() / "written.h5";
  io::Checkpoint read;
  const std::vector<Timing> timings =
      in_turns({[&] { return seconds_of([&] { io::write_checkpoint(path, original); }); },
                [&] { return seconds_of([&] { read = io::read_checkpoint(path); }); }},
               effort.repetitions);
  const auto bytes = static_cast<double>(std::filesystem::file_size(path));
  for (std::size_t i = 0; i < timings.size(); ++i)
    add(results, {.case_name = "checkpoint",
                  .size = size.name,
                  .variant = i == 0 ? "write" : "read",
                  .grains = original.state.grains.size(),
                  .unit = "bytes",
                  .work = bytes,
                  .timing = timings[i],
                  .state_hash = state_hash(i == 0 ? original.state : read.state)});
  if (state_hash(original.state) != state_hash(read.state))
    results.disagreements.emplace_back("checkpoint: what is read is not what was written");
}

void measure_start_up(const Size& size, const Effort& effort, Results& results) {
  const std::array threads = {1, 2};
  std::vector<nlohmann::json> answers(threads.size());
  std::vector<Measurement> measurements;
  for (std::size_t i = 0; i < threads.size(); ++i)
    measurements.emplace_back([&, i] {
      answers[i] =
          ask_child({"start-up", fresh_tube, size.name, "--threads", std::to_string(threads[i])});
      return answers[i]["seconds"].get<double>();
    });
  const std::vector<Timing> timings = in_turns(measurements, effort.repetitions);
  for (std::size_t i = 0; i < threads.size(); ++i)
    add(results,
        {.case_name = "start_up",
         .size = size.name,
         .variant = fmt::format("threads {}", threads[i]),
         .grains = answers[i]["grains"].get<std::size_t>(),
         .threads = threads[i],
         .unit = "starts",
         .work = 1.0,
         .timing = timings[i],
         .bytes_per_grain = answers[i]["memory"]["bytes_per_grain"].get<double>(),
         .peak_bytes_per_grain = answers[i]["memory"]["peak_bytes_per_grain"].get<double>()});
}

}  // namespace riesel::bench
