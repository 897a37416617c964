#include "io/file_error.hpp"

#include "io/build_info.hpp"

#include <cerrno>
#include <system_error>
#include <utility>

namespace riesel::io {
namespace {

std::string remedy_for(int error_number) {
  switch (error_number) {
  case ENOSPC:
  case EDQUOT:
    return "free some space on its disk, or choose a directory on another one";
  case EFBIG:
    return "raise the limit on the size of files (ulimit -f)";
  case EACCES:
  case EPERM:
    return "check the permissions, or choose another directory";
  case EROFS:
    return "choose a directory on a disk that is not read-only";
  case ENOENT:
    return "check the path";
  case ELOOP:
    return "remove the link that stands there, or choose another path";
  case ENOTDIR:
  case EISDIR:
  case ENAMETOOLONG:
    return "choose another path";
  case EMFILE:
  case ENFILE:
    return "raise the limit on open files (ulimit -n)";
  default:
    return "check the disk, or choose a directory on another one";
  }
}

}  // namespace

FileError::FileError(std::filesystem::path file, std::string problem, std::string remedy)
    : std::runtime_error(file.string() + ": " + problem + "; " + remedy),
      file_(std::move(file)),
      problem_(std::move(problem)),
      remedy_(std::move(remedy)) {}

FileError of_another_version(const std::filesystem::path& file, const std::string& difference,
                             const std::string& version) {
  return {file, difference, "use riesel " + version + ", which wrote it, or make the run again"};
}

void reject_another_version(const std::filesystem::path& file, const std::string& flaw,
                            const std::string& version) {
  if (version.empty() || version == build_info().version) return;
  throw of_another_version(file, "does not fit this version of riesel (" + flaw + ")", version);
}

FileError system_failure(const std::filesystem::path& file, const std::string& action,
                         int error_number) {
  return {file, action + ": " + std::generic_category().message(error_number),
          remedy_for(error_number)};
}

}  // namespace riesel::io
