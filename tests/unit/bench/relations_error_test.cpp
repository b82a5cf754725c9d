#include "tests/bench/slam/relations_error.hpp"

#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "agents/sources/open_source.hpp"
#include "common/files/tum.hpp"
#include "tests/support/temporary_folder.hpp"

namespace lifeline::bench {
namespace {

using ::testing::HasSubstr;

StampedPose pose(double t_s, const Pose2& pose) {
  return {Timestamp(from_seconds(t_s)), pose};
}

/// Wheels that go 1 m a second along x from t = 0 to 10.
constexpr const char* kOdometry =
    "ODOM 0 0 0 1 0 0 0.0 host 0.0\n"
    "ODOM 10 0 0 1 0 0 10.0 host 10.0\n";

class RelationsErrorTest : public ::testing::Test {
 protected:
  Result<RelationsError> judge(const std::vector<StampedPose>& estimate,
                               const std::string& relations,
                               const std::string& odometry = kOdometry) {
    return relations_error(estimate, folder_.write("a.relations", relations),
                           folder_.write("a.log", odometry));
  }

  support::TemporaryFolder folder_;
  const std::vector<StampedPose> straight_{pose(0.0, {}), pose(4.0, {4.0, 0.0, 0.0}),
                                           pose(8.0, {8.0, 0.0, 0.0})};
};

TEST_F(RelationsErrorTest, IsZeroForTheTruth) {
  const auto error = judge(straight_, "0 4 4 0 0 0 0 0\n4 8 4 0 0 0 0 0\n").value();
  EXPECT_EQ(error.judged, 2U);
  EXPECT_EQ(error.lost, 0U);
  EXPECT_NEAR(error.translation_mean_m, 0.0, 1e-12);
  EXPECT_NEAR(error.rotation_mean_deg, 0.0, 1e-12);
}

TEST_F(RelationsErrorTest, TakesMeanAndStandardDeviationOverAllLines) {
  // Off by 0.3 m and 0.5 m (0.3, 0.4), and by 0 and 0.1 rad.
  const auto error = judge(straight_, "0 4 4.3 0 0 0 0 0\n4 8 3.7 -0.4 0 0 0 0.1\n").value();
  EXPECT_NEAR(error.translation_mean_m, 0.4, 1e-12);
  EXPECT_NEAR(error.translation_std_m, 0.1, 1e-12);
  EXPECT_NEAR(error.rotation_mean_deg, 0.05 * 180.0 / M_PI, 1e-9);
  EXPECT_NEAR(error.rotation_std_deg, 0.05 * 180.0 / M_PI, 1e-9);
}

TEST_F(RelationsErrorTest, WheelsCarryAPoseFromItsScanToTheRelationsTime) {
  // The estimate turned left at 4 s, the wheels went on in what they took for straight.
  const std::vector<StampedPose> turned{pose(0.0, {}), pose(4.0, {4.0, 0.0, 0.5 * M_PI})};
  const auto error = judge(turned, "0 6 4 2 0 0 0 1.5707963267948966\n").value();
  EXPECT_NEAR(error.translation_mean_m, 0.0, 1e-9);
  EXPECT_NEAR(error.rotation_mean_deg, 0.0, 1e-9);
}

TEST_F(RelationsErrorTest, TimesFarFromEveryScanAreCountedAsLost) {
  const auto error = judge(straight_, "0 4 4 0 0 0 0 0\n0 18.1 4 0 0 0 0 0\n").value();
  EXPECT_EQ(error.judged, 1U);
  EXPECT_EQ(error.lost, 1U);
}

TEST_F(RelationsErrorTest, FlaserLinesHoldOdometryAsWell) {
  const std::string log =
      "FLASER 2 1.0 1.0 9 9 9 0 0 0 0.0 host 0.0\n"
      "FLASER 2 1.0 1.0 9 9 9 10 0 0 10.0 host 10.0\n";
  const auto error = judge(straight_, "0 6 6 0 0 0 0 0\n", log).value();
  EXPECT_NEAR(error.translation_mean_m, 0.0, 1e-9);
}

TEST_F(RelationsErrorTest, RefusesWhatItCannotRead) {
  EXPECT_THAT(judge(straight_, "0 4 4 0 0 0 0 0\n0 4 x 0 0 0 0 0\n").error().text,
              HasSubstr("a.relations:2:"));
  EXPECT_THAT(judge(straight_, "0 4 4\n").error().text, HasSubstr("a.relations:1:"));
  EXPECT_THAT(judge(straight_, "", "ODOM 0 0 nan 1 0 0 0.0 host 0.0\n").error().text,
              HasSubstr("a.log:1:"));
  EXPECT_THAT(judge(straight_, "", "FLASER 9 1.0 0 0 0\n").error().text, HasSubstr("a.log:1:"));
  EXPECT_THAT(judge(straight_, "", "# nothing\n").error().text, HasSubstr("no odometry"));
  EXPECT_EQ(judge({straight_.front()}, "").error().code, ErrorCode::bad_data);
  EXPECT_EQ(relations_error(straight_, "none.relations", "none.log").error().code,
            ErrorCode::not_found);
}

/// What the shared evaluator prints for the same files.
nlohmann::json evaluate(const std::filesystem::path& shared, const std::filesystem::path& estimate,
                        const std::filesystem::path& odometry) {
  const std::string command = "python3 " + (shared / "tools/evaluate_relations.py").string() + " " +
                              estimate.string() + " " +
                              (shared / "data/relations/intel.relations").string() +
                              " --odometry " + odometry.string() + " --json";
  std::string output;
  FILE* pipe = popen(command.c_str(), "r");
  if (pipe == nullptr) return {};
  for (int letter = std::fgetc(pipe); letter != EOF; letter = std::fgetc(pipe)) {
    output.push_back(static_cast<char>(letter));
  }
  pclose(pipe);
  return nlohmann::json::parse(output, nullptr, false);
}

TEST_F(RelationsErrorTest, AgreesWithTheSharedEvaluatorOnIntel) {
  const std::filesystem::path shared = LIFELINE_SOURCE_DIR "/../shared";
  const auto log = shared / "data/carmen/intel-rawodom.log.gz";
  if (!std::filesystem::exists(log)) GTEST_SKIP() << "the shared data are not here";
  // A wrong trajectory at the scans' own times, with a gap: a spiral.
  std::vector<StampedPose> spiral;
  const auto source = sources::open_source("carmen:" + log.string()).value();
  for (int i = 0; i < 900; ++i) {
    const auto scan = source->next().value();
    const double turn = 0.05 * i;
    if (i > 400 && i < 430) continue;
    spiral.push_back(
        {scan->stamp, {turn * std::cos(turn), turn * std::sin(turn), normalise_angle(turn)}});
  }
  const auto file = folder_.path() / "spiral.tum";
  ASSERT_TRUE(files::write_tum(file, spiral).has_value());

  const auto ours =
      relations_error(files::read_tum(file).value(), shared / "data/relations/intel.relations", log)
          .value();
  const auto theirs = evaluate(shared, file, log);
  ASSERT_TRUE(theirs.is_object());
  EXPECT_GT(ours.lost, 0U);
  EXPECT_EQ(theirs["relations"], ours.judged);
  EXPECT_EQ(theirs["lost"], ours.lost);
  EXPECT_NEAR(theirs["translation_mean_m"], ours.translation_mean_m, 1e-6);
  EXPECT_NEAR(theirs["translation_std_m"], ours.translation_std_m, 1e-6);
  EXPECT_NEAR(theirs["rotation_mean_deg"], ours.rotation_mean_deg, 1e-5);
  EXPECT_NEAR(theirs["rotation_std_deg"], ours.rotation_std_deg, 1e-5);
}

}  // namespace
}  // namespace lifeline::bench
