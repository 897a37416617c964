// What is wrong with a file or directory, said in a way that lets the user put it right: which one,
// the problem and the remedy.
#pragma once

#include <filesystem>
#include <stdexcept>
#include <string>

namespace riesel::io {

/// A file or directory that cannot be written, read or trusted. what() is "FILE: problem; remedy",
/// on one line.
class FileError : public std::runtime_error {
public:
  FileError(std::filesystem::path file, std::string problem, std::string remedy);

  const std::filesystem::path& file() const { return file_; }
  const std::string& problem() const { return problem_; }
  const std::string& remedy() const { return remedy_; }

private:
  std::filesystem::path file_;
  std::string problem_;
  std::string remedy_;
};

/// A file whose format this riesel does not read.
class OtherFormat : public FileError {
public:
  using FileError::FileError;
};

/// A directory that another process has locked.
class InUse : public FileError {
public:
  using FileError::FileError;
};

/// The error for a file that riesel `version` wrote and this one does not read; `difference` is the
/// problem.
FileError of_another_version(const std::filesystem::path& file, const std::string& difference,
                             const std::string& version);

/// Throws that error, with `flaw` in it, if the `version` that wrote the file is known (not empty)
/// and not this one.
void reject_another_version(const std::filesystem::path& file, const std::string& flaw,
                            const std::string& version);

/// The error for a failed system call: the problem is `action` ("cannot be written") followed by
/// the system's text for `error_number` (an errno), which also decides the remedy.
FileError system_failure(const std::filesystem::path& file, const std::string& action,
                         int error_number);

}  // namespace riesel::io
