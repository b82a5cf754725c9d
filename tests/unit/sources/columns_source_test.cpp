#include <cmath>
#include <filesystem>
#include <string>

#include <gmock/gmock.h>

#include "common/base/angles.hpp"
#include "tests/support/recordings.hpp"

namespace lifeline::test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

/// Time in column 1, four beams from column 3.
constexpr const char* kOptions = "?time=1&first=3&beams=4&fov=240&mask=1&max_range=4";

class ColumnsSourceTest : public ::testing::Test {
 protected:
  Played play_text(const std::string& text, const std::string& options = kOptions) {
    return play("columns:" + folder_.write("scans.txt", text) + options);
  }
  RecordingFolder folder_;
};

TEST_F(ColumnsSourceTest, ReadsTimeAndRangesAndDropsMaskedBeams) {
  const Played played = play_text("7 2500000 0 111 1500 0 222 9\n7 2600000 0 111 1400 20 222 9\n");
  EXPECT_EQ(played.error, "");
  ASSERT_EQ(played.scans.size(), 2U);
  const auto& scan = played.scans[0];
  EXPECT_EQ(scan.stamp.time_since_epoch(), std::chrono::milliseconds(2500));
  EXPECT_THAT(scan.ranges_m, ElementsAre(1.5F, 0.0F));
  EXPECT_NEAR(scan.angle_step_rad, 60.0 * kDegree, 1e-12);
  EXPECT_NEAR(scan.first_angle_rad, -60.0 * kDegree, 1e-12);
  EXPECT_EQ(scan.range_max_m, 4.0);
  EXPECT_FALSE(scan.attitude || scan.T_odom_head || scan.T_world_head_truth);
}

TEST_F(ColumnsSourceTest, PlaysPartsAndCompressedFiles) {
  std::string text;
  for (int i = 0; i < 5; ++i) text += "0 " + std::to_string(1000 + i) + " 0 1 2 3 4\n";
  EXPECT_EQ(play_text(text, std::string(kOptions) + "&from=1&to=3").scans.size(), 2U);
  EXPECT_EQ(play("columns:" + folder_.write_gz("scans.gz", text) + kOptions).scans.size(), 5U);
}

TEST_F(ColumnsSourceTest, NamesFileAndLineOfWhatItCannotRead) {
  const std::string good = "0 1000 0 1 2 3 4\n";
  for (const auto& [bad, what] : {std::pair{"0 1000 0 1 2 3\n", "6 columns, not 7"},
                                  {"\n", "0 columns"},
                                  {"0 1000 0 1 x 3 4\n", "column 4: 'x'"},
                                  {"0 1000 0 1 -2 3 4\n", "column 4: '-2'"},
                                  {"0 nan 0 1 2 3 4\n", "column 1: 'nan'"},
                                  {"0 1000 0 1 2.5 3 4\n", "'2.5'"},
                                  {"0 99999999999999999999 0 1 2 3 4\n", "column 1"},
                                  {"0 1000 0 1", "4 columns"}}) {
    const Played played = play_text(good + bad);
    EXPECT_EQ(played.scans.size(), 1U);
    EXPECT_EQ(played.code, ErrorCode::bad_data);
    EXPECT_THAT(played.error, HasSubstr("scans.txt:2: "));
    EXPECT_THAT(played.error, HasSubstr(what));
  }
  EXPECT_THAT(play_text("").error, HasSubstr("holds no scan"));
}

TEST_F(ColumnsSourceTest, RefusesSenselessOptions) {
  for (const char* options : {"?beams=0", "?beams=x", "?fov=0", "?fov=400", "?mask=341",
                              "?first=-1", "?max_range=0", "?min_range=-1", "?colour=3"}) {
    const Played played = play_text("0\n", options);
    EXPECT_EQ(played.code, ErrorCode::wrong_use) << options;
  }
  EXPECT_EQ(play("columns:none.txt").code, ErrorCode::not_found);
}

TEST(RecordedColumns, AllScansOfTheRoverAreRead) {
  const std::string file = LIFELINE_SOURCE_DIR "/../shared/data/scans10hz/mines-exp1.dat.gz";
  if (!std::filesystem::exists(file)) GTEST_SKIP() << "the recordings are not here";
  const Played played = play("columns:" + file);
  EXPECT_EQ(played.error, "");
  ASSERT_EQ(played.scans.size(), 756U);
  EXPECT_EQ(played.scans[0].ranges_m.size(), 542U);
  EXPECT_NEAR(to_seconds(played.scans.back().stamp - played.scans.front().stamp), 74.6, 0.1);
  int hits = 0;
  for (const auto& scan : played.scans) {
    for (const float range_m : scan.ranges_m) hits += range_m > 0.02F && range_m < 4.0F ? 1 : 0;
  }
  EXPECT_GT(hits, 756 * 150);
}

}  // namespace
}  // namespace lifeline::test
