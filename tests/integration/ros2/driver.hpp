#pragma once

#include <memory>
#include <string>

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include "agents/sources/open_source.hpp"
#include "tests/integration/dds/test_domain.hpp"
#include "tests/support/logged.hpp"
#include "tests/support/recordings.hpp"
#include "tests/support/run_program.hpp"

namespace lifeline::test {

/// Generous: a test waits so long only when it fails.
inline constexpr Duration kPatience = std::chrono::seconds(60);

/// A domain of the test's own with drivers on Cyclone DDS, which publish a scan when they are told.
class Ros2Test : public ::testing::Test {
 protected:
  /// A driver under way, and the way to tell it.
  struct Driver {
    Driver(const std::vector<std::string>& arguments, const std::string& fifo,
           const std::string& log)
        : steps(open_fifo(fifo)), program(arguments, log) {}
    ~Driver() { ::close(steps); }
    Driver(const Driver&) = delete;
    Driver& operator=(const Driver&) = delete;

    /// Lets `scans` more go, each with what stands before it in the recording.
    void go(int scans = 1) const {
      const std::string octets(static_cast<std::size_t>(scans), '.');
      ASSERT_EQ(::write(steps, octets.data(), octets.size()), static_cast<ssize_t>(octets.size()));
    }
    /// Both ways, so that opening it waits for nobody.
    static int open_fifo(const std::string& fifo) {
      EXPECT_EQ(::mkfifo(fifo.c_str(), 0600), 0);
      return ::open(fifo.c_str(), O_RDWR | O_CLOEXEC);
    }

    int steps;
    Program program;
  };

  /// Plays `db3_file` at `rate` (0: a scan and what belongs to it at once).
  std::unique_ptr<Driver> start_driver(const std::string& db3_file,
                                       const std::vector<std::string>& more = {},
                                       const std::string& rate = "0") {
    const std::string name = "driver" + std::to_string(++drivers_);
    const std::string fifo = folder_.path(name + ".fifo");
    std::vector<std::string> arguments{"lifeline-ros2-driver",
                                       db3_file,
                                       "--domain",
                                       domain_.text(),
                                       "--rate",
                                       rate,
                                       "--steps",
                                       fifo};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return std::make_unique<Driver>(arguments, fifo, folder_.path(name + ".log"));
  }

  /// The SOURCE that hears these drivers.
  [[nodiscard]] std::string source_text(const std::string& topics,
                                        const std::string& more = "") const {
    return "ros2:" + topics + "?domain=" + domain_.text() +
           "&qos=" LIFELINE_SOURCE_DIR "/config/qos/ros2-loopback.xml" + more;
  }

  RecordingFolder folder_;
  TestDomain domain_;

 private:
  int drivers_ = 0;
};

}  // namespace lifeline::test
