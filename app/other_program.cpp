#include "app/other_program.hpp"

#include "io/uninterrupted.hpp"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>

namespace riesel::app {

namespace {

std::string all_that_comes(int descriptor) {
  std::string text;
  std::array<char, 4096> piece{};
  ssize_t size = 0;
  const auto next = [&] { return read(descriptor, piece.data(), piece.size()); };
  while ((size = io::uninterrupted(next)) > 0)
    text.append(piece.data(), static_cast<std::size_t>(size));
  return text;
}

}  // namespace

std::optional<ProgramEnd> run_other_program(const std::vector<std::string>& arguments,
                                            Complaints complaints) {
  std::vector<std::string> copies = arguments;
  std::vector<char*> pointers;
  for (std::string& argument : copies) pointers.push_back(argument.data());
  pointers.push_back(nullptr);

  std::array<int, 2> ends{};  // to read from, to write to
  if (pipe2(ends.data(), O_CLOEXEC) != 0) return {};
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, ends[1], STDOUT_FILENO);
  if (complaints == Complaints::hidden)
    posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
  pid_t id = 0;
  const int error =
      posix_spawnp(&id, pointers.front(), &actions, nullptr, pointers.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  close(ends[1]);
  std::string output = all_that_comes(ends[0]);
  close(ends[0]);
  if (error != 0) return {};
  int status = 0;
  if (io::uninterrupted([&] { return waitpid(id, &status, 0); }) < 0) return {};
  return ProgramEnd{.how = end_of(status), .output = std::move(output)};
}

}  // namespace riesel::app
