// A helmet is killed while it walks, and started again: it goes on in its map, and in the end
// everybody holds the same.

#include <algorithm>
#include <random>
#include <thread>

#include "agents/sources/open_source.hpp"
#include "common/files/tum.hpp"
#include "tests/support/killed_fleet.hpp"

namespace lifeline::test {
namespace {

using std::chrono::milliseconds;

/// Distances of a helmet's whole trajectory, its map beginning where the walk begins, to the truth.
std::vector<double> errors_m(const std::string& source, const std::string& tum) {
  auto scans = sources::open_source(source + "&rate=max").value();
  std::map<Timestamp, Pose2> truth;
  for (;;) {
    auto scan = scans->next().value();
    if (!scan) break;
    truth[scan->stamp] = *scan->T_world_head_truth;
  }
  const Pose2 T_map_world = truth.begin()->second.inverse();
  std::vector<double> errors;
  const auto trajectory = files::read_tum(tum);
  for (const StampedPose& pose : trajectory.value()) {
    const Pose2 expected = T_map_world * truth.at(pose.stamp);
    errors.push_back((expected.translation() - pose.pose.translation()).norm());
  }
  return errors;
}

class HelmetRestart : public KilledFleet {
 protected:
  void start_coordinator() {
    start(
        "coordinator",
        {"lifeline-coordinator", "run", "--until-settled", "--expect", "2", "--time-limit", "200"},
        false);
  }
};

TEST_F(HelmetRestart, KilledInMidWalkItGoesOnInItsMapAndAllEndWithTheSame) {
  start_coordinator();
  start_helmet("alpha", kWalk + "0");
  start_helmet("bravo", kWalk + "1");
  expect("alpha", "follows directive");
  kill("alpha");
  // Somewhere in what it had mapped; and it must have had the time to get there.
  std::this_thread::sleep_for(milliseconds(8000));
  start_helmet("alpha", kWalk + "0&from=12");
  expect("alpha", "goes on in map 1");
  expect("alpha", "found its place");
  const Ended settled = program("coordinator").wait(kLong);
  ASSERT_EQ(settled.status, 0) << settled.output;
  const auto alpha = stop("alpha"), bravo = stop("bravo");
  EXPECT_EQ(alpha.at("map_id"), 1);
  EXPECT_EQ(alpha.at("common_map_sha256").get<std::string>().size(), 64U);
  EXPECT_EQ(alpha.at("common_map_sha256"), bravo.at("common_map_sha256"));
  EXPECT_EQ(alpha.at("fingerprint"), bravo.at("fingerprint"));
  EXPECT_GE(alpha.at("relocalisations").get<int>(), 1);
  EXPECT_GT(alpha.at("scans").get<int>(), 480) << "counted through the restart";
  std::string walk = kWalk + "0";
  walk.replace(walk.find("&rate=x4"), 8, "");
  auto errors = errors_m(walk, report("alpha") + "/alpha.tum");
  ASSERT_GT(errors.size(), 480U);
  EXPECT_LT(errors.back(), 0.15);
  std::sort(errors.begin(), errors.end());
  EXPECT_LT(errors[errors.size() / 2], 0.10);
}

TEST_F(HelmetRestart, KilledAtRandomMomentsNothingThatOthersHeldIsLost) {
  std::mt19937 random(11);
  start_coordinator();
  start_helmet("bravo", kWalk + "1");
  start_helmet("alpha", kWalk + "0");
  expect("alpha", "follows directive");
  for (int round = 0; round < 4; ++round) {
    kill("alpha");
    start_helmet("alpha", kWalk + "0&from=" + std::to_string(2 + random() % 10));
    expect("alpha", "goes on in map 1");
    // Before it has joined, while it looks for its place, after.
    std::this_thread::sleep_for(milliseconds(round % 2 == 0 ? random() % 3000 : 7000));
  }
  kill("alpha");
  start_helmet("alpha", kWalk + "0&from=5");
  const Ended settled = program("coordinator").wait(kLong);
  ASSERT_EQ(settled.status, 0) << settled.output;
  const auto alpha = stop("alpha"), bravo = stop("bravo");
  EXPECT_EQ(alpha.at("map_id"), 1);
  EXPECT_EQ(alpha.at("common_map_sha256"), bravo.at("common_map_sha256"));
  EXPECT_EQ(alpha.at("fingerprint"), bravo.at("fingerprint"));
}

TEST_F(HelmetRestart, ASecondProcessOnOneStateEndsWithOneClearLine) {
  start_helmet("alpha", "sim:office?beams=400");
  expect("alpha", "keeps this helmet's state");
  const Ended second = run_program({"lifeline-agent", "run", "--id", "alpha", "--source",
                                    "sim:office", "--state", state(), "--domain", domain_.text()},
                                   folder_.path() / "second.log");
  EXPECT_EQ(second.status, 1);
  EXPECT_EQ(lines_with(second.output, "alpha.state: is in use by process"), 1U) << second.output;
}

}  // namespace
}  // namespace lifeline::test
