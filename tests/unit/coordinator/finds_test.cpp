// What the coordinator makes of detections, as its report holds it.

#include <cmath>
#include <fstream>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "common/wire/loopback.hpp"
#include "coordinator/coordinator.hpp"
#include "coordinator/report.hpp"
#include "tests/support/fleet_channels.hpp"
#include "tests/support/temporary_folder.hpp"

namespace lifeline::test {
namespace {

class CoordinatorFinds : public testing::Test {
 protected:
  void publish(const wire::Detection& sample) {
    ASSERT_TRUE(detections_->put(sample));
    clock_.advance(std::chrono::milliseconds(100));
    coordinator_.step();
  }
  nlohmann::json reported() {
    const support::TemporaryFolder folder;
    EXPECT_TRUE(write_report(folder.path(), coordinator_, Settlement::apart));
    std::ifstream file(folder.path() / "coordinator.json");
    return nlohmann::json::parse(file).at("detections");
  }

  ManualClock clock_;
  wire::LoopbackBus bus_;
  InlineMatchWorker worker_{matching::MatchConfig{}};
  Coordinator coordinator_{
      {{AgentId::parse("vehicle").value(), kMission, Incarnation{3}}, {}, {}, {}},
      coordinator_channels(bus_),
      worker_,
      clock_};
  std::unique_ptr<wire::Outbox<wire::Detection>> detections_ = bus_.writer<wire::Detection>();
};

TEST_F(CoordinatorFinds, StandInItsReportAsOfTheNewestRevision) {
  auto sample = detection(layer("alpha"), 256, 1.0, 2.0, 10, 11);
  publish(sample);
  sample.revision = 2;
  sample.x_m = 1.5;
  sample.seen_at_ns = 30'000'000'000;
  publish(sample);
  const auto finds = reported();
  ASSERT_EQ(finds.size(), 1U);
  EXPECT_EQ(finds[0].at("frame"), "alpha/1");
  EXPECT_EQ(finds[0].at("x_m"), 1.5);
  EXPECT_EQ(finds[0].at("first_seen"), (nlohmann::json{{"by", "alpha"}, {"at_s", 10.0}}));
  EXPECT_EQ(finds[0].at("last_seen").at("at_s"), 30.0);
}

TEST_F(CoordinatorFinds, ThatAreHostileAreRefusedAndCounted) {
  publish(detection(layer("alpha"), 256, std::nan(""), 2.0));
  auto foreign = detection(layer("alpha"), 257, 1.0, 2.0);
  foreign.envelope.mission_id = "another";
  publish(foreign);
  EXPECT_TRUE(reported().empty());
  EXPECT_EQ(coordinator_.status().samples_refused, 2U);
}

}  // namespace
}  // namespace lifeline::test
