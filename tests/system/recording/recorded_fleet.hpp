#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "common/bag/bag_reader.hpp"
#include "common/base/ids.hpp"
#include "tests/integration/dds/test_domain.hpp"
#include "tests/support/run_program.hpp"
#include "tests/support/temporary_folder.hpp"

namespace lifeline::test {

/// Generous: a test waits so long only when it fails.
inline constexpr Duration kLong = std::chrono::seconds(150);

/// Real helmets and a coordinator that records, in a domain of the test's own.
class RecordedFleet : public testing::Test {
 protected:
  using Arguments = std::vector<std::string>;

  std::unique_ptr<Program> start(const std::string& name, Arguments arguments) {
    arguments.insert(arguments.end(),
                     {"--domain", domain_.text(), "--qos", qos_, "--mission", "test"});
    return std::make_unique<Program>(arguments, folder_.path() / (name + ".log"));
  }
  std::unique_ptr<Program> start_helmet(const std::string& name, const std::string& source) {
    return start(name, {"lifeline-agent", "run", "--id", name, "--source", source, "--report",
                        path("report-" + name)});
  }
  std::unique_ptr<Program> start_coordinator(const Arguments& more = {}) {
    Arguments arguments{"lifeline-coordinator", "run", "--record", path("records")};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return start("coordinator", arguments);
  }
  /// The only recording; empty while there is none.
  [[nodiscard]] std::filesystem::path bag() const {
    std::error_code ignored;
    for (const auto& entry :
         std::filesystem::directory_iterator(folder_.path() / "records", ignored))
      return entry.path();
    return {};
  }
  /// What `replay --json` says.
  nlohmann::json replay() {
    const Ended ended =
        run_program({"lifeline-coordinator", "replay", bag().string(), "--speed", "max", "--json"},
                    folder_.path() / "replay.log", kLong);
    EXPECT_EQ(ended.status, 0) << ended.output;
    auto said = nlohmann::json::parse(ended.output, nullptr, false);
    EXPECT_FALSE(said.is_discarded()) << ended.output;
    return said;
  }
  std::vector<bag::Message> messages() {
    std::vector<bag::Message> all;
    auto reader = bag::BagReader::open(bag().string());
    EXPECT_TRUE(reader) << reader.error().text;
    while (reader) {
      auto message = reader->next();
      EXPECT_TRUE(message) << message.error().text;
      if (!message || !*message) break;
      all.push_back(**std::move(message));
    }
    return all;
  }
  [[nodiscard]] std::string path(const std::string& name) const {
    return (folder_.path() / name).string();
  }

  TestDomain domain_, ros2_domain_;
  support::TemporaryFolder folder_;
  std::string qos_ = LIFELINE_SOURCE_DIR "/config/qos/loopback.xml";
};

}  // namespace lifeline::test
