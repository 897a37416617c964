// A place for files that are gone when they have served, also if an earlier run was interrupted.
#pragma once

#include <filesystem>

namespace riesel::bench {

/// A new folder below `parent`, which is made if need be. It goes with its contents. Throws
/// std::filesystem::filesystem_error.
class ScratchFolder {
public:
  explicit ScratchFolder(const std::filesystem::path& parent);
  ~ScratchFolder();
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;
  ScratchFolder(ScratchFolder&&) = delete;
  ScratchFolder& operator=(ScratchFolder&&) = delete;

  const std::filesystem::path& path() const { return path_; }

private:
  std::filesystem::path path_;
};

}  // namespace riesel::bench
