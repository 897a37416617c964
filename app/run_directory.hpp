// The directory of a run: what is in it, and a lock so that no two processes write to it.
#pragma once

#include "io/directory_lock.hpp"
#include "io/settings.hpp"

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace riesel::app {

/// How the program was called, for the provenance.
using Arguments = std::vector<std::string>;

/// The last state of a run that failed, as a checkpoint.
inline constexpr auto post_mortem_name = "post_mortem.h5";

/// Where results go without --out: the directory PARENT/NAME for the file NAME.yaml. Throws
/// UnusableInput for a name that would lead elsewhere ("..yaml").
std::filesystem::path place_named_after(const std::filesystem::path& file,
                                        const std::filesystem::path& parent);

/// Whether there is a checkpoint of either generation, the current or the previous one.
bool has_checkpoint(const std::filesystem::path& directory);

/// Whether it holds effective.yaml as riesel writes it, and not a file of that name by the user.
bool holds_own_settings(const std::filesystem::path& directory);

/// Whether it holds a run that has begun, but has neither a checkpoint nor a result.
bool has_only_begun(const std::filesystem::path& directory);

class RunDirectory {
public:
  /// What was there before a run went on.
  struct SetAside {
    std::string settings;     ///< the text of effective.yaml
    bool has_result = false;  ///< now summary.json.previous
  };

  /// Makes the directory and puts effective.yaml in it. Throws UnusableInput if there is a run or a
  /// sweep in it already, or another effective.yaml, io::FileError if it cannot be written.
  static RunDirectory create(const std::filesystem::path& path, const io::Settings& settings);
  /// The directory of a run that is to go on. Changes nothing in it. Throws UnusableInput if run.h5
  /// is missing.
  static RunDirectory reopen(const std::filesystem::path& path);
  /// Prepares the directory for a run that goes on: renames its result, summary.json, to
  /// summary.json.previous, then writes effective.yaml anew, as settings may have changed. Does
  /// neither if the run `is_over` and the settings are the same. Returns what go_back() needs.
  /// Throws io::FileError; the result is in its place then.
  std::optional<SetAside> go_on(const io::Settings& settings, bool is_over) const;
  /// Undoes go_on() if nothing has been saved since: the settings, and the result, count again.
  void go_back(const SetAside& before) const;
  /// Removes the report and its figures, which are out of date once the run has gone on, if the
  /// report is riesel's.
  void drop_report() const;
  /// Writes summary.json and removes its previous version. Throws io::FileError.
  void write_summary(const std::string& text) const;

  std::filesystem::path file(const std::string& name) const { return path_ / name; }
  const std::filesystem::path& path() const { return path_; }

  /// Throws io::FileError if the directory has been moved or removed since.
  void require_in_place() const { lock_->require_in_place(); }

private:
  RunDirectory(const std::filesystem::path& path, io::Signature signature);
  std::filesystem::path path_;
  std::unique_ptr<io::DirectoryLock> lock_;
};

}  // namespace riesel::app
