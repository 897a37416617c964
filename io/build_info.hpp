// What this program was built from and how: part of the provenance of every result, and of `riesel
// --version`.
//
// The definition is generated at build time (cmake/WriteBuildInfo.cmake), so that the commit is
// that of the build and not that of the last run of cmake; only one small file is compiled again
// when it changes.
#pragma once

#include <string>
#include <string_view>

namespace riesel {

struct BuildInfo {
  std::string_view version;     ///< of the project, "0.1.0"
  std::string_view git_commit;  ///< full hash, or "unknown" outside a git checkout
  bool git_dirty;               ///< tracked files differed from that commit
  std::string_view compiler;    ///< "GNU 12.2.0"
  std::string_view flags;       ///< the options that affect speed and arithmetic
  std::string_view build_type;  ///< "Release", ...
};

const BuildInfo& build_info();

/// "riesel 0.1.0, commit 0123abcd", and ", changed" if it was dirty.
std::string written_by();

}  // namespace riesel
