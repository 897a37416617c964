// Uses a header of the engine, a function of io and the registry of scenarios, so that the
// installed include paths and libraries are both tried.
#include "engine/box.hpp"
#include "io/build_info.hpp"
#include "scenarios/scenario.hpp"

#include <cstdio>
#include <stdexcept>

namespace {

riesel::scenarios::Problem nothing(const riesel::io::Settings&) {
  throw std::logic_error("never prepared");
}

/// Whether a scenario of this name is refused.
bool is_refused(const char* name,
                riesel::scenarios::Problem (*prepare)(const riesel::io::Settings&)) {
  try {
    riesel::scenarios::add({.name = name, .summary = "", .own_settings = {}, .prepare = prepare});
  } catch (const std::logic_error&) {
    return true;
  }
  return false;
}

/// The laws of the house cannot be replaced.
bool is_refused_as_law(const char* name) {
  try {
    riesel::scenarios::add(
        riesel::scenarios::Law{.name = name, .own_settings = {}, .make = nullptr});
  } catch (const std::logic_error&) {
    return true;
  }
  return false;
}

}  // namespace

int main() {
  for (const char* law : {"linear", "power", "hertz"})
    if (!is_refused_as_law(law)) return 1;
  if (!is_refused_as_law("without its function")) return 1;
  if (!is_refused("without its function", nullptr)) return 1;
  if (!is_refused("periodic_tube", nothing)) return 1;
  if (is_refused("own", nothing) || !is_refused("own", nothing)) return 1;
  riesel::scenarios::settings_tables();
  if (!is_refused("another", nothing)) return 1;  // too late
  const riesel::Box box{.width = 0.02, .length = 0.1};
  const auto& version = riesel::build_info().version;
  std::printf("riesel %.*s\n", static_cast<int>(version.size()), version.data());
  return box.metres_x(box.fixed_x(0.01)) > 0.0 ? 0 : 1;
}
