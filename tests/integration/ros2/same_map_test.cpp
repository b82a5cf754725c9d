// A driver on Cyclone DDS leads a helmet to the map that its recording leads to.

#include <cmath>
#include <csignal>

#include "agents/helmet_mapper.hpp"
#include "common/files/map_file.hpp"
#include "common/grid/occupancy_grid.hpp"
#include "tests/integration/ros2/driver.hpp"
#include "tests/support/ros2/walk_recording.hpp"

namespace lifeline::test {
namespace {

constexpr const char* kTopics = "/scan,/imu/data";

/// A head that nods and rolls while the lidar turns.
std::string walk(int seconds) {
  return "sim:office?seed=4&head=natural&sweep=on&beams=720&duration=" + std::to_string(seconds);
}

/// Occupied cells of `a` that lie in `b` neither where they are nor next to it.
std::size_t strays(const OccupancyGrid& a, const OccupancyGrid& b) {
  const auto shift = [&](int axis) {
    return static_cast<int>(std::lround((a.origin_m[axis] - b.origin_m[axis]) / a.cell_size_m));
  };
  std::size_t count = 0;
  for (int row = 0; row < a.rows; ++row) {
    for (int column = 0; column < a.columns; ++column) {
      if (a.at(column, row) != Occupancy::occupied) continue;
      bool found = false;
      for (int i = 0; i < 9; ++i) {
        found = found || b.at(column + shift(0) + i % 3 - 1, row + shift(1) + i / 3 - 1) ==
                             Occupancy::occupied;
      }
      count += found ? 0 : 1;
    }
  }
  return count;
}

void expect_same_map(const TsdGrid& live, const TsdGrid& recorded) {
  const auto a = to_occupancy(live), b = to_occupancy(recorded);
  ASSERT_TRUE(a && b);
  EXPECT_GT(known_cells(*b), 5'000U);  // 12 m2
  EXPECT_EQ(strays(*a, *b), 0U);
  EXPECT_EQ(strays(*b, *a), 0U);
}

class SameMap : public Ros2Test, public ::testing::WithParamInterface<const char*> {};

TEST_P(SameMap, AHelmetThatHearsADriverMapsAsFromItsRecording) {
  const std::string bag = folder_.path("walk.db3");
  const int scans = write_walk(walk(15), bag);
  const Logged logged;
  const auto source = sources::open_source(source_text(kTopics));
  ASSERT_TRUE(source) << source.error().text;
  std::vector<std::string> more;
  if (std::string_view(GetParam()) == "best_effort") more.emplace_back("--best-effort");
  const auto driver = start_driver(bag, more);
  ASSERT_TRUE(wait_until([&] { return lines_with(logged.text(), "has a publisher") == 2; }))
      << logged.text() << driver->program.output();

  HelmetMapper live({}, {0.05, 0.15}, {}), recorded({}, {0.05, 0.15}, {});
  const auto recording = sources::open_source("rosbag2:" + bag);
  for (int i = 0; i < scans; ++i) {
    driver->go();
    const auto heard = (*source)->next();
    const auto read = (*recording)->next();
    ASSERT_TRUE(heard && *heard && read && *read);
    EXPECT_EQ((*heard)->stamp, (*read)->stamp);
    ASSERT_EQ((*heard)->ranges_m, (*read)->ranges_m);
    ASSERT_TRUE((*heard)->attitude);
    EXPECT_EQ((*heard)->attitude->pitch_rad, (*read)->attitude->pitch_rad);
    EXPECT_EQ((*heard)->later_attitudes.size(), (*read)->later_attitudes.size());
    EXPECT_GE((*heard)->later_attitudes.size(), 8U);
    live.step(**heard);
    recorded.step(**read);
  }
  live.finish();
  recorded.finish();

  EXPECT_EQ(scans, 150);
  expect_same_map(live.layer(), recorded.layer());
}

INSTANTIATE_TEST_SUITE_P(Drivers, SameMap, ::testing::Values("reliable", "best_effort"));

class Programs : public Ros2Test {
 protected:
  Programs() : scans_(write_walk(walk(6), bag_)) {}

  /// The map that lifeline-agent slam makes of the recording.
  [[nodiscard]] TsdGrid map_of_recording() const {
    const Ended ended = run_program({"lifeline-agent", "slam", "--source", "rosbag2:" + bag_,
                                     "--map", folder_.path("recorded")},
                                    folder_.path("recorded.log"));
    EXPECT_EQ(ended.status, 0) << ended.output;
    return saved("recorded.lifemap");
  }
  [[nodiscard]] TsdGrid saved(const std::string& name) const {
    auto map = files::load_map(folder_.path(name));
    EXPECT_TRUE(map) << map.error().text;
    return std::move(map->grid);
  }
  [[nodiscard]] std::string source() const {
    return source_text(kTopics, "&scans=" + std::to_string(scans_));
  }
  /// Plays the recording to an agent at the lidar's own pace, once it hears both topics.
  std::unique_ptr<Driver> drive(Program& agent) {
    auto driver = start_driver(bag_, {}, "1");
    for (const char* topic : {"/scan: has a publisher", "/imu/data: has a publisher"}) {
      EXPECT_TRUE(agent.wait_for_output(topic, kPatience)) << agent.output();
    }
    driver->go(scans_);
    return driver;
  }

  std::string bag_ = folder_.path("walk.db3");
  int scans_;
};

TEST_F(Programs, SlamHearsADriver) {
  Program agent({"lifeline-agent", "slam", "--source", source(), "--map", folder_.path("live")},
                folder_.path("live.log"));
  const auto driver = drive(agent);
  const Ended ended = agent.wait(kPatience);
  ASSERT_EQ(ended.status, 0) << ended.output;
  expect_same_map(saved("live.lifemap"), map_of_recording());
}

TEST_F(Programs, AHelmetInAMissionHearsADriver) {
  Program agent(
      {"lifeline-agent", "run", "--id", "alpha", "--source", source(), "--domain", domain_.text(),
       "--qos", LIFELINE_SOURCE_DIR "/config/qos/loopback.xml", "--report", folder_.path("report")},
      folder_.path("live.log"));
  ASSERT_TRUE(agent.wait_for_output("joined mission", kPatience)) << agent.output();
  const auto driver = drive(agent);
  ASSERT_TRUE(agent.wait_for_output("the source gave its last scan", kPatience)) << agent.output();
  agent.send(SIGINT);
  const Ended ended = agent.wait(kPatience);
  ASSERT_EQ(ended.status, 0) << ended.output;
  expect_same_map(saved("report/alpha.lifemap"), map_of_recording());
}

}  // namespace
}  // namespace lifeline::test
