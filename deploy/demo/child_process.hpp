#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <signal.h>
#include <sys/types.h>

#include "common/base/result.hpp"
#include "common/base/time.hpp"

namespace lifeline::demo {

/// What to start: `arguments[0]` is the program's path.
struct ChildCommand {
  std::vector<std::string> arguments;
  std::filesystem::path log;     ///< takes what it writes to stderr, and to stdout unless:
  bool inherits_stdout = false;  ///< its stdout is ours
};

/// A program of ours that runs beside us, in a process group of its own (a terminal's Ctrl-C
/// reaches us alone). It is killed when this object goes and, by the kernel, when the thread that
/// started it dies in whatever way: nothing is left running.
class ChildProcess {
 public:
  /// unavailable, naming program and reason, where it cannot be started.
  [[nodiscard]] static Result<ChildProcess> start(const ChildCommand& command);

  ChildProcess(ChildProcess&& other) noexcept;
  ChildProcess& operator=(ChildProcess&&) = delete;
  ~ChildProcess();

  /// How it ended: its exit status, or 128 + signal; empty while it runs. Never waits.
  [[nodiscard]] std::optional<int> ended();

  [[nodiscard]] pid_t pid() const { return pid_; }

  /// Sends `signal` to the process and what it started, unless it has ended.
  void send(int signal);

 private:
  explicit ChildProcess(pid_t pid) : pid_(pid) {}

  pid_t pid_;  ///< -1 once moved from
  std::optional<int> status_;
};

/// Blocks SIGINT, SIGTERM, SIGHUP and SIGCHLD as long as it lives and hands them out one by one, so
/// that a single thread can wait for children and people alike. Children start with all unblocked.
class SignalWatch {
 public:
  enum class Event { child_ended, asked_to_stop, time_passed };

  SignalWatch();
  ~SignalWatch();
  SignalWatch(const SignalWatch&) = delete;
  SignalWatch& operator=(const SignalWatch&) = delete;

  /// The next signal, or time_passed when none came within `at_most`.
  [[nodiscard]] Event wait(Duration at_most);

 private:
  sigset_t watched_;
  sigset_t before_;
};

}  // namespace lifeline::demo
