#include "common/files/tum.hpp"

#include <cmath>
#include <numbers>

#include <gmock/gmock.h>

#include "tests/support/temporary_folder.hpp"

namespace lifeline::files {
namespace {

using ::testing::HasSubstr;

Timestamp at_ns(std::int64_t count) {
  return Timestamp(Duration(count));
}

class Tum : public ::testing::Test {
 protected:
  std::string error_of(const std::string& content) {
    const auto read = read_tum(folder_.write("a.tum", content));
    return read ? "read" : read.error().text;
  }
  support::TemporaryFolder folder_;
};

TEST_F(Tum, PosesAndNanosecondsSurviveAFile) {
  const std::vector<StampedPose> trajectory{{at_ns(0), {0.0, 0.0, 0.0}},
                                            {at_ns(1), {1e-9, -1234.567890123, 3.1}},
                                            {at_ns(1'699'999'999'123'456'789), {5.0, 6.0, -3.1}},
                                            {at_ns(-1'500'000'001), {0.0, 0.0, 1e-6}}};
  const auto file = folder_.path() / "a.tum";
  ASSERT_TRUE(write_tum(file, trajectory));
  const auto read = read_tum(file);
  ASSERT_TRUE(read) << read.error().text;
  ASSERT_EQ(read->size(), trajectory.size());
  for (std::size_t i = 0; i < trajectory.size(); ++i) {
    EXPECT_EQ((*read)[i].stamp, trajectory[i].stamp) << i;
    EXPECT_NEAR((*read)[i].pose.x_m, trajectory[i].pose.x_m, 1e-9);
    EXPECT_NEAR((*read)[i].pose.y_m, trajectory[i].pose.y_m, 1e-9);
    EXPECT_NEAR((*read)[i].pose.yaw_rad, trajectory[i].pose.yaw_rad, 1e-9);
  }
}

TEST_F(Tum, WritesWhatOtherToolsRead) {
  const auto file = folder_.path() / "a.tum";
  ASSERT_TRUE(write_tum(
      file, std::vector<StampedPose>{{at_ns(2'000'000'500), {1.5, -2.0, std::numbers::pi}}}));
  EXPECT_EQ(support::content_of(file),
            "2.000000500 1.500000000 -2.000000000 0 0 0 1.000000000000 0.000000000000\n");
}

TEST_F(Tum, ReadsCommentsTabsAndForeignQuaternions) {
  const auto read = read_tum(folder_.write("a.tum",
                                           "# time x y z qx qy qz qw\n\n"
                                           " 1.0\t2 3 9 0 0 2 2 \r\n"
                                           "1e1 -2 3.5e0 0 0 0 0 -1"));
  ASSERT_TRUE(read) << read.error().text;
  ASSERT_EQ(read->size(), 2U);
  EXPECT_NEAR((*read)[0].pose.yaw_rad, std::numbers::pi / 2.0, 1e-12);
  EXPECT_EQ((*read)[1].stamp, at_ns(10'000'000'000));
  EXPECT_NEAR((*read)[1].pose.yaw_rad, 0.0, 1e-12);
}

TEST_F(Tum, AnEmptyFileIsAnEmptyTrajectory) {
  ASSERT_TRUE(write_tum(folder_.path() / "a.tum", {}));
  EXPECT_TRUE(read_tum(folder_.path() / "a.tum").value().empty());
}

TEST_F(Tum, NamesTheLineThatIsNoPose) {
  const std::string good = "1 2 3 0 0 0 0 1\n";
  for (const std::string bad :
       {"1 2 3 0 0 0 0", "1 2 3 0 0 0 0 1 5", "x 2 3 0 0 0 0 1", "1 nan 3 0 0 0 0 1",
        "1 2 inf 0 0 0 0 1", "1 2 3 0 0 0 0 0", "1,2,3,0,0,0,0,1", "99999999999 2 3 0 0 0 0 1"}) {
    EXPECT_THAT(error_of(good + bad), HasSubstr("a.tum:2: not a pose")) << bad;
  }
}

TEST_F(Tum, NamesAFileThatIsMissing) {
  EXPECT_EQ(read_tum(folder_.path() / "none.tum").error().code, ErrorCode::not_found);
}

}  // namespace
}  // namespace lifeline::files
