#include "deploy/demo/fleet.hpp"

#include <filesystem>
#include <fstream>
#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

namespace lifeline::demo {
namespace {

using testing::HasSubstr;
using testing::IsSupersetOf;
using namespace std::chrono_literals;

/// Shell scripts that stand in for the programs.
class FleetTest : public testing::Test {
 protected:
  FleetTest() {
    folder_ = testing::TempDir() + "fleet_test_" + std::to_string(getpid());
    std::filesystem::create_directories(folder_);
  }
  ~FleetTest() override { std::filesystem::remove_all(folder_); }

  Mission mission(const std::string& coordinator, const std::string& agent) {
    return {.programs = {script("agent", agent), script("coordinator", coordinator), "q.xml"},
            .report = folder_,
            .mission_id = "demo-1",
            .domain_id = 33,
            .time_limit_s = 20.0};
  }

  std::filesystem::path folder_;
  const FleetPlan plan_{
      .helmets = {{"alpha", "sim:a"}, {"bravo", "sim:b"}}, .finds = {}, .play_s = 1.0};

 private:
  std::filesystem::path script(const std::string& name, const std::string& text) {
    const std::filesystem::path path = folder_ / name;
    std::ofstream(path) << "#!/bin/sh\n" << text << "\n";
    std::filesystem::permissions(path, std::filesystem::perms::owner_all);
    return path;
  }
};

TEST_F(FleetTest, command_lines_carry_what_all_have_in_common_and_each_one_s_own) {
  const Mission shared = mission("", "");
  const std::vector<std::string> common{"run",       "--report", folder_.string(),
                                        "--mission", "demo-1",   "--domain",
                                        "33",        "--qos",    "q.xml"};
  EXPECT_THAT(helmet_command(shared, plan_.helmets[1]).arguments, IsSupersetOf(common));
  EXPECT_THAT(helmet_command(shared, plan_.helmets[1]).arguments,
              IsSupersetOf({"--id", "bravo", "--source", "sim:b"}));
  EXPECT_THAT(coordinator_command(shared, 2).arguments, IsSupersetOf(common));
  EXPECT_THAT(coordinator_command(shared, 2).arguments,
              IsSupersetOf({"--expect", "2", "--until-settled", "--time-limit", "20"}));
}

TEST_F(FleetTest, waits_for_the_coordinator_and_then_lets_the_helmets_report) {
  SignalWatch signals;
  const Mission shared = mission("sleep 0.2; exit 0",
                                 "trap 'echo reported; exit 0' TERM; while :; do sleep 0.05; done");
  auto fleet = Fleet::start(shared, plan_);
  ASSERT_TRUE(fleet) << fleet.error().text;
  const auto end = fleet->wait(signals);
  ASSERT_TRUE(end) << end.error().text;
  EXPECT_EQ(*end, Fleet::End::coordinator_done);
  fleet->stop(signals, 10s);
  EXPECT_EQ(fleet->coordinator_status(), 0);
  std::ostringstream said;
  said << std::ifstream(folder_ / "bravo.log").rdbuf();
  EXPECT_THAT(said.str(), HasSubstr("reported\n"));
}

TEST_F(FleetTest, names_a_helmet_that_ends_early_with_its_last_words) {
  SignalWatch signals;
  auto fleet = Fleet::start(mission("sleep 60", "echo the lidar is gone >&2; exit 3"), plan_);
  ASSERT_TRUE(fleet);
  const auto end = fleet->wait(signals);
  ASSERT_FALSE(end);
  EXPECT_THAT(end.error().text, HasSubstr("status 3"));
  EXPECT_THAT(end.error().text, HasSubstr("the lidar is gone"));
}

TEST_F(FleetTest, names_a_helmet_that_fails_while_it_reports) {
  SignalWatch signals;
  auto fleet = Fleet::start(
      mission(
          "sleep 0.2; exit 0",
          "trap 'case \"$*\" in *bravo*) echo no room for the report >&2; exit 4;; esac; exit 0' "
          "TERM; while :; do sleep 0.05; done"),
      plan_);
  ASSERT_TRUE(fleet) << fleet.error().text;
  ASSERT_TRUE(fleet->wait(signals));
  fleet->stop(signals, 10s);
  const auto bad = fleet->bad_ends();
  ASSERT_EQ(bad.size(), 1U);
  EXPECT_THAT(bad.front(), HasSubstr("bravo ended with status 4: no room for the report"));
}

TEST_F(FleetTest, stops_waiting_when_somebody_asks_for_it) {
  SignalWatch signals;
  auto fleet = Fleet::start(mission("sleep 60", "sleep 60"), plan_);
  ASSERT_TRUE(fleet);
  raise(SIGTERM);
  const auto end = fleet->wait(signals);
  ASSERT_TRUE(end);
  EXPECT_EQ(*end, Fleet::End::asked_to_stop);
  fleet->stop(signals, 10s);
  EXPECT_EQ(fleet->coordinator_status(), 128 + SIGTERM);
}

TEST_F(FleetTest, kills_those_that_do_not_listen) {
  SignalWatch signals;
  auto fleet =
      Fleet::start(mission("trap '' TERM; while :; do sleep 0.05; done", "sleep 60"), plan_);
  ASSERT_TRUE(fleet);
  usleep(200'000);  // for the trap to be set; without it the test passes, too
  fleet->stop(signals, 300ms);
  for (int i = 0; i < 1000 && !fleet->coordinator_status(); ++i) usleep(10'000);
  EXPECT_TRUE(fleet->coordinator_status());
}

TEST_F(FleetTest, says_which_program_cannot_be_started) {
  Mission shared = mission("exit 0", "exit 0");
  shared.programs.agent = folder_ / "no-such-agent";
  const auto fleet = Fleet::start(shared, plan_);
  ASSERT_FALSE(fleet);
  EXPECT_THAT(fleet.error().text, HasSubstr("no-such-agent"));
}

}  // namespace
}  // namespace lifeline::demo
