#include "app/child_process.hpp"

#include "app/interrupt.hpp"
#include "io/uninterrupted.hpp"

#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>

namespace riesel::app {

namespace {

constexpr int exit_cannot_execute = 127;

/// Blocks all signals while it lives. Otherwise a signal that reaches a child between fork and exec
/// would be handled by its parent's handlers, and lost.
class SignalsHeldBack {
public:
  SignalsHeldBack() {
    sigset_t all;
    sigfillset(&all);
    pthread_sigmask(SIG_SETMASK, &all, &before_);
  }
  ~SignalsHeldBack() { pthread_sigmask(SIG_SETMASK, &before_, nullptr); }
  SignalsHeldBack(const SignalsHeldBack&) = delete;
  SignalsHeldBack& operator=(const SignalsHeldBack&) = delete;
  SignalsHeldBack(SignalsHeldBack&&) = delete;
  SignalsHeldBack& operator=(SignalsHeldBack&&) = delete;

  const sigset_t& before() const { return before_; }

private:
  sigset_t before_;
};

/// In the child: only calls that are safe between fork and exec, as the parent may have threads.
[[noreturn]] void become(char* const* arguments, int log, pid_t parent, const sigset_t& signals) {
  setpgid(0, 0);
  prctl(PR_SET_PDEATHSIG, SIGTERM);
  if (getppid() != parent) _exit(exit_cannot_execute);  // the parent died before prctl()
  const int nothing = open("/dev/null", O_RDONLY | O_CLOEXEC);
  dup2(nothing, STDIN_FILENO);
  dup2(log, STDOUT_FILENO);
  dup2(log, STDERR_FILENO);
  forget_interrupts();
  sigprocmask(SIG_SETMASK, &signals, nullptr);
  execv("/proc/self/exe", arguments);
  _exit(exit_cannot_execute);
}

pid_t start(std::vector<std::string> arguments, const std::filesystem::path& log) {
  arguments.insert(arguments.begin(), program_invocation_short_name);
  std::vector<char*> pointers;
  for (std::string& argument : arguments) pointers.push_back(argument.data());
  pointers.push_back(nullptr);

  // O_NONBLOCK, because a plain open() would wait for the reader of a pipe.
  const int descriptor =
      open(log.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK, 0666);
  if (descriptor < 0) throw io::system_failure(log, "cannot be written", errno);
  const pid_t parent = getpid();
  const SignalsHeldBack signals;
  const pid_t child = fork();
  if (child == 0) become(pointers.data(), descriptor, parent, signals.before());
  const int error = errno;
  close(descriptor);
  if (child < 0)
    throw NoProcess(io::system_failure(log, "no process can be started for the run", error));
  return child;
}

}  // namespace

ProcessEnd end_of(int wait_status) {
  if (WIFSIGNALED(wait_status)) return {.status = 0, .signal = WTERMSIG(wait_status)};
  return {.status = WEXITSTATUS(wait_status), .signal = 0};
}

void heed_ends_of_children() { std::signal(SIGCHLD, SIG_DFL); }

ChildProcess::ChildProcess(const std::vector<std::string>& arguments,
                           const std::filesystem::path& log)
    : id_(start(arguments, log)) {}

ChildProcess::~ChildProcess() {
  if (end()) return;
  if (!has_been_sent_a_signal_) send(SIGTERM);
  io::uninterrupted([&] { return waitpid(id_, nullptr, 0); });
}

std::optional<ProcessEnd> ChildProcess::end() {
  int status = 0;
  if (!end_ && waitpid(id_, &status, WNOHANG) == id_) end_ = end_of(status);
  return end_;
}

void ChildProcess::send(int signal) {
  if (!end_) kill(id_, signal);
  has_been_sent_a_signal_ = true;
}

}  // namespace riesel::app
