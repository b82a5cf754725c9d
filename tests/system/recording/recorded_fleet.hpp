#pragma once

#include <filesystem>
#include <memory>
#include <sstream>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <sys/resource.h>
#include <unistd.h>

#include "common/bag/bag_reader.hpp"
#include "common/base/ids.hpp"
#include "tests/integration/dds/test_domain.hpp"
#include "tests/support/run_program.hpp"
#include "tests/support/temporary_folder.hpp"

namespace lifeline::test {

/// Generous: a test waits so long only when it fails.
inline constexpr Duration kLong = std::chrono::seconds(150);

/// The process that this one started and whose command line holds `word`.
inline pid_t child_with(const std::string& word) {
  std::istringstream children(
      support::content_of(fmt::format("/proc/self/task/{}/children", ::getpid())));
  for (pid_t pid = 0; children >> pid;) {
    if (support::content_of(fmt::format("/proc/{}/cmdline", pid)).find(word) != std::string::npos)
      return pid;
  }
  return -1;
}

/// From now on no file of that process grows beyond a limit, as on a full disk.
inline void limit_files(pid_t pid, rlim_t octets) {
  const rlimit limit{octets, RLIM_INFINITY};
  ASSERT_EQ(::prlimit(pid, RLIMIT_FSIZE, &limit, nullptr), 0);
}

/// Real helmets and a coordinator, of which somebody records, in a domain of the test's own.
class RecordedFleet : public testing::Test {
 protected:
  using Arguments = std::vector<std::string>;

  std::unique_ptr<Program> start(const std::string& name, Arguments arguments) {
    arguments.insert(arguments.end(),
                     {"--domain", domain_.text(), "--qos", qos_, "--mission", "test"});
    return std::make_unique<Program>(arguments, folder_.path() / (name + ".log"));
  }
  std::unique_ptr<Program> start_helmet(const std::string& name, const std::string& source,
                                        const Arguments& more = {}) {
    Arguments arguments{"lifeline-agent", "run",  "--id",     name,
                        "--source",       source, "--report", path("report-" + name)};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return start(name, arguments);
  }
  /// One that records.
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
  /// Of who was killed: the bag opens, and says that it was cut off. How much of the time before is
  /// missing from it.
  Duration missing_before(Timestamp killed) {
    const auto recorded = messages();
    EXPECT_GT(recorded.size(), 10U);
    EXPECT_TRUE(std::filesystem::exists(bag() / "metadata.yaml"));
    const auto replayed = replay();
    EXPECT_EQ(replayed.at("outcome"), "cut off");
    EXPECT_EQ(replayed.at("messages"), recorded.size());
    return recorded.empty() ? Duration::max() : killed - recorded.back().stamp;
  }
  [[nodiscard]] std::string path(const std::string& name) const {
    return (folder_.path() / name).string();
  }

  TestDomain domain_, ros2_domain_;
  support::TemporaryFolder folder_;
  std::string qos_ = LIFELINE_SOURCE_DIR "/config/qos/loopback.xml";
};

}  // namespace lifeline::test
