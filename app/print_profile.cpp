#include "app/print_profile.hpp"

#include "app/plain_words.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>

namespace riesel::app {

void print_profile(const Simulation& simulation, const RunTimes& times, std::int64_t steps) {
  if (steps == 0) {
    fmt::print("no steps were done, so that there is no profile\n");
    return;
  }
  using Phase = Profile::Phase;
  const Profile& profile = simulation.profile();
  struct Row {
    const char* name;
    double seconds;
  };
  double phases = 0.0;
  for (std::size_t p = 0; p < Profile::phases; ++p)
    phases += profile.seconds(static_cast<Phase>(p));
  // The phases are estimated from samples, and may add up to more than the whole.
  const double scale = std::min(1.0, times.stepping / phases);
  const auto seconds = [&](Phase phase) { return scale * profile.seconds(phase); };
  const std::array rows{Row{"fly", seconds(Phase::fly)},
                        Row{"build", seconds(Phase::build)},
                        Row{"search", seconds(Phase::search)},
                        Row{"forces", seconds(Phase::forces)},
                        Row{"receive", seconds(Phase::receive)},
                        Row{"appointments", seconds(Phase::appointments)},
                        Row{"stepping, other", times.stepping - scale * phases},
                        Row{"measure", times.measuring},
                        Row{"output", times.output}};
  const double total = times.stepping + times.measuring + times.output;
  fmt::print("{:<18}{:>10}{:>8}{:>12}\n", "phase", "s", "%", "ns/step");
  for (const Row& row : rows)
    fmt::print("{:<18}{:>10.3f}{:>8.1f}{:>12.1f}\n", row.name, row.seconds,
               100.0 * row.seconds / total, 1e9 * row.seconds / static_cast<double>(steps));
  const Way way = simulation.preferred_way();
  fmt::print("at the end: {} on {}{}; one step in {} was timed in detail, on the first thread\n",
             way.by_flights ? "stepping by windows" : "plain stepping",
             so_many(way.threads, "thread"), way.apart ? ", each on its own part" : "",
             Profile::steps_per_sample);
}

}  // namespace riesel::app
