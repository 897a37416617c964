// Any text as a settings file and as a sweep file: it is read, or refused with a SettingsError.
// What was read means the same when it is written out and read again.
#include "io/settings.hpp"
#include "io/sweep_file.hpp"
#include "io/sweep_points.hpp"
#include "scenarios/scenario.hpp"

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>

using namespace riesel;

namespace {

void read_as_settings(const std::string& text) {
  try {
    const auto& tables = scenarios::settings_tables();
    const auto settings = io::Settings::from_text(text, "settings.yaml", tables);
    const auto written = settings.effective_yaml();
    const auto again = io::Settings::from_text(written, "effective.yaml", tables);
    if (again.effective_yaml() == written) return;
    std::fprintf(stderr, "read again, this means something else:\n%s\n", written.c_str());
    std::abort();
  } catch (const io::SettingsError&) {
  }
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
  try {
    const auto& tables = scenarios::settings_tables();
    const auto sweep = io::read_sweep_text(text, "sweep.yaml", tables);
    if (is_small(sweep)) io::expand(sweep, tables);
  } catch (const io::SettingsError&) {
  }
}

}  // namespace

// The name is libFuzzer's. NOLINTNEXTLINE(readability-identifier-naming)
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text(reinterpret_cast<const char*>(data), size);
  read_as_settings(text);
  read_as_sweep(text);
  return 0;
}
