#pragma once

#include <chrono>
#include <csignal>
#include <fstream>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "common/base/ids.hpp"
#include "tests/integration/dds/test_domain.hpp"
#include "tests/support/run_program.hpp"
#include "tests/support/temporary_folder.hpp"

namespace lifeline::test {

/// Two heads in one building; to be followed by which.
inline const std::string kWalk =
    "sim:office?walkers=2&rate=x4&beams=400&seed=1&duration=60&walker=";

/// Generous: a test waits so long only when it fails.
inline constexpr Duration kLong = std::chrono::seconds(150);

/// Real helmets and coordinators in a domain of the test's own, each with a state on disk. Killed
/// without warning and started again under the same names.
class KilledFleet : public testing::Test {
 protected:
  using Arguments = std::vector<std::string>;

  /// Starts a program; one that ran under this name before is killed first.
  Program& start(const std::string& name, Arguments arguments, bool keeps_state = true) {
    programs_.erase(name);
    arguments.insert(arguments.end(), {"--domain", domain_.text(), "--qos", qos_, "--mission",
                                       mission_, "--report", report(name)});
    if (keeps_state) arguments.insert(arguments.end(), {"--state", state()});
    const auto log = folder_.path() / (name + "-" + std::to_string(++starts_) + ".log");
    return *programs_.emplace(name, std::make_unique<Program>(arguments, log)).first->second;
  }
  Program& start_helmet(const std::string& name, const std::string& source) {
    return start(name, {"lifeline-agent", "run", "--id", name, "--source", source});
  }
  /// kill -9, and not before it is dead.
  void kill(const std::string& name) {
    Program& program = *programs_.at(name);
    program.send(SIGKILL);
    ASSERT_EQ(program.wait(kLong).status, 128 + SIGKILL);
  }
  void expect(const std::string& name, const std::string& text) {
    Program& program = *programs_.at(name);
    ASSERT_TRUE(program.wait_for_output(text, kLong)) << name << ": " << program.output();
  }
  /// Ends in good order; its report.
  nlohmann::json stop(const std::string& name) {
    Program& program = *programs_.at(name);
    program.send(SIGTERM);
    const Ended ended = program.wait(kLong);
    EXPECT_EQ(ended.status, 0) << name << ": " << ended.output;
    return read(name, name + ".json");
  }
  nlohmann::json read(const std::string& name, const std::string& file) {
    std::ifstream stream(report(name) + "/" + file);
    return nlohmann::json::parse(stream, nullptr, false);
  }
  [[nodiscard]] std::string report(const std::string& name) const {
    return (folder_.path() / ("report-" + name)).string();
  }
  [[nodiscard]] std::string state() const { return (folder_.path() / "state").string(); }
  Program& program(const std::string& name) { return *programs_.at(name); }
  [[nodiscard]] const std::string& mission() const { return mission_; }
  [[nodiscard]] const std::string& qos() const { return qos_; }

  TestDomain domain_;
  support::TemporaryFolder folder_;

 private:
  std::map<std::string, std::unique_ptr<Program>> programs_;
  int starts_ = 0;
  std::string mission_ = "test-" + std::to_string(random_incarnation().value % 1'000'000'000);
  std::string qos_ = LIFELINE_SOURCE_DIR "/config/qos/loopback.xml";
};

}  // namespace lifeline::test
