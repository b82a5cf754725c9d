// The paper's experiments, short and on two seeds: the whole of them is `./lifeline bench paper`.
#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <spdlog/spdlog.h>

#include "tests/bench/paper/doors_study.hpp"
#include "tests/bench/paper/timing_study.hpp"
#include "tests/bench/paper/update_study.hpp"
#include "tests/support/temporary_folder.hpp"

namespace lifeline::bench {
namespace {

constexpr double kDurationS = 30.0;
constexpr PaperExperiment kFirst = kPaperExperiments[0];

/// Long enough for what follows a merge.
constexpr double kLongS = 60.0;

const PaperWalk& walk_of(std::uint64_t seed) {
  spdlog::set_level(spdlog::level::err);
  static std::map<std::uint64_t, PaperWalk> walks;
  const auto [walk, is_new] = walks.try_emplace(seed);
  if (is_new) walk->second = walk_through(kFirst, seed, kDurationS);
  return walk->second;
}

std::map<std::string, double> figures(const std::vector<ReportRow>& rows) {
  std::map<std::string, double> values;
  for (const ReportRow& row : rows) values[row.name] = row.value;
  return values;
}

TEST(PaperExperiments, OursGetsThroughEveryDoorWithTheSmallestHeadingError) {
  support::TemporaryFolder folder;
  DoorsStudy study;
  study.play(kFirst, walk_of(1), folder.path() / "a.png");
  study.play(kFirst, walk_of(2), {});

  const auto value = figures(study.rows());
  EXPECT_EQ(value.at("a, experiment 1, ours: walks that survive every door"), 100.0);
  const auto heading_error = [&value](const char* matcher) {
    return value.at(fmt::format("a, experiment 1, {}: heading error rms, median", matcher));
  };
  EXPECT_LT(heading_error("ours"), heading_error("conventional"));
  EXPECT_GT(std::filesystem::file_size(folder.path() / "a.png"), 5'000U);
}

TEST(PaperExperiments, OurMatchingNeverMergesWronglyHoweverEarlyItIsAsked) {
  TimingStudy study(kDurationS);
  for (const std::uint64_t seed : {1, 2}) study.play(kFirst, walk_of(seed), {});

  const auto value = figures(study.rows());
  for (const char* beta : {"0.28", "2", "5"}) {
    EXPECT_EQ(value.at(fmt::format("b, experiment 1, ours, beta {} %: merged wrongly", beta)), 0.0);
  }
  EXPECT_TRUE(value.contains("b, experiment 1, paper's matching, beta 5 %: merged wrongly"));
}

TEST(PaperExperiments, AWrongMergeHarmsLessTheMoreAHelmetTrustsItself) {
  UpdateStudy study;
  study.play(kFirst, walk_through(kFirst, 1, kLongS), 1, {});

  const auto value = figures(study.rows());
  const auto rmse = [&](const char* which) {
    return value.at(
        fmt::format("c, experiment 1, T_G {}: rmse of the worse helmet, median", which));
  };
  EXPECT_LT(rmse("good, w_T1 = 0.5"), 0.05);
  EXPECT_LT(2.0 * rmse("spoilt, w_T1 = 0.95"), rmse("spoilt, w_T1 = 0.5"));
  EXPECT_DOUBLE_EQ(rmse("spoilt, no update"), rmse("good, no update"));
}

}  // namespace
}  // namespace lifeline::bench
