#include "deploy/demo/child_process.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <utility>

#include <fcntl.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

namespace lifeline::demo {
namespace {

/// Of the child, between fork and exec: system calls only. Returns errno on failure.
int become(char* const* arguments, const char* log, bool inherits_stdout, pid_t parent) {
  setpgid(0, 0);
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (getppid() != parent) _exit(1);  // died before prctl could tell us
  sigset_t none;
  sigemptyset(&none);
  sigprocmask(SIG_SETMASK, &none, nullptr);
  const int input = open("/dev/null", O_RDONLY);
  const int output = open(log, O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644);
  if (input < 0 || output < 0) return errno;
  dup2(input, STDIN_FILENO);
  dup2(output, STDERR_FILENO);
  if (!inherits_stdout) dup2(output, STDOUT_FILENO);
  execv(arguments[0], arguments);
  return errno;
}

std::vector<char*> argument_pointers(std::vector<std::string>& arguments) {
  std::vector<char*> pointers;
  pointers.reserve(arguments.size() + 1);
  for (std::string& argument : arguments) pointers.push_back(argument.data());
  pointers.push_back(nullptr);
  return pointers;
}

}  // namespace

Result<ChildProcess> ChildProcess::start(const ChildCommand& command) {
  std::vector<std::string> arguments = command.arguments;
  const std::vector<char*> pointers = argument_pointers(arguments);
  std::array<int, 2> failure{};  // closes by itself on exec; carries errno when there is none
  if (pipe2(failure.data(), O_CLOEXEC) != 0) {
    return fail(ErrorCode::unavailable, "cannot make a pipe: {}", std::strerror(errno));
  }
  const pid_t parent = getpid();
  const pid_t pid = fork();
  if (pid == 0) {
    const int error = become(pointers.data(), command.log.c_str(), command.inherits_stdout, parent);
    [[maybe_unused]] const ssize_t written = write(failure[1], &error, sizeof error);
    _exit(127);
  }
  int error = pid < 0 ? errno : 0;
  close(failure[1]);
  const bool told = pid > 0 && read(failure[0], &error, sizeof error) > 0;
  close(failure[0]);
  if (told) waitpid(pid, nullptr, 0);
  if (told || pid < 0) {
    return fail(ErrorCode::unavailable, "cannot start {} (its log: {}): {}", arguments[0],
                command.log.string(), std::strerror(error));
  }
  return ChildProcess(pid);
}

ChildProcess::ChildProcess(ChildProcess&& other) noexcept
    : pid_(std::exchange(other.pid_, -1)), status_(other.status_) {}

ChildProcess::~ChildProcess() {
  if (pid_ < 0 || ended()) return;
  send(SIGKILL);
  waitpid(pid_, nullptr, 0);
}

std::optional<int> ChildProcess::ended() {
  int status = 0;
  if (!status_ && waitpid(pid_, &status, WNOHANG) == pid_) {
    status_ = WIFSIGNALED(status) ? 128 + WTERMSIG(status) : WEXITSTATUS(status);
  }
  return status_;
}

void ChildProcess::send(int signal) {
  if (ended()) return;
  kill(-pid_, signal);  // its group is there: start() waited for the exec
}

SignalWatch::SignalWatch() {
  sigemptyset(&watched_);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGCHLD}) sigaddset(&watched_, signal);
  sigprocmask(SIG_BLOCK, &watched_, &before_);
}

SignalWatch::~SignalWatch() {
  sigprocmask(SIG_SETMASK, &before_, nullptr);
}

SignalWatch::Event SignalWatch::wait(Duration at_most) {
  const auto nanoseconds = std::max<Duration::rep>(at_most.count(), 0);
  const timespec timeout{static_cast<time_t>(nanoseconds / 1'000'000'000),
                         static_cast<long>(nanoseconds % 1'000'000'000)};
  const int signal = sigtimedwait(&watched_, nullptr, &timeout);
  if (signal == SIGCHLD) return Event::child_ended;
  return signal > 0 ? Event::asked_to_stop : Event::time_passed;
}

}  // namespace lifeline::demo
