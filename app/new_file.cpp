#include "app/commands.hpp"
#include "app/exit_status.hpp"
#include "app/plain_words.hpp"
#include "io/durable_file.hpp"
#include "io/settings_names.hpp"
#include "io/settings_starter.hpp"
#include "scenarios/scenario.hpp"

#include <fmt/core.h>

#include <system_error>

namespace riesel::app {

namespace {

namespace fs = std::filesystem;

const scenarios::Scenario& find(const std::string& name) {
  std::vector<std::string> names;
  for (const scenarios::Scenario& scenario : scenarios::all()) {
    if (scenario.name == name) return scenario;
    names.push_back(scenario.name);
  }
  throw UnusableInput(
      fmt::format("{}: unknown scenario; {}", name,
                  io::did_you_mean(name, names).value_or("choose " + io::enumerate(names))));
}

}  // namespace

int new_file(const NewFileOptions& options) {
  const scenarios::Scenario& scenario = find(options.scenario);
  const fs::path file = options.file.value_or(scenario.name + ".yaml");
  std::error_code ignored;
  if (fs::exists(fs::symlink_status(file, ignored)))
    throw UnusableInput(file.string() + ": exists already; choose another name");
  if (const fs::path home = fs::absolute(file).parent_path(); !fs::is_directory(home, ignored))
    throw UnusableInput(home.string() + ": is no directory; make it first, or choose another");
  io::write_durably(file, io::starter_file(scenarios::settings_tables().at(scenario.name),
                                           scenario.name, scenario.summary));
  fmt::print("{}: written; look at it, then '{}' and '{}'\n", file.string(), call_of("check", file),
             call_of("run", file));
  return exit_done;
}

}  // namespace riesel::app
