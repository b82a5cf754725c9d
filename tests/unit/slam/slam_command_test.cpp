#include "agents/slam_command.hpp"

#include <fstream>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "agents/loaded_pages.hpp"
#include "common/files/map_file.hpp"
#include "common/files/occupancy_image.hpp"
#include "common/files/tum.hpp"
#include "tests/support/temporary_folder.hpp"

namespace lifeline {
namespace {

using support::content_of;
using support::TemporaryFolder;

/// A CARMEN log of a lidar that walks 0.1 m a scan along a box-shaped room of 8 m x 6 m.
std::string small_log() {
  std::string log = "# a small log\n";
  for (int k = 0; k < 20; ++k) {
    const double x = -2.0 + 0.1 * k;
    log += "FLASER 180";
    for (int i = 0; i < 180; ++i) {
      const double a = (i - 90) * M_PI / 180.0, c = std::cos(a), s = std::sin(a);
      const double to_x = c > 1e-9 ? (4.0 - x) / c : 1e9;
      const double to_y = std::abs(s) > 1e-9 ? (s > 0 ? 3.0 : 2.5) / std::abs(s) : 1e9;
      log += ' ' + std::to_string(std::min(to_x, to_y));
    }
    const std::string pose = std::to_string(x) + " 0 0 ";
    log += ' ' + pose + pose + std::to_string(100.0 + 0.5 * k) + " host 0\n";
  }
  return log;
}

SlamCommandOptions options_for(const TemporaryFolder& folder, const std::string& source) {
  SlamCommandOptions options;
  options.source = source;
  options.trajectory = folder.path() / "t.tum";
  options.map = folder.path() / "map";
  options.stats = folder.path() / "stats.json";
  return options;
}

std::string carmen(const std::filesystem::path& log) {
  return "carmen:" + log.string();
}

TEST(SlamCommand, WritesTrajectoryTruthMapAndStatistics) {
  const TemporaryFolder folder;
  const auto options =
      options_for(folder, carmen(folder.write("small.log", small_log())) + "?prior=odom");
  ASSERT_EQ(run_slam_command(options), 0);

  const auto trajectory = files::read_tum(folder.path() / "t.tum");
  const auto truth = files::read_tum(folder.path() / "t.truth.tum");
  ASSERT_TRUE(trajectory && truth);
  ASSERT_EQ(trajectory->size(), 20U);
  ASSERT_EQ(truth->size(), 20U);
  EXPECT_NEAR(trajectory->back().pose.x_m, 1.9, 0.02);
  EXPECT_NEAR(trajectory->back().pose.y_m, 0.0, 0.02);
  EXPECT_EQ(trajectory->back().stamp, truth->back().stamp);

  const auto map = files::load_map(folder.path() / "map.lifemap");
  ASSERT_TRUE(map);
  EXPECT_EQ(map->trajectory.size(), 20U);
  EXPECT_GT(known_area_m2(map->grid), 15.0);
  const auto image = files::read_occupancy_image(folder.path() / "map.yaml");
  ASSERT_TRUE(image);
  EXPECT_GT(known_cells(*image), 5000U);

  const auto stats = nlohmann::json::parse(content_of(folder.path() / "stats.json"));
  EXPECT_EQ(stats["scans"], 20);
  EXPECT_EQ(stats["failures"], 0);
  EXPECT_EQ(stats["matcher"], "direct");
  EXPECT_GT(stats["step_ms_median"], 0.0);
  EXPECT_GE(stats["step_ms_p99"], stats["step_ms_median"]);
  EXPECT_GT(stats["peak_rss_mb"], 1.0);
}

TEST(SlamCommand, EachMatcherCanBeAskedFor) {
  const TemporaryFolder folder;
  for (const std::string matcher : {"conventional", "advanced", "direct"}) {
    auto options = options_for(folder, carmen(folder.write("small.log", small_log())));
    options.matcher = matcher;
    ASSERT_EQ(run_slam_command(options), 0) << matcher;
    EXPECT_EQ(nlohmann::json::parse(content_of(folder.path() / "stats.json"))["matcher"], matcher);
  }
}

TEST(SlamCommand, TheSameSourceGivesTheSameFiles) {
  const TemporaryFolder once, again;
  for (const TemporaryFolder* folder : {&once, &again}) {
    ASSERT_EQ(
        run_slam_command(options_for(*folder, carmen(folder->write("small.log", small_log())))), 0);
  }
  for (const char* name : {"t.tum", "map.lifemap", "map.pgm"}) {
    EXPECT_EQ(content_of(once.path() / name), content_of(again.path() / name)) << name;
  }
}

/// Runs the command and gives its exit status and what it said on stderr.
std::pair<int, std::string> failing(const SlamCommandOptions& options) {
  ::testing::internal::CaptureStderr();
  const int status = run_slam_command(options);
  return {status, ::testing::internal::GetCapturedStderr()};
}

TEST(SlamCommand, SaysInOneLineWhatIsWrong) {
  const TemporaryFolder folder;
  const auto log = folder.write("small.log", small_log());
  auto bad_matcher = options_for(folder, carmen(log));
  bad_matcher.matcher = "magic";
  auto unwritable = options_for(folder, carmen(log));
  unwritable.trajectory = folder.path() / "no" / "such" / "folder.tum";
  auto bad_config = options_for(folder, carmen(log));
  bad_config.config = folder.write("bad.yaml", "slam:\n  matchr: direct\n");
  const std::vector<std::pair<SlamCommandOptions, int>> cases{
      {options_for(folder, "carmen:" + (folder.path() / "missing.log").string()), 1},
      {options_for(folder, "teapot:x"), 2},
      {options_for(folder, carmen(folder.write("empty.log", "# nothing\n"))), 1},
      {options_for(folder, carmen(folder.write("cut.log", "FLASER 180 1.0 2.0\n"))), 1},
      {bad_matcher, 2},
      {bad_config, 2},
      {unwritable, 1}};
  for (const auto& [options, expected] : cases) {
    const auto [status, said] = failing(options);
    EXPECT_EQ(status, expected) << said;
    EXPECT_EQ(said.rfind("lifeline-agent: ", 0), 0U) << said;
    EXPECT_EQ(std::count(said.begin(), said.end(), '\n'), 1) << said;
  }
}

TEST(SlamCommand, LeavesNothingBehindWhenTheSourceBreaksOff) {
  const TemporaryFolder folder;
  std::string log = small_log();
  log.resize(log.size() - 40);
  const auto [status, said] = failing(options_for(folder, carmen(folder.write("cut.log", log))));
  EXPECT_EQ(status, 1) << said;
  EXPECT_EQ(folder.files(), 1U);  // the log itself
}

/// Pages of files that are mapped and in memory.
long file_pages() {
  long size = 0, resident = 0, shared = 0;
  std::ifstream("/proc/self/statm") >> size >> resident >> shared;
  return shared;
}

TEST(LoadedPages, AreFewerOnceGivenBackAndComeAgainWhereTheyAreNeeded) {
  const long before = file_pages();
  give_back_loaded_pages();
  EXPECT_LT(file_pages(), before);
  EXPECT_EQ(std::to_string(0.5), "0.500000");
}

}  // namespace
}  // namespace lifeline
