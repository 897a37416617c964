#include "app/walltime.hpp"

#include "app/clock.hpp"
#include "app/commands.hpp"
#include "io/units.hpp"

#include <fmt/format.h>

#include <optional>

namespace riesel::app {

namespace {

const Clock::time_point start_of_program = Clock::now();

std::optional<double> seconds_in(const std::string& text) {
  const auto quantity = io::split_quantity(text);
  if (!quantity) return {};
  try {
    return io::value_in_si(*quantity, "s");
  } catch (const io::UnitError&) {
    return {};
  }
}

}  // namespace

double seconds_since_start_of_program() { return seconds_since(start_of_program); }

double read_walltime(const std::string& text) {
  const auto seconds = seconds_in(text);
  if (!seconds || !(*seconds > 0.0))
    throw UnusableInput(
        fmt::format("--max-walltime: expected a time, got '{}'; write for instance '23.5 h' or "
                    "'600 s'",
                    text));
  return *seconds;
}

}  // namespace riesel::app
