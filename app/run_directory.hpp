// The directory of a run: what is in it, and that no two processes write to it.
#pragma once

#include "io/directory_lock.hpp"
#include "io/settings.hpp"

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace riesel::app {

/// How the program was called, for the provenance.
using Arguments = std::vector<std::string>;

/// The last state of a run that failed, as a checkpoint.
inline constexpr auto post_mortem_name = "post_mortem.h5";

/// Of either generation.
bool has_checkpoint(const std::filesystem::path& directory);

/// Whether it holds a run that has begun, but has nothing to go on from, and no result.
bool stopped_before_checkpoint(const std::filesystem::path& directory);

class RunDirectory {
public:
  /// Makes the directory and puts effective.yaml in it. Throws UnusableInput if there is a run or a
  /// sweep in it already, io::FileError if it cannot be written.
  static RunDirectory create(const std::filesystem::path& path, const io::Settings& settings);
  /// The directory of a run that is to go on. Nothing in it is changed.
  static RunDirectory reopen(const std::filesystem::path& path);
  /// Nothing is in the way of the run: its settings may have changed, and it has no result now but
  /// summary.json.previous.
  void go_on(const io::Settings& settings) const;
  /// The report is that of the run before it went on.
  void drop_report() const;
  /// The result. Throws io::FileError.
  void write_summary(const std::string& text) const;

  std::filesystem::path file(const std::string& name) const { return path_ / name; }
  const std::filesystem::path& path() const { return path_; }

  /// Throws io::FileError if the directory was moved away or removed meanwhile.
  void require_in_place() const { lock_->require_in_place(); }

private:
  RunDirectory(const std::filesystem::path& path, io::Signature signature);
  void write_settings(const io::Settings& settings) const;

  std::filesystem::path path_;
  std::unique_ptr<io::DirectoryLock> lock_;
};

}  // namespace riesel::app
