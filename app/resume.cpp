#include "app/commands.hpp"
#include "app/run_flow.hpp"
#include "io/checkpoint.hpp"
#include "io/file_error.hpp"
#include "scenarios/scenario.hpp"

#include <fmt/core.h>

namespace riesel::app {

namespace {

/// What may change without making it another run.
void reject_overrides_of_the_physics(const std::vector<std::string>& overrides) {
  for (const std::string& setting : overrides) {
    const std::string key = setting.substr(0, setting.find('='));
    const bool allowed = key == "run.duration" || key == "run.threads"
                         || io::section_of(key) == "output";
    if (!allowed || key == "output.interval")
      throw io::SettingsError(
          {.source = "--set " + setting}, key, "cannot change when a run is resumed",
          "only run.duration, run.threads and output.checkpoint_interval can; for anything else "
          "start a new run");
  }
}

io::FoundCheckpoint find(const std::filesystem::path& path) {
  try {
    return io::find_checkpoint(path);
  } catch (const io::FileError& error) {
    throw UnusableInput(error.what());
  }
}

}  // namespace

int resume(const ResumeOptions& options, const Arguments& arguments) {
  reject_overrides_of_the_physics(options.overrides);
  io::FoundCheckpoint found = find(options.checkpoint);
  if (!found.note.empty()) fmt::print(stderr, "riesel: {}\n", found.note);

  const auto settings =
      io::Settings::from_text(found.checkpoint.settings, found.path.string(),
                              scenarios::settings_tables(), options.overrides);
  const auto home = std::filesystem::is_directory(options.checkpoint)
                        ? options.checkpoint
                        : std::filesystem::absolute(options.checkpoint).parent_path();
  return resume_flow(settings, std::move(found.checkpoint), RunDirectory::reopen(home, settings),
                     arguments);
}

}  // namespace riesel::app
