// Any text as a settings file and as a sweep file: it is read, or refused with a SettingsError.
// What was read means the same when it is written out and read again.
#include "io/settings.hpp"
#include "io/sweep_file.hpp"
#include "io/sweep_points.hpp"
#include "scenarios/scenario.hpp"
#include "tests/fuzz/attempt.hpp"

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <optional>
#include <string>

using namespace riesel;
using fuzz::attempt;

namespace {

/// What was written, read and written out again; why not, if it is refused.
std::string once_more(const std::string& written) {
  try {
    return io::Settings::from_text(written, "effective.yaml", scenarios::settings_tables())
        .effective_yaml();
  } catch (const io::SettingsError& error) {
    return error.what();
  }
}

void read_as_settings(const std::string& text) {
  std::optional<io::Settings> settings;
  attempt<io::SettingsError>("settings", [&] {
    settings = io::Settings::from_text(text, "settings.yaml", scenarios::settings_tables());
  });
  if (!settings) return;
  const auto written = settings->effective_yaml();
  const auto again = once_more(written);
  if (again == written) return;
  std::fprintf(stderr, "%s\nread again, is:\n%s\n", written.c_str(), again.c_str());
  std::abort();
}

/// Small sweeps only: the number of points is limited elsewhere, and each takes its time.
bool is_small(const io::SweepFile& sweep) {
  constexpr std::size_t most_points = 16;
  std::size_t points = 1;
  const auto multiply = [&](std::size_t count) { points *= count > 0 ? count : 1; };
  for (const auto& axis : sweep.axes) {
    multiply(axis.values.size());
    if (points > most_points) return false;
  }
  multiply(sweep.branches.size());
  multiply(sweep.seeds.size());
  return points <= most_points;
}

void read_as_sweep(const std::string& text) {
  attempt<io::SettingsError>("sweep", [&] {
    const auto& tables = scenarios::settings_tables();
    const auto sweep = io::read_sweep_text(text, "sweep.yaml", tables);
    if (is_small(sweep)) io::expand(sweep, tables);
  });
}

}  // namespace

// The name is libFuzzer's. NOLINTNEXTLINE(readability-identifier-naming)
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text(reinterpret_cast<const char*>(data), size);
  read_as_settings(text);
  read_as_sweep(text);
  return 0;
}
