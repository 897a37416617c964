// Problems as users get them: from the text of a settings file, through a scenario.
#pragma once

#include "scenarios/scenario.hpp"
#include "tests/catch.hpp"

#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace scenario_fixture {

using namespace riesel;

using Overrides = std::vector<std::string>;  // "key=value"

inline const std::string tube_yaml = R"(
scenario: periodic_tube
contact: {stiffness: 2000 N/m, damping: 1e4 1/s}
tube: {width: 20 mm, length: 20 mm}
run: {duration: 1 s}
)";

inline const std::string single_yaml = R"(
scenario: single_wall_grain
contact: {stiffness: 2000 N/m, damping: 1e4 1/s}
)";

inline const std::string array_yaml = R"(
scenario: wall_array
contact: {stiffness: 2000 N/m, damping: 1e4 1/s}
)";

/// The tube with e_N to be given instead of the damping.
inline const std::string tube_of_restitution_yaml = R"(
scenario: periodic_tube
contact: {stiffness: 2000 N/m, restitution: 0.7}
tube: {width: 20 mm, length: 20 mm}
run: {duration: 1 s}
)";

inline io::Settings read(const std::string& yaml, const Overrides& overrides = {}) {
  return io::Settings::from_text(yaml, "test.yaml", scenarios::settings_tables(), overrides);
}

inline scenarios::Flow flow(const std::string& yaml, const Overrides& overrides = {}) {
  return std::get<scenarios::Flow>(scenarios::problem_of(read(yaml, overrides)));
}

inline scenarios::Flow tube(const Overrides& overrides = {}) { return flow(tube_yaml, overrides); }

inline scenarios::ImpactCurve curve(const std::string& yaml, const Overrides& overrides = {}) {
  return std::get<scenarios::ImpactCurve>(scenarios::problem_of(read(yaml, overrides)));
}

inline std::vector<Grain> grains_of(const State& state) {
  std::vector<Grain> grains;
  for (std::size_t slot = 0; slot < state.grains.size(); ++slot) {
    grains.push_back(grain_at(state, slot));
  }
  return grains;
}

/// What the user is told about settings that cannot be; "accepted" if they can.
inline std::string complaint(const std::string& yaml, const Overrides& overrides = {}) {
  try {
    (void)scenarios::problem_of(read(yaml, overrides));
  } catch (const io::SettingsError& error) {
    return error.what();
  }
  return "accepted";
}

/// Checks that the message names all of the words.
inline void check_mentions(const std::string& message, const std::vector<std::string>& words) {
  CAPTURE(message);
  for (const std::string& word : words) {
    CAPTURE(word);
    CHECK(message.find(word) != std::string::npos);
  }
}

}  // namespace scenario_fixture
