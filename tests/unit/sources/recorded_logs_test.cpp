// The recordings that the project is developed with, as the sources play them.

#include <algorithm>
#include <filesystem>
#include <limits>

#include <gtest/gtest.h>

#include "tests/support/recordings.hpp"

namespace lifeline::sources {
namespace {

using test::play;
using test::Played;

const std::string kData = LIFELINE_SOURCE_DIR "/../shared/data/";

#define SKIP_WITHOUT(path) \
  if (!std::filesystem::exists(path)) GTEST_SKIP() << path << " is absent"

struct Recorded {
  std::string target;
  std::size_t scans;
  std::size_t fewest_beams;
  std::size_t most_beams;
};

void PrintTo(const Recorded& recorded, std::ostream* out) {
  *out << recorded.target;
}

std::string named(const ::testing::TestParamInfo<Recorded>& instance) {
  return instance.param.target;
}

void expect_played(const Played& played, const Recorded& recorded) {
  ASSERT_EQ(played.error, "");
  EXPECT_EQ(played.scans.size(), recorded.scans);
  std::size_t fewest = std::numeric_limits<std::size_t>::max(), most = 0;
  for (const sensing::RawScan& scan : played.scans) {
    fewest = std::min(fewest, scan.ranges_m.size());
    most = std::max(most, scan.ranges_m.size());
  }
  EXPECT_EQ(fewest, recorded.fewest_beams);
  EXPECT_EQ(most, recorded.most_beams);
}

class RecordedLog : public ::testing::TestWithParam<Recorded> {};

TEST_P(RecordedLog, PlaysWhollyInBothForms) {
  for (const std::string form : {"rawodom", "corrected"}) {
    const std::string path = kData + "carmen/" + GetParam().target + "-" + form + ".log.gz";
    SKIP_WITHOUT(path);
    expect_played(play("carmen:" + path + "?prior=odom"), GetParam());
  }
}

INSTANTIATE_TEST_SUITE_P(
    Carmen, RecordedLog,
    ::testing::Values(Recorded{"intel", 910, 180, 180}, Recorded{"aces", 440, 180, 180},
                      Recorded{"csail", 406, 361, 361}, Recorded{"seattle", 241, 361, 361},
                      Recorded{"edmonton", 340, 180, 180}, Recorded{"acapulco", 861, 181, 181}),
    named);

class RecordedBag : public ::testing::TestWithParam<Recorded> {};

TEST_P(RecordedBag, PlaysWholly) {
  const std::string path = kData + "bags/" + GetParam().target;
  SKIP_WITHOUT(path);
  expect_played(play("rosbag2:" + path), GetParam());
}

INSTANTIATE_TEST_SUITE_P(Ros, RecordedBag,
                         ::testing::Values(Recorded{"jackal_mocap_a", 414, 897, 897},
                                           Recorded{"jackal_mocap_static", 189, 897, 897},
                                           Recorded{"static_varbeams", 436, 452, 456},
                                           Recorded{"urg_room_ros1", 360, 681, 681}),
                         named);

TEST(RecordedLogs, IntelKeepsItsTimesToTheMicrosecondAndItsNoReturns) {
  const std::string path = kData + "carmen/intel-rawodom.log.gz";
  SKIP_WITHOUT(path);
  const Played played = play("carmen:" + path);
  ASSERT_EQ(played.scans.size(), 910U);
  EXPECT_EQ(played.scans.front().stamp.time_since_epoch().count(), 976052890'244111000);
  EXPECT_EQ(played.scans.back().stamp.time_since_epoch().count(), 976055541'103089000);
  std::ptrdiff_t no_returns = 0;
  for (const sensing::RawScan& scan : played.scans) {
    no_returns += std::count_if(scan.ranges_m.begin(), scan.ranges_m.end(),
                                [&](float range_m) { return range_m >= scan.range_max_m; });
  }
  EXPECT_EQ(no_returns, 4172);  // all of them 81.83 m
}

TEST(RecordedLogs, CsailsRoundedTimesStillRise) {
  const std::string path = kData + "carmen/csail-corrected.log.gz";
  SKIP_WITHOUT(path);
  const Played played = play("carmen:" + path);
  ASSERT_EQ(played.scans.size(), 406U);
  EXPECT_TRUE(std::is_sorted(played.scans.begin(), played.scans.end(),
                             [](const auto& a, const auto& b) { return a.stamp < b.stamp; }));
}

TEST(RecordedLogs, JackalsBeamsGoOnceRound) {
  const std::string path = kData + "bags/jackal_mocap_a";
  SKIP_WITHOUT(path);
  const Played played = play("rosbag2:" + path + "?to=1");
  ASSERT_EQ(played.scans.size(), 1U);
  EXPECT_NEAR(played.scans[0].first_angle_rad, -3.1416, 1e-4);
  EXPECT_NEAR(played.scans[0].angle_step_rad, 0.007, 1e-6);
}

}  // namespace
}  // namespace lifeline::sources
