// The lock of a run's directory, between processes.
#include "io/directory_lock.hpp"
#include "io/file_error.hpp"
#include "tests/io/file_fixture.hpp"

#include <sys/stat.h>

#include <csignal>

using namespace riesel::io;
using namespace file_fixture;

namespace {

std::string error_of_locking(const fs::path& directory) {
  return message_of<FileError>([&] { const DirectoryLock lock(directory); });
}

}  // namespace

TEST_CASE("A directory is locked by one process at a time, and the other one is named") {
  const ScratchDirectory directory;
  {
    const DirectoryLock lock(directory.path());
    const auto expected =
        directory.path().string() + ": is in use by process " + std::to_string(getpid()) + " on ";
    CHECK(in_other_process(
              [&] { return error_of_locking(directory.path()).starts_with(expected) ? 0 : 1; })
          == 0);
  }
  CHECK(in_other_process([&] { return error_of_locking(directory.path()).empty() ? 0 : 1; }) == 0);
}

TEST_CASE("A second lock of a directory in the same process is refused, too") {
  const ScratchDirectory directory;
  const DirectoryLock lock(directory.path());
  CHECK_FALSE(error_of_locking(directory.path()).empty());
}

TEST_CASE("A lock whose file was removed or replaced holds no longer") {
  const ScratchDirectory directory;
  const DirectoryLock lock(directory.path());
  const auto complaint = [&] { return message_of<FileError>([&] { lock.require_in_place(); }); };
  CHECK(complaint().empty());
  fs::remove(directory / ".lock");
  CHECK(complaint()
        == (directory / ".lock").string()
               + ": has been removed or replaced, so another process may be working here; continue "
                 "when none is");
  overwrite(directory / ".lock", "");
  CHECK(contains(complaint(), "has been removed or replaced"));
}

TEST_CASE("A lock that is a link to another file is refused, and that file is left alone") {
  const ScratchDirectory directory;
  overwrite(directory / "precious", "mine");
  fs::create_symlink(directory / "precious", directory / ".lock");
  CHECK(contains(error_of_locking(directory.path()), "cannot be locked"));
  CHECK_FALSE(DirectoryLock::is_held(directory.path()));
  CHECK(contents(directory / "precious") == "mine");
}

TEST_CASE("A lock that is a pipe is refused and not waited for") {
  const ScratchDirectory directory;
  REQUIRE(mkfifo((directory / ".lock").c_str(), 0600) == 0);
  CHECK(contains(error_of_locking(directory.path()), "is no regular file"));
  CHECK_FALSE(DirectoryLock::is_held(directory.path()));
}

TEST_CASE("A holder that has not signed yet is not taken for the one before it") {
  const ScratchDirectory directory;
  REQUIRE(in_other_process([&] {
            const DirectoryLock lock(directory.path());
            return 0;
          })
          == 0);
  REQUIRE(contains(contents(directory / ".lock"), "process "));
  const DirectoryLock lock(directory.path(), Signature::later);
  CHECK(DirectoryLock::holder(directory.path()) == "another process");
}

TEST_CASE("The holder of a lock is told to those who only ask") {
  const ScratchDirectory directory;
  CHECK_FALSE(DirectoryLock::holder(directory.path()));
  {
    const DirectoryLock lock(directory.path());
    CHECK(DirectoryLock::holder(directory.path()).value_or("").starts_with("process "));
  }
  CHECK_FALSE(DirectoryLock::holder(directory.path()));
}

TEST_CASE("The lock of a killed process is gone") {
  const ScratchDirectory directory;
  CHECK(in_other_process([&] {
          const DirectoryLock lock(directory.path());
          return kill(getpid(), SIGKILL);
        })
        == 128 + SIGKILL);
  CHECK(error_of_locking(directory.path()).empty());
}

TEST_CASE("A missing directory cannot be locked") {
  const ScratchDirectory directory;
  CHECK(error_of_locking(directory / "missing")
        == (directory / "missing").string()
               + ": the directory cannot be locked: No such file or directory; check the path");
}
