#include "app/run_directory.hpp"

#include "app/commands.hpp"
#include "app/plain_words.hpp"
#include "app/report_parts.hpp"
#include "io/build_info.hpp"
#include "io/checkpoint.hpp"
#include "io/durable_file.hpp"
#include "io/file_error.hpp"
#include "io/run_file.hpp"
#include "io/summary.hpp"
#include "io/sweep_manifest.hpp"
#include "io/trajectory_file.hpp"

namespace riesel::app {

namespace fs = std::filesystem;

bool has_checkpoint(const fs::path& directory) {
  const fs::path checkpoint = directory / io::checkpoint_name;
  return fs::exists(checkpoint) || fs::exists(io::previous_generation(checkpoint));
}

bool stopped_before_checkpoint(const fs::path& directory) {
  return fs::exists(directory / io::effective_settings_name) && !has_checkpoint(directory)
         && !fs::exists(directory / io::summary_name);
}

RunDirectory::RunDirectory(const fs::path& path, io::Signature signature)
    : path_(path), lock_(std::make_unique<io::DirectoryLock>(path, signature)) {}

void RunDirectory::write_settings(const io::Settings& settings) const {
  io::write_durably(file(io::effective_settings_name),
                    "# Written by " + written_by() + ".\n" + settings.effective_yaml());
}

namespace {

void reject_directory_in_use(const fs::path& path) {
  if (fs::exists(path) && !fs::is_directory(path))
    throw UnusableInput(path.string() + ": is no directory; choose another one with --out");
  if (fs::exists(path / io::manifest_name))
    throw UnusableInput(path.string() + ": holds a sweep; choose another directory with --out");
  const bool holds_run = fs::exists(path / io::run_file_name)
                         || fs::exists(path / io::trajectory_name)
                         || fs::exists(path / io::summary_name) || has_checkpoint(path);
  if (holds_run && stopped_before_checkpoint(path))
    throw UnusableInput(path.string()
                        + ": holds a run that was stopped before its first checkpoint; "
                          "remove it, or choose another directory with --out");
  if (holds_run)
    throw UnusableInput(path.string() + ": holds a run already; choose another directory with --out"
                        + (has_checkpoint(path)
                               ? ", or go on with that run by '" + call_of("resume", path) + "'"
                               : ""));
}

}  // namespace

RunDirectory RunDirectory::create(const fs::path& path, const io::Settings& settings) {
  reject_directory_in_use(path);
  io::make_directories(path);
  RunDirectory directory(path, io::Signature::now);
  reject_directory_in_use(path);  // again: before it was locked, another run may have begun in it
  directory.write_settings(settings);
  return directory;
}

RunDirectory RunDirectory::reopen(const fs::path& path) {
  if (!fs::exists(path / io::run_file_name))
    throw UnusableInput((path / io::run_file_name).string()
                        + ": is missing; restore the file, or start the run again elsewhere");
  return {path, io::Signature::later};
}

void RunDirectory::go_on(const io::Settings& settings) const {
  lock_->sign();
  // The result first, so that it never stands beside settings that are not its own.
  const fs::path summary = file(io::summary_name);
  std::error_code error;
  fs::rename(summary, io::previous_generation(summary), error);
  if (error && error != std::errc::no_such_file_or_directory)
    throw io::system_failure(summary, "cannot be set aside", error.value());
  write_settings(settings);
}

void RunDirectory::drop_report() const {
  std::error_code ignored;  // an old report that stays does no harm to results
  fs::remove(file(report_name), ignored);
}

void RunDirectory::write_summary(const std::string& text) const {
  const fs::path summary = file(io::summary_name);
  io::write_durably(summary, text);
  std::error_code ignored;  // if it stays, it does no harm
  fs::remove(io::previous_generation(summary), ignored);
}

}  // namespace riesel::app
