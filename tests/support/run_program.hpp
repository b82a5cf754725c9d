#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "common/base/time.hpp"
#include "deploy/demo/child_process.hpp"

namespace lifeline::test {

/// How a program ended, and all that it wrote to stdout and stderr.
struct Ended {
  int status = -1;  ///< -1: it did not end in time and was killed
  std::string output;
};

/// A program of ours that runs beside the test; killed with it.
class Program {
 public:
  /// `arguments[0]` is a program's name in the build's bin folder.
  Program(const std::vector<std::string>& arguments, const std::filesystem::path& log);

  /// Waits for its end, at most `deadline`.
  [[nodiscard]] Ended wait(Duration deadline);
  /// Waits until `text` stands in its output. False: it did not in time, or the program ended
  /// without it.
  [[nodiscard]] bool wait_for_output(const std::string& text, Duration deadline);
  void send(int signal) { child_.send(signal); }
  [[nodiscard]] std::string output() const;

 private:
  std::filesystem::path log_;
  demo::ChildProcess child_;
};

/// Runs a program to its end.
[[nodiscard]] Ended run_program(const std::vector<std::string>& arguments,
                                const std::filesystem::path& log,
                                Duration deadline = std::chrono::seconds(60));

/// Lines of `output` that hold `text`.
[[nodiscard]] std::size_t lines_with(const std::string& output, const std::string& text);

}  // namespace lifeline::test
