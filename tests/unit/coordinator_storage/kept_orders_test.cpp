// What the commander ordered goes on through a restart of the coordinator.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/wire/loopback.hpp"
#include "coordinator/storage/coordinator_storage.hpp"
#include "tests/support/fleet_channels.hpp"
#include "tests/support/temporary_folder.hpp"

namespace lifeline::test {
namespace {

using testing::Contains;
using testing::HasSubstr;

constexpr const char* kVehicle = "vehicle";

class KeptOrders : public testing::Test {
 protected:
  /// A coordinator with its state, as a process would hold both.
  struct Life {
    explicit Life(KeptOrders& test)
        : storage(
              CoordinatorStorage::open(test.folder_.path(), identity(), {}, test.clock_).value()),
          coordinator({{AgentId::parse(kVehicle).value(), kMission, Incarnation{3}}, {}, {}, {}},
                      channels(test.bus_, *storage), worker, test.clock_),
          resumed(storage->attach(coordinator)) {}

    void step() {
      coordinator.step();
      storage->step(coordinator);
    }

    std::unique_ptr<CoordinatorStorage> storage;
    InlineMatchWorker worker{matching::MatchConfig{}};
    Coordinator coordinator;
    Result<void> resumed;
  };

  static store::StateIdentity identity() { return {"coordinator", kVehicle, kMission, {}, 7}; }

  static CoordinatorChannels channels(wire::LoopbackBus& bus, CoordinatorStorage& storage) {
    auto channels = coordinator_channels(bus);
    channels.alerts = bus.reader<wire::Alert>();
    channels.alert = bus.writer<wire::Alert>();
    storage.attach(channels);
    return channels;
  }

  support::TemporaryFolder folder_;
  SystemClock clock_;
  wire::LoopbackBus bus_;
};

TEST_F(KeptOrders, AnEvacuationIsSaidAgainAfterARestartWithWhoHadAnswered) {
  {
    Life life(*this);
    ASSERT_TRUE(life.coordinator.raise(wire::AlertKind::evacuate, "", "roof"));
    const auto helmet = bus_.writer<wire::Alert>();
    wire::Alert answer = life.coordinator.own_alerts().at(0);
    answer.envelope = envelope("alpha");
    answer.acknowledged_by = {"alpha"};
    ASSERT_TRUE(helmet->put(answer));
    life.step();
    ASSERT_THAT(life.coordinator.own_alerts().at(0).acknowledged_by, Contains("alpha"));
    life.step();
  }
  const auto heard = bus_.reader<wire::Alert>();
  Life life(*this);
  ASSERT_TRUE(life.resumed) << life.resumed.error().text;
  const auto own = life.coordinator.own_alerts();
  ASSERT_EQ(own.size(), 1U);
  EXPECT_EQ(own[0].kind, wire::AlertKind::evacuate);
  EXPECT_EQ(own[0].text, "roof");
  EXPECT_THAT(own[0].acknowledged_by, Contains("alpha"));
  const auto said = heard->take();
  ASSERT_FALSE(said.empty());
  EXPECT_EQ(said[0].alert_id, own[0].alert_id);
  // A new order is another one.
  ASSERT_TRUE(life.coordinator.raise(wire::AlertKind::roll_call, "", ""));
  EXPECT_EQ(life.coordinator.own_alerts().size(), 2U);
}

TEST_F(KeptOrders, AStateWithBrokenOrdersIsPutAsideAndTheCoordinatorBeginsAnew) {
  {
    auto opened = store::open_state(folder_.path(), identity(), {}, clock_.wall_now());
    ASSERT_TRUE(opened && *opened);
    store::RecordStore records(std::move((*opened)->file));
    records.put(store::kAlertsKey, "\xff\xff garbage");
    records.flush();
  }
  Life life(*this);
  ASSERT_TRUE(life.resumed);
  EXPECT_TRUE(life.coordinator.own_alerts().empty());
}

}  // namespace
}  // namespace lifeline::test
