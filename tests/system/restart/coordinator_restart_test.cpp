// Coordinators are killed, started again, and stood in for: helmets never follow an older answer,
// and in the end all hold the same.

#include <algorithm>
#include <functional>
#include <sstream>

#include "tests/support/killed_fleet.hpp"

namespace lifeline::test {
namespace {

class CoordinatorRestart : public KilledFleet {
 protected:
  /// One that ends once both helmets hold the same as itself.
  void start_coordinator(const std::string& name = "coordinator", bool keeps_state = true) {
    Arguments arguments{"lifeline-coordinator", "run", "--until-settled", "--expect", "2",
                        "--time-limit",         "200"};
    if (name == "standby") arguments.emplace_back("--standby");
    start(name, arguments, keeps_state);
  }
  void start_helmets() {
    start_helmet("alpha", kWalk + "0");
    start_helmet("bravo", kWalk + "1");
  }
  void expect_settled(const std::string& name) {
    const Ended settled = program(name).wait(kLong);
    ASSERT_EQ(settled.status, 0) << settled.output;
    const auto report = read(name, "coordinator.json");
    const auto alpha = stop("alpha"), bravo = stop("bravo");
    EXPECT_EQ(alpha.at("common_map_sha256"), report.at("common_map_sha256"));
    EXPECT_EQ(bravo.at("common_map_sha256"), report.at("common_map_sha256"));
    EXPECT_EQ(alpha.at("epoch_applied"), report.at("epoch"));
  }
  /// Epochs in the order in which a helmet followed them.
  std::vector<int> epochs_of(const std::string& name) {
    std::vector<int> epochs;
    std::istringstream lines(program(name).output());
    const std::string words = "follows directive ";
    for (std::string line; std::getline(lines, line);) {
      if (const auto at = line.find(words); at != std::string::npos)
        epochs.push_back(std::stoi(line.substr(at + words.size())));
    }
    return epochs;
  }
  void expect_growing_epochs() {
    for (const char* helmet : {"alpha", "bravo"}) {
      const auto epochs = epochs_of(helmet);
      ASSERT_FALSE(epochs.empty());
      EXPECT_TRUE(std::is_sorted(epochs.begin(), epochs.end(), std::less_equal<>()))
          << testing::PrintToString(epochs);
    }
  }
  /// Waits until a coordinator leads and a helmet follows the directive that it leads with.
  void expect_led_by(const std::string& coordinator, const std::string& helmet) {
    const std::string words = "leads: directive ";
    ASSERT_NO_FATAL_FAILURE(expect(coordinator, words));
    const std::string told = program(coordinator).output();
    const int epoch = std::stoi(told.substr(told.find(words) + words.size()));
    expect(helmet, "follows directive " + std::to_string(epoch));
  }
  /// How many helmets stand in the common map, each time a helmet followed a directive.
  void expect_never_apart_again(const std::string& name) {
    bool together = false;
    std::istringstream lines(program(name).output());
    for (std::string line; std::getline(lines, line);) {
      if (line.find("follows directive") == std::string::npos) continue;
      const bool two = line.find(": 2 helmets") != std::string::npos;
      EXPECT_TRUE(two || !together) << line;
      together = two;
    }
    EXPECT_TRUE(together);
  }
};

TEST_F(CoordinatorRestart, KilledAndBackItGoesOnFromItsState) {
  start_coordinator();
  start_helmets();
  expect("alpha", "follows directive");
  kill("coordinator");
  start_coordinator();
  expect("coordinator", "goes on from directive");
  expect("coordinator", "leads: directive");
  expect_settled("coordinator");
  expect_growing_epochs();
  expect_never_apart_again("alpha");
}

TEST_F(CoordinatorRestart, WithAnEmptyDiskItGoesOnFromWhatTheHelmetsHold) {
  start_coordinator("coordinator", false);
  start_helmets();
  expect("alpha", "follows directive");
  kill("coordinator");
  start_coordinator("coordinator", false);
  expect_settled("coordinator");
  expect_growing_epochs();
  expect_never_apart_again("alpha");
  EXPECT_GE(epochs_of("alpha").size(), 2U);
}

TEST_F(CoordinatorRestart, HelmetAndCoordinatorKilledTogetherComeBackTogether) {
  start_coordinator();
  start_helmets();
  expect("alpha", "follows directive");
  kill("coordinator");
  kill("alpha");
  start_coordinator();
  start_helmet("alpha", kWalk + "0&from=12");
  expect("alpha", "goes on in map 1");
  expect_settled("coordinator");
  EXPECT_EQ(read("alpha", "alpha.json").at("map_id"), 1);
}

TEST_F(CoordinatorRestart, AStandbyTakesOverAndTheOldOneTakesItsAnswerOver) {
  start_coordinator();
  start_coordinator("standby");
  start_helmets();
  expect("alpha", "follows directive");
  expect("standby", "takes over directive");
  kill("coordinator");
  expect_led_by("standby", "alpha");
  start_coordinator();
  expect("coordinator", "leads: directive");
  expect("standby", "gives way");
  expect_settled("coordinator");
  expect_growing_epochs();
  expect_never_apart_again("alpha");
  expect_never_apart_again("bravo");
}

TEST_F(CoordinatorRestart, OneThatWasFrozenListensBeforeItSpeaksAgain) {
  start_coordinator();
  start_coordinator("standby");
  start_helmets();
  expect("alpha", "follows directive");
  program("coordinator").send(SIGSTOP);
  expect_led_by("standby", "alpha");
  program("coordinator").send(SIGCONT);
  expect("coordinator", "gives way");
  expect_settled("coordinator");
  expect_growing_epochs();
  expect_never_apart_again("alpha");
}

}  // namespace
}  // namespace lifeline::test
