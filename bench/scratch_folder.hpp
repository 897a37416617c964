// A place for files that nobody wants any more when they have served. What an interrupted run has
// left of it is in nobody's way.
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
