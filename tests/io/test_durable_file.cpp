// Files that survive: what is there after success, and after each kind of failure. The failures are
// real ones: a size limit, a full file system, missing permissions.
#include "io/durable_file.hpp"
#include "io/file_error.hpp"
#include "tests/io/file_fixture.hpp"

#include <fcntl.h>
#include <sched.h>
#include <sys/mount.h>
#include <sys/resource.h>
#include <sys/stat.h>

#include <csignal>
#include <future>

using namespace riesel::io;
using namespace file_fixture;

namespace {

using Names = std::vector<std::string>;

std::string error_of_writing(const fs::path& path, const std::string& content,
                             Previous previous = Previous::discard) {
  return message_of<FileError>([&] { write_durably(path, content, previous); });
}

/// Gives this process the right to mount, in a view of the file system of its own. The system may
/// refuse.
bool may_mount() {
  const auto user = std::to_string(geteuid()), group = std::to_string(getegid());
  if (unshare(CLONE_NEWUSER | CLONE_NEWNS) != 0) return false;
  std::ofstream("/proc/self/setgroups") << "deny";
  std::ofstream("/proc/self/uid_map") << "0 " + user + " 1";
  std::ofstream("/proc/self/gid_map") << "0 " + group + " 1";
  return geteuid() == 0 && getegid() == 0;
}

}  // namespace

