#include "app/run_directory.hpp"

#include "app/commands.hpp"
#include "app/plain_words.hpp"
#include "app/report_parts.hpp"
#include "io/build_info.hpp"
#include "io/checkpoint.hpp"
#include "io/durable_file.hpp"
#include "io/file_error.hpp"
#include "io/run_file.hpp"
#include "io/settings_text.hpp"
#include "io/summary.hpp"
#include "io/sweep_manifest.hpp"
#include "io/trajectory_file.hpp"
#include "io/whole_file.hpp"

#include <optional>
#include <string_view>
#include <utility>

namespace riesel::app {

namespace fs = std::filesystem;

namespace {

/// How effective.yaml begins.
constexpr std::string_view settings_mark = "# Written by riesel ";

std::string text_of(const io::Settings& settings) {
  return "# Written by " + written_by() + ".\n" + settings.effective_yaml();
}

/// Whether two such texts have the same settings, whichever versions have written them.
bool same_settings(const std::string& a, const std::string& b) {
  const auto behind_first_line = [](const std::string& text) {
    const auto end = text.find('\n');
    return end == std::string::npos ? std::string() : text.substr(end);
  };
  return behind_first_line(a) == behind_first_line(b);
}

}  // namespace

fs::path place_named_after(const fs::path& file, const fs::path& parent) {
  const fs::path name = file.stem();
  if (name == "." || name == "..")
    throw UnusableInput(file.string() + ": has no name that a directory for the results could have"
                        + "; choose one with --out");
  return parent / name;
}

bool has_checkpoint(const fs::path& directory) {
  const fs::path checkpoint = directory / io::checkpoint_name;
  return fs::exists(checkpoint) || fs::exists(io::previous_generation(checkpoint));
}

bool holds_own_settings(const fs::path& directory) {
  return io::beginning_of(directory / io::effective_settings_name, settings_mark.size())
         == settings_mark;
}

bool has_only_begun(const fs::path& directory) {
  return holds_own_settings(directory) && !has_checkpoint(directory)
         && !fs::exists(directory / io::summary_name);
}

RunDirectory::RunDirectory(const fs::path& path, io::Signature signature)
    : path_(path), lock_(as_input<io::InUse>([&] {
        return std::make_unique<io::DirectoryLock>(path, signature);
      })) {}

namespace {

/// Of a run that has not come to its first checkpoint yet, nothing but its lock tells that it goes
/// on.
void reject_run_that_begins(const fs::path& path) {
  if (!has_only_begun(path)) return;
  if (const auto holder = io::DirectoryLock::holder(path))
    throw UnusableInput(path.string() + ": " + io::in_use_by + *holder
                        + "; wait until that ends, or choose another directory with --out");
}

void reject_occupied_directory(const fs::path& path) {
  if (fs::exists(path) && !fs::is_directory(path))
    throw UnusableInput(path.string() + ": is no directory; choose another one with --out");
  if (fs::exists(path / io::manifest_name))
    throw UnusableInput(path.string() + ": holds a sweep; choose another directory with --out");
  const bool holds_run =
      fs::exists(path / io::run_file_name) || fs::exists(path / io::trajectory_name)
      || fs::exists(path / io::trajectory_index_name) || fs::exists(path / post_mortem_name)
      || fs::exists(path / io::summary_name) || has_checkpoint(path);
  if (holds_run && has_only_begun(path))
    throw UnusableInput(path.string()
                        + ": holds a run that was stopped before its first checkpoint; "
                          "remove it, or choose another directory with --out");
  if (holds_run)
    throw UnusableInput(path.string() + ": holds a run already; choose another directory with --out"
                        + (has_checkpoint(path)
                               ? ", or go on with that run by '" + call_of("resume", path) + "'"
                               : ""));
  const fs::path settings = path / io::effective_settings_name;
  if (fs::exists(settings) && !holds_own_settings(path))
    throw UnusableInput(settings.string()
                        + ": was not written by riesel, and would be overwritten; move it away, "
                          "or choose another directory with --out");
}

}  // namespace

RunDirectory RunDirectory::create(const fs::path& path, const io::Settings& settings) {
  reject_run_that_begins(path);
  reject_occupied_directory(path);
  io::make_directories(path);
  RunDirectory directory(path, io::Signature::now);
  reject_occupied_directory(path);  // again: before it was locked, another run may have begun in it
  io::write_durably(directory.file(io::effective_settings_name), text_of(settings));
  return directory;
}

RunDirectory RunDirectory::reopen(const fs::path& path) {
  if (!fs::exists(path / io::run_file_name))
    throw UnusableInput((path / io::run_file_name).string()
                        + ": is missing; restore the file, or start the run again elsewhere");
  return {path, io::Signature::later};
}

std::optional<RunDirectory::SetAside> RunDirectory::go_on(const io::Settings& settings,
                                                          bool is_over) const {
  lock_->sign();
  const std::string text = text_of(settings);
  const fs::path settings_file = file(io::effective_settings_name);
  SetAside before{.settings = io::beginning_of(settings_file, io::largest_settings_text)};
  if (is_over && same_settings(before.settings, text)) return {};
  // The result first, so that it never stands beside settings that are not its own.
  const fs::path summary = file(io::summary_name);
  std::error_code error;
  fs::rename(summary, io::previous_generation(summary), error);
  if (error && error != std::errc::no_such_file_or_directory)
    throw io::system_failure(summary, "cannot be set aside", error.value());
  before.has_result = !error;
  try {
    io::write_durably(settings_file, text);
  } catch (const io::FileError&) {
    go_back(before);
    throw;
  }
  return before;
}

void RunDirectory::go_back(const SetAside& before) const {
  const fs::path settings = file(io::effective_settings_name), summary = file(io::summary_name);
  try {
    const bool same = io::beginning_of(settings, io::largest_settings_text) == before.settings;
    if (!same) io::write_durably(settings, before.settings);
  } catch (const io::FileError&) {
    return;  // the result must not stand beside settings that are not its own
  }
  if (!before.has_result) return;
  std::error_code ignored;  // what made the run fail is told
  fs::rename(io::previous_generation(summary), summary, ignored);
}

void RunDirectory::drop_report() const {
  if (!is_own_report(file(report_name))) return;
  try {  // an old report that stays does no harm to results
    fs::remove(file(report_name));
    remove_own_drawings(file(figures_name), {});
  } catch (const fs::filesystem_error&) {
  }
}

void RunDirectory::write_summary(const std::string& text) const {
  const fs::path summary = file(io::summary_name);
  io::write_durably(summary, text);
  std::error_code ignored;  // if it stays, it does no harm
  fs::remove(io::previous_generation(summary), ignored);
}

}  // namespace riesel::app
