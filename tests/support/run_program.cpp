#include "tests/support/run_program.hpp"

#include <csignal>
#include <fstream>
#include <sstream>
#include <thread>

#include "common/base/check.hpp"

namespace lifeline::test {
namespace {

constexpr Duration kPoll = std::chrono::milliseconds(20);

demo::ChildProcess start(std::vector<std::string> arguments, const std::filesystem::path& log) {
  arguments[0] = (std::filesystem::path(LIFELINE_PROGRAM_DIR) / arguments[0]).string();
  auto child = demo::ChildProcess::start({std::move(arguments), log, false});
  LIFELINE_CHECK(child.has_value());
  return *std::move(child);
}

}  // namespace

Program::Program(const std::vector<std::string>& arguments, const std::filesystem::path& log)
    : log_(log), child_(start(arguments, log)) {}

Ended Program::wait(Duration deadline) {
  const auto end = std::chrono::steady_clock::now() + deadline;
  while (std::chrono::steady_clock::now() < end) {
    if (const auto status = child_.ended()) return {*status, output()};
    std::this_thread::sleep_for(kPoll);
  }
  child_.send(SIGKILL);
  return {-1, output()};
}

bool Program::wait_for_output(const std::string& text, Duration deadline) {
  const auto end = std::chrono::steady_clock::now() + deadline;
  while (std::chrono::steady_clock::now() < end) {
    const bool ended = child_.ended().has_value();
    if (output().find(text) != std::string::npos) return true;
    if (ended) return false;
    std::this_thread::sleep_for(kPoll);
  }
  return false;
}

std::string Program::output() const {
  std::ostringstream text;
  text << std::ifstream(log_).rdbuf();
  return text.str();
}

Ended run_program(const std::vector<std::string>& arguments, const std::filesystem::path& log,
                  Duration deadline) {
  return Program(arguments, log).wait(deadline);
}

std::size_t lines_with(const std::string& output, const std::string& text) {
  std::istringstream lines(output);
  std::size_t count = 0;
  for (std::string line; std::getline(lines, line);)
    count += line.find(text) == std::string::npos ? 0 : 1;
  return count;
}

}  // namespace lifeline::test
