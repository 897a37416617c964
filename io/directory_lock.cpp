#include "io/directory_lock.hpp"

#include "io/file_error.hpp"
#include "io/patient_lock.hpp"
#include "io/uninterrupted.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <optional>
#include <string>
#include <string_view>

namespace riesel::io {
namespace {

constexpr auto cannot_be_locked = "the directory cannot be locked";
constexpr std::string_view beginning = "process ";  // of what a holder writes into the lock

/// Includes the host: on a network file system the process may run elsewhere.
std::string description_of_process(pid_t process) {
  std::array<char, 256> host{};
  gethostname(host.data(), host.size() - 1);
  return fmt::format("{}{} on {}", beginning, process, host.data());
}

/// Whether this describes a process of this host that has ended: an earlier holder.
bool is_of_the_past(const std::string& description) {
  int process = 0;
  return std::sscanf(description.c_str(), "process %d ", &process) == 1
         && description == description_of_process(process) && kill(process, 0) != 0
         && errno == ESRCH;
}

/// What the holder has written into the lock, if it has come to that yet.
std::string description_of_holder(int descriptor) {
  std::array<char, 512> text{};
  const ssize_t size = pread(descriptor, text.data(), text.size(), 0);
  const std::string description(text.data(), static_cast<std::size_t>(std::max<ssize_t>(size, 0)));
  return description.empty() || is_of_the_past(description) ? "another process" : description;
}

/// Whether the file is a lock of ours: a holder has written into it, or began to, or nobody has. A
/// failure of power may have left zeros.
bool is_lock(int descriptor) {
  std::array<char, beginning.size()> text{};
  const ssize_t size = pread(descriptor, text.data(), text.size(), 0);
  return text.front() == '\0'
         || beginning.starts_with(
             std::string_view(text.data(), static_cast<std::size_t>(std::max<ssize_t>(size, 0))));
}

/// is_held() takes the lock for a moment, so a lock that is held may be free a moment later.
constexpr auto patience = std::chrono::milliseconds(40);

/// Negative, with errno set, if it cannot be opened. `flags` are added to those of every lock.
/// O_NONBLOCK, because a plain open() would wait for the writer of a pipe.
int open_lock(const std::filesystem::path& directory, int flags) {
  const auto lock = directory / lock_name;
  return uninterrupted(
      [&] { return open(lock.c_str(), flags | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK, 0666); });
}

bool is_regular(int descriptor) {
  struct stat about = {};
  return fstat(descriptor, &about) == 0 && S_ISREG(about.st_mode);
}

/// The file with this name (`ask` is stat), or an open file, whatever has its name by now (fstat).
/// Nothing if there is none; errno tells why.
template <class File>
std::optional<FileIdentity> identity_by(int (*ask)(File, struct stat*), File file) {
  struct stat about = {};
  if (ask(file, &about) != 0) return std::nullopt;
  return FileIdentity{about.st_dev, about.st_ino};
}

}  // namespace

DirectoryLock::DirectoryLock(const std::filesystem::path& directory, Signature signature)
    : directory_(directory), descriptor_(open_lock(directory, O_RDWR | O_CREAT)) {
  if (descriptor_ < 0) throw system_failure(directory, cannot_be_locked, errno);
  if (!is_regular(descriptor_)) {
    close(descriptor_);
    throw FileError(directory / lock_name, "is no regular file", "remove it");
  }
  if (!is_lock(descriptor_)) {
    close(descriptor_);
    throw FileError(directory / lock_name, "is in the way: riesel has not written it", "move it");
  }
  if (lock_patiently(descriptor_, patience)) {
    if (signature == Signature::now) sign();
    directory_identity_ = identity_by(stat, directory.c_str());
    lock_identity_ = identity_by(fstat, descriptor_);
    return;
  }
  const int error_number = errno;
  const auto holder = description_of_holder(descriptor_);
  close(descriptor_);
  if (error_number != EWOULDBLOCK) {
    throw system_failure(directory, cannot_be_locked, error_number);
  }
  throw InUse(directory, in_use_by + holder, "wait until that ends, or choose another directory");
}

void DirectoryLock::sign() const {
  const auto text = description_of_process(getpid());
  const bool written =
      ftruncate(descriptor_, 0) == 0 && pwrite(descriptor_, text.data(), text.size(), 0) >= 0;
  static_cast<void>(written);  // merely informs: the lock holds without it (on a full disk, say)
}

void DirectoryLock::require_in_place() const {
  const auto found = identity_by(stat, directory_.c_str());
  if (!found) throw system_failure(directory_, "cannot be written any more", errno);
  if (found != directory_identity_)
    throw FileError(directory_, "is no longer the directory in which this started",
                    "continue in the original one, wherever it is now");
  const auto lock = directory_ / lock_name;
  if (identity_by(stat, lock.c_str()) != lock_identity_)
    throw FileError(lock, "has been removed or replaced, so another process may be working here",
                    "continue when none is");
}

bool DirectoryLock::is_held(const std::filesystem::path& directory) {
  return holder(directory).has_value();
}

std::optional<std::string> DirectoryLock::holder(const std::filesystem::path& directory) {
  const int descriptor = open_lock(directory, O_RDONLY);
  if (descriptor < 0) return {};
  std::optional<std::string> holder;
  if (is_regular(descriptor) && flock(descriptor, LOCK_SH | LOCK_NB) != 0 && errno == EWOULDBLOCK)
    holder = description_of_holder(descriptor);
  close(descriptor);
  return holder;
}

DirectoryLock::~DirectoryLock() { close(descriptor_); }

}  // namespace riesel::io
