// A real helmet that records: played again, exported, cut off, and on a full disk.
#include <algorithm>
#include <csignal>
#include <fstream>
#include <sstream>
#include <thread>

#include "tests/system/recording/recorded_fleet.hpp"

namespace lifeline::test {
namespace {

namespace fs = std::filesystem;
using std::chrono::seconds;
using namespace std::string_literals;

class HelmetRecordingSystemTest : public RecordedFleet {
 protected:
  std::unique_ptr<Program> start_recording_helmet(const std::string& source) {
    return start_helmet("alpha", source, {"--record", path("records")});
  }
  std::unique_ptr<Program> start_watch(const std::string& name = "watch") {
    return start(name, {"lifeline-coordinator", "watch", "--json"});
  }
  /// Of alpha's statuses, as `watch` printed them, each that says `recording`.
  static std::vector<nlohmann::json> statuses(const Program& watch, const std::string& recording) {
    std::vector<nlohmann::json> found;
    std::istringstream lines(watch.output());
    for (std::string line; std::getline(lines, line);) {
      auto status = nlohmann::json::parse(line, nullptr, false);
      if (status.is_object() && status.value("status", "") == "alpha" &&
          status.value("recording", "") == recording)
        found.push_back(std::move(status));
    }
    return found;
  }
  /// Until `holds`; false where it does not in time.
  template <typename Condition>
  static bool until(const Condition& holds) {
    for (int i = 0; i < 600; ++i) {
      if (holds()) return true;
      std::this_thread::sleep_for(std::chrono::milliseconds(100));  // of the watched fleet
    }
    return false;
  }
};

TEST_F(HelmetRecordingSystemTest, ItsRecordingIsReplayedAndExportedToTheMapThatAllHeld) {
  const auto coordinator =
      start("coordinator", {"lifeline-coordinator", "run", "--dashboard", "off", "--expect", "2",
                            "--until-settled", "--time-limit", "120", "--report", path("report")});
  const std::string walk = "&walkers=2&duration=60&rate=x8&beams=400&seed=1&victims=2";
  const auto alpha = start_recording_helmet("sim:office?walker=0" + walk);
  const auto bravo = start_helmet("bravo", "sim:office?walker=1" + walk);
  const Ended settled = coordinator->wait(kLong);
  ASSERT_EQ(settled.status, 0) << settled.output;
  alpha->send(SIGTERM);
  const Ended ended = alpha->wait(kLong);
  ASSERT_EQ(ended.status, 0) << ended.output;
  std::ifstream report(path("report/coordinator.json"));
  const auto live = nlohmann::json::parse(report, nullptr, false);
  ASSERT_TRUE(live.is_object());
  ASSERT_EQ(live.at("common_map_sha256").get<std::string>().size(), 64U);

  const auto replayed = replay();
  EXPECT_EQ(replayed.at("recorder"), "alpha");
  EXPECT_EQ(replayed.at("outcome"), "same");
  EXPECT_EQ(replayed.at("common_map_sha256"), live.at("common_map_sha256"));
  EXPECT_EQ(replayed.at("messages_refused"), 0);
  EXPECT_EQ(replayed.at("layers"), 2);
  EXPECT_EQ(replayed.at("detections"), live.at("detections").size());

  const Ended exported =
      run_program({"lifeline-coordinator", "export", bag().string(), "--to", path("export")},
                  folder_.path() / "export.log", kLong);
  ASSERT_EQ(exported.status, 0) << exported.output;
  for (const char* name : {"map.pgm", "map.yaml", "map.png", "report.pdf", "alpha.tum"})
    EXPECT_TRUE(fs::exists(path(std::string("export/") + name))) << name;
}

// As of a coordinator: of several tries the best must be within the second, all must open.
TEST_F(HelmetRecordingSystemTest, AKilledHelmetLeavesABagThatLacksLessThanASecond) {
  Duration least_missing = seconds(1000);
  for (int i = 0; i < 2; ++i) {
    fs::remove_all(path("records"));
    const auto watch = start_watch(fmt::format("watch-{}", i));
    const auto alpha = start_recording_helmet("sim:office?duration=600&beams=200");
    // It has sent some tiles, and some more.
    ASSERT_TRUE(until([&] {
      const auto said = statuses(*watch, "on");
      return !said.empty() && said.back().value("tiles", 0) > 2 + 3 * i;
    })) << watch->output();
    const Timestamp killed = std::chrono::system_clock::now();
    alpha->send(SIGKILL);
    ASSERT_EQ(alpha->wait(kLong).status, 128 + SIGKILL);
    least_missing = std::min(least_missing, missing_before(killed));
  }
  EXPECT_LE(to_seconds(least_missing), 1.0);
}

TEST_F(HelmetRecordingSystemTest, OnAFullDiskItMapsOnSaysSoAndRecordsWholeAgain) {
  std::signal(SIGXFSZ, SIG_IGN);  // children inherit it; a disk sends no signal
  const auto watch = start_watch();
  const auto alpha = start_recording_helmet("sim:office?duration=600&rate=x2&beams=200");
  ASSERT_TRUE(until([&] { return !statuses(*watch, "on").empty(); })) << watch->output();
  const pid_t pid = child_with("run\0--id\0alpha"s);
  ASSERT_GT(pid, 0);
  limit_files(pid, 4096);
  ASSERT_TRUE(alpha->wait_for_output("make room on the disk; the mission goes on", kLong))
      << alpha->output();
  // SLAM goes on meanwhile, and so does what others hear of it.
  EXPECT_TRUE(until([&] {
    const auto said = statuses(*watch, "failing");
    return !said.empty() && said.back().value("scans", 0) > said.front().value("scans", 0) + 20 &&
           said.back().value("samples_unrecorded", 0) > 0;
  })) << watch->output();
  limit_files(pid, RLIM_INFINITY);
  ASSERT_TRUE(alpha->wait_for_output("there is room again", kLong)) << alpha->output();
  ASSERT_TRUE(until([&] {
    const auto said = statuses(*watch, "on");
    return !said.empty() && said.back().value("samples_unrecorded", 0) > 0;
  })) << watch->output();
  alpha->send(SIGTERM);
  EXPECT_EQ(alpha->wait(kLong).status, 0) << alpha->output();
  const auto replayed = replay();
  EXPECT_EQ(replayed.at("outcome"), "same");
  EXPECT_EQ(replayed.at("layers"), 1);
  const auto recorded = messages();
  // What was lost meanwhile is there again: the tiles, as they were held.
  EXPECT_TRUE(std::any_of(recorded.begin(), recorded.end(), [](const bag::Message& message) {
    return message.topic.name == "/lifeline/tile_copy";
  }));
}

}  // namespace
}  // namespace lifeline::test
