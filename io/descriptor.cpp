#include "io/descriptor.hpp"

#include "io/file_error.hpp"
#include "io/patient_lock.hpp"
#include "io/uninterrupted.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstddef>
#include <utility>

namespace riesel::io {
namespace {

constexpr std::size_t most_at_once = std::size_t{1} << 30;  // bytes; Linux writes no more at once

}  // namespace

Descriptor::Descriptor(const std::filesystem::path& name, int flags, std::filesystem::path path)
    : path_(std::move(path)),
      descriptor_(uninterrupted([&] { return open(name.c_str(), flags | O_CLOEXEC, 0666); })) {
  check(descriptor_);
}

Descriptor::~Descriptor() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

void Descriptor::write(std::string_view content) {
  while (!content.empty()) {
    const ssize_t written = uninterrupted([&] {
      return ::write(descriptor_, content.data(), std::min(content.size(), most_at_once));
    });
    check(written);
    content.remove_prefix(static_cast<std::size_t>(written));
  }
}

std::string Descriptor::read_at(std::uint64_t offset, std::size_t size) {
  std::string content(size, '\0');
  std::size_t done = 0;
  while (done < size) {
    const ssize_t got = uninterrupted([&] {
      return pread(descriptor_, &content[done], size - done, static_cast<off_t>(offset + done));
    });
    check(got, "cannot be read");
    if (got == 0) break;
    done += static_cast<std::size_t>(got);
  }
  content.resize(done);
  return content;
}

void Descriptor::write_at(std::uint64_t offset, std::string_view content) {
  while (!content.empty()) {
    const ssize_t written = uninterrupted([&] {
      return pwrite(descriptor_, content.data(), std::min(content.size(), most_at_once),
                    static_cast<off_t>(offset));
    });
    check(written);
    offset += static_cast<std::uint64_t>(written);
    content.remove_prefix(static_cast<std::size_t>(written));
  }
}

std::uint64_t Descriptor::size() const { return static_cast<std::uint64_t>(status().st_size); }

bool Descriptor::has_other_names() const { return status().st_nlink > 1; }

void Descriptor::make_at_least(std::uint64_t wanted) {
  if (size() >= wanted) return;
  check(uninterrupted([&] { return ftruncate(descriptor_, static_cast<off_t>(wanted)); }));
}

void Descriptor::sync() {
  check(uninterrupted([&] { return fsync(descriptor_); }));
}

void Descriptor::lock() const {
  static_cast<void>(lock_patiently(descriptor_, std::chrono::seconds(10)));
}

void Descriptor::close() { check(::close(std::exchange(descriptor_, -1))); }

struct stat Descriptor::status() const {
  struct stat about = {};
  check(fstat(descriptor_, &about), "cannot be examined");
  return about;
}

void Descriptor::check(ssize_t result, const char* action) const {
  if (result < 0) throw system_failure(path_, action, errno);
}

}  // namespace riesel::io