TEST_CASE("A durable file has its content and leaves nothing else behind") {
  const ScratchDirectory directory;
  const auto content = std::string("a\0b", 3) + std::string(100'000, 'x');
  write_durably(directory / "a.json", "old");
  write_durably(directory / "a.json", content);
  CHECK(contents(directory / "a.json") == content);
  CHECK(directory.names() == Names{"a.json"});
}

TEST_CASE("A durable file may be empty, and in the current directory") {
  const ScratchDirectory directory;
  const auto before = fs::current_path();
  fs::current_path(directory.path());
  write_durably("a.json", "");
  fs::current_path(before);
  CHECK(contents(directory / "a.json").empty());
}

TEST_CASE("A durable file keeps the generation before") {
  const ScratchDirectory directory;
  const auto path = directory / "c.h5";
  write_durably(path, "1", Previous::keep);
  CHECK(directory.names() == Names{"c.h5"});
  write_durably(path, "2", Previous::keep);
  write_durably(path, "3", Previous::keep);
  CHECK(contents(path) == "3");
  CHECK(contents(previous_generation(path)) == "2");
  CHECK(directory.names() == Names{"c.h5", "c.h5.previous"});
}

TEST_CASE("Leftovers of a killed process do not stand in the way of a durable file") {
  const ScratchDirectory directory;
  const auto path = directory / "c.h5";
  write_durably(path, "1", Previous::keep);
  overwrite(directory / "c.h5.tmp", "half a fi");
  overwrite(directory / "c.h5.replaced", "0");
  write_durably(path, "2", Previous::keep);
  CHECK(contents(path) == "2");
  CHECK(contents(previous_generation(path)) == "1");
  CHECK(directory.names() == Names{"c.h5", "c.h5.previous"});
}

TEST_CASE("Of two who write the same file at the same time the later one waits") {
  const ScratchDirectory directory;
  const auto path = directory / "c.h5";
  constexpr int times = 100;
  const auto content = [](char letter) { return std::string(10'000, letter); };
  const auto write = [&](char letter) {
    for (int i = 0; i < times; ++i) write_durably(path, content(letter), Previous::keep);
  };
  write_durably(path, content('a'));
  auto other = std::async(std::launch::async, write, 'b');
  write('a');
  CHECK_NOTHROW(other.get());
  const auto whole = [&](const std::string& text) {
    return text == content('a') || text == content('b');
  };
  CHECK(whole(contents(path)));
  CHECK(whole(contents(previous_generation(path))));
  CHECK_FALSE(fs::exists(directory / "c.h5.tmp"));
}

TEST_CASE("A durable file in a missing directory is an error that says so") {
  const ScratchDirectory directory;
  const auto path = directory / "missing" / "a.json";
  CHECK(error_of_writing(path, "x")
        == path.string() + ": cannot be written: No such file or directory; check the path");
}

TEST_CASE("A durable file cannot replace a directory") {
  const ScratchDirectory directory;
  fs::create_directory(directory / "a");
  CHECK(contains(error_of_writing(directory / "a", "x"), "cannot be replaced: Is a directory"));
  CHECK(directory.names() == Names{"a"});
}

TEST_CASE("A durable file in a read-only directory is an error that leaves the old one") {
  const ScratchDirectory directory;
  const auto path = directory / "a.json";
  write_durably(path, "old");
  fs::permissions(directory.path(), fs::perms::owner_read | fs::perms::owner_exec
                                        | fs::perms::others_read | fs::perms::others_exec);
  const int status = in_other_process([&] {
    constexpr uid_t nobody = 65534;  // permissions do not bind root
    if (geteuid() == 0 && setuid(nobody) != 0) return 1;
    return contains(error_of_writing(path, "new"), "Permission denied; check the permissions") ? 0
                                                                                               : 2;
  });
  fs::permissions(directory.path(), fs::perms::owner_all);
  CHECK(status == 0);
  CHECK(contents(path) == "old");
  CHECK(directory.names() == Names{"a.json"});
}

TEST_CASE("A write that fails half-way leaves the old durable files") {
  const ScratchDirectory directory;
  const auto path = directory / "c.h5";
  write_durably(path, "1", Previous::keep);
  write_durably(path, "2", Previous::keep);
  const int status = in_other_process([&] {
    const rlimit limit = {.rlim_cur = 1000, .rlim_max = 1000};
    std::signal(SIGXFSZ, SIG_IGN);
    if (setrlimit(RLIMIT_FSIZE, &limit) != 0) return 1;
    const auto error = error_of_writing(path, std::string(5000, 'x'), Previous::keep);
    return contains(error, "File too large; raise the limit on the size of files") ? 0 : 2;
  });
  CHECK(status == 0);
  CHECK(contents(path) == "2");
  CHECK(contents(previous_generation(path)) == "1");
  CHECK(directory.names() == Names{"c.h5", "c.h5.previous"});
}

TEST_CASE("A full disk leaves the old durable files, and the remedy is named") {
  constexpr int no_mount = 42;
  const ScratchDirectory directory;
  const auto path = directory / "c.h5";
  const int status = in_other_process([&] {
    if (!may_mount()) return no_mount;
    if (mount("tmpfs", directory.path().c_str(), "tmpfs", 0, "size=64k") != 0) return no_mount;
    write_durably(path, std::string(20'000, '1'), Previous::keep);
    write_durably(path, std::string(20'000, '2'), Previous::keep);
    const auto error = error_of_writing(path, std::string(50'000, '3'), Previous::keep);
    if (!contains(error, "No space left on device; free some space")) return 1;
    if (contents(path) != std::string(20'000, '2')) return 2;
    if (contents(previous_generation(path)) != std::string(20'000, '1')) return 3;
    return directory.names() == Names{"c.h5", "c.h5.previous"} ? 0 : 4;
  });
  if (status == no_mount) WARN("not tested: this system does not let a user mount a small disk");
  CHECK((status == 0 || status == no_mount));
}

TEST_CASE("However often a process is killed, a durable file is one of its generations") {
  const ScratchDirectory directory;
  const auto path = directory / "c.h5";
  const std::string first(300'000, '1'), second(300'000, '2');
  write_durably(path, first, Previous::keep);
  write_durably(path, first, Previous::keep);
  // Killed sooner or later, and where writing is slow, later still: until both contents have come.
  int changes = 0;
  auto last = first;
  constexpr useconds_t usual = 40'000, longest = 10'000'000;
  for (useconds_t microseconds = 0; microseconds < usual || (changes < 2 && microseconds < longest);
       microseconds += microseconds < usual ? 800 : microseconds) {
    const pid_t child = fork();
    REQUIRE(child >= 0);
    if (child == 0) {
      try {
        for (;;) {
          write_durably(path, second, Previous::keep);
          write_durably(path, first, Previous::keep);
        }
      } catch (...) {
        _exit(99);
      }
    }
    usleep(microseconds);
    kill(child, SIGKILL);
    int status = 0;
    REQUIRE(waitpid(child, &status, 0) == child);
    REQUIRE(WIFSIGNALED(status));
    REQUIRE(WTERMSIG(status) == SIGKILL);
    const auto now = contents(path), before = contents(previous_generation(path));
    REQUIRE((now == first || now == second));
    REQUIRE((before == first || before == second));
    if (now != last) ++changes;
    last = now;
  }
  CHECK(changes >= 2);
}
