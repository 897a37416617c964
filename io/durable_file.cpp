#include "io/durable_file.hpp"

#include "io/descriptor.hpp"
#include "io/file_error.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>
#include <utility>

namespace riesel::io {
namespace {

namespace fs = std::filesystem;

fs::path with_suffix(fs::path path, const char* suffix) { return path += suffix; }

/// The directory that the file is in; errors name the file.
Descriptor directory_of(const fs::path& path) {
  const auto parent = path.parent_path();
  return {parent.empty() ? "." : parent, O_RDONLY | O_DIRECTORY, path};
}

/// Removes a file of this name at both ends of its life; a file that was renamed meanwhile stays.
class Leftover {
public:
  explicit Leftover(fs::path path) : path_(std::move(path)) { unlink(path_.c_str()); }
  ~Leftover() { unlink(path_.c_str()); }
  Leftover(const Leftover&) = delete;
  Leftover& operator=(const Leftover&) = delete;
  Leftover(Leftover&&) = delete;
  Leftover& operator=(Leftover&&) = delete;

  const fs::path& path() const { return path_; }

private:
  fs::path path_;
};

void write_aside(const fs::path& aside, std::string_view content, const fs::path& path) {
  Descriptor file(aside, O_WRONLY | O_CREAT | O_EXCL, path);
  file.write(content);
  file.sync();
  file.close();
}

/// File systems such as FAT, and some in user space, have no hard links.
bool means_no_links(int error_number) {
  return error_number == EPERM || error_number == EOPNOTSUPP || error_number == ENOSYS
         || error_number == EMLINK;
}

/// Gives the present generation, if there is one, a second name, from which it will become the
/// previous one; returns whether it did. Without hard links it becomes the previous one at once:
/// until the next generation is in place it is the only one, and readers that look for both find
/// it.
bool link_present(const fs::path& path, const fs::path& second) {
  if (link(path.c_str(), second.c_str()) == 0) return true;
  if (errno == ENOENT) return false;
  if (means_no_links(errno)) {
    if (rename(path.c_str(), previous_generation(path).c_str()) == 0) return false;
    if (errno == ENOENT) return false;
  }
  throw system_failure(path, "the previous generation cannot be kept", errno);
}

void rename_to(const fs::path& from, const fs::path& to, const fs::path& path) {
  if (rename(from.c_str(), to.c_str()) != 0) {
    throw system_failure(path, "cannot be replaced", errno);
  }
}

}  // namespace

void sync_directory_of(const fs::path& path) { directory_of(path).sync(); }

void write_durably(const fs::path& path, std::string_view content, Previous previous) {
  Descriptor directory = directory_of(path);
  directory.lock();
  const Leftover aside(with_suffix(path, ".tmp"));
  const Leftover replaced(with_suffix(path, ".replaced"));
  write_aside(aside.path(), content, path);
  const bool keeps = previous == Previous::keep && link_present(path, replaced.path());
  rename_to(aside.path(), path, path);
  if (keeps) rename_to(replaced.path(), previous_generation(path), path);
  directory.sync();
}

void replace_by_copy(const fs::path& path) {
  Descriptor directory = directory_of(path);
  directory.lock();
  const Leftover aside(with_suffix(path, ".tmp"));
  std::error_code error;
  fs::copy_file(path, aside.path(), error);
  if (error) throw system_failure(path, "cannot be copied", error.value());
  Descriptor(aside.path(), O_RDWR, path).sync();
  rename_to(aside.path(), path, path);
  directory.sync();
}

void make_directories(const fs::path& path) {
  const fs::path parent = path.parent_path();
  std::error_code error;
  if (!parent.empty() && !fs::exists(parent, error)) make_directories(parent);
  const bool is_new = fs::create_directory(path, error);
  if (error == std::errc::file_exists) error = std::make_error_code(std::errc::not_a_directory);
  if (error) throw system_failure(path, "cannot be made", error.value());
  if (is_new) sync_directory_of(path);
}

fs::path previous_generation(const fs::path& path) { return with_suffix(path, ".previous"); }

}  // namespace riesel::io
