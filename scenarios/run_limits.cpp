#include "scenarios/run_limits.hpp"

namespace riesel::scenarios {

io::SettingsTable run_limits_settings() {
  return {
      {.key = "limits.overlap",
       .unit = "1",
       .example = "0.5",
       .range = io::positive(),
       .doc = "Limit of the largest overlap of a contact over the radius of the smallest body "
              "(docs/validity.md). By default there is none."},
      {.key = "limits.energy_error",
       .unit = "1",
       .example = "10 %",
       .range = io::positive(),
       .doc = "Limit of the energy created or destroyed by errors of the time step, as a fraction "
              "of the initial energy and the work of gravity and of moving walls. By default there "
              "is none."},
      {.key = "limits.speed",
       .unit = "m/s",
       .example = "50 m/s",
       .range = io::positive(),
       .doc = "Limit of the speed of any grain. By default there is none."},
      {.key = "limits.steps_per_contact",
       .unit = "1",
       .example = "10",
       .range = io::positive(),
       .doc = "Time steps that the shortest twentieth of the contacts must last, or the time step "
              "does not resolve them (docs/validity.md). By default there is no limit."},
      {.key = "limits.action",
       .kind = io::Kind::choice,
       .fallback = "stop",
       .choices = {"stop", "warn"},
       .doc = "What to do when a limit is exceeded: `stop` the run with a checkpoint for the post "
              "mortem, or `warn` and go on, with a verdict that is suspect at best."},
  };
}

RunLimits run_limits(const io::Settings& settings) {
  const auto limit = [&](const char* key) -> std::optional<double> {
    if (!settings.has(key)) return {};
    return settings.number(key);
  };
  return {.overlap = limit("limits.overlap"),
          .energy_error = limit("limits.energy_error"),
          .speed = limit("limits.speed"),
          .steps_per_contact = limit("limits.steps_per_contact"),
          .stop = settings.text("limits.action") == "stop"};
}

}  // namespace riesel::scenarios
