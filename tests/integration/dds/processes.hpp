#pragma once

#include <chrono>
#include <memory>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/integration/dds/test_domain.hpp"
#include "tests/support/run_program.hpp"
#include "tests/support/temporary_folder.hpp"

namespace lifeline::test {

/// Generous: a test waits so long only when it fails.
inline constexpr Duration kPatience = std::chrono::seconds(30);

/// The lines of a program's output that are JSON objects.
inline std::vector<nlohmann::json> json_lines(const std::string& output) {
  std::vector<nlohmann::json> objects;
  std::istringstream lines(output);
  for (std::string line; std::getline(lines, line);) {
    auto object = nlohmann::json::parse(line, nullptr, false);
    if (object.is_object()) objects.push_back(std::move(object));
  }
  return objects;
}

/// Those with `field` equal to `value`.
inline std::vector<nlohmann::json> json_lines(const std::string& output, const std::string& field,
                                              const std::string& value) {
  std::vector<nlohmann::json> chosen;
  for (auto& object : json_lines(output)) {
    if (object.value(field, "") == value) chosen.push_back(std::move(object));
  }
  return chosen;
}

/// Real processes, in a domain of the test's own.
class DdsProcesses : public ::testing::Test {
 protected:
  using Arguments = std::vector<std::string>;

  /// Starts a program of the build with `--domain`.
  std::unique_ptr<Program> start(const std::string& program, const Arguments& arguments) {
    Arguments all{program, "--domain", domain_.text()};
    all.insert(all.end(), arguments.begin(), arguments.end());
    const auto log = folder_.path() / (std::to_string(++started_) + ".log");
    return std::make_unique<Program>(all, log);
  }
  std::unique_ptr<Program> probe(const Arguments& arguments) {
    return start("lifeline-dds-probe", arguments);
  }
  /// A probe that publishes, once all is written.
  std::unique_ptr<Program> publisher(Arguments arguments) {
    arguments.insert(arguments.begin(), "publish");
    arguments.insert(arguments.end(), {"--seconds", "60"});
    auto program = probe(arguments);
    EXPECT_TRUE(program->wait_for_output("\"event\":\"written\"", kPatience)) << program->output();
    return program;
  }

  TestDomain domain_;
  support::TemporaryFolder folder_;

 private:
  int started_ = 0;
};

}  // namespace lifeline::test
