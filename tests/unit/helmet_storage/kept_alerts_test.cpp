// A mayday goes on through a restart of its helmet.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "agents/storage/helmet_storage.hpp"
#include "common/wire/loopback.hpp"
#include "idl/state.pb.h"
#include "tests/support/helmet_channels.hpp"
#include "tests/support/temporary_folder.hpp"

namespace lifeline::test {
namespace {

using testing::HasSubstr;

store::StateIdentity identity() {
  return {"helmet", "alpha", kMission, {}, 7};
}

std::unique_ptr<HelmetStorage> open(const support::TemporaryFolder& folder, const Clock& clock) {
  return HelmetStorage::open(folder.path(), identity(), Floor{0}, {}, clock).value();
}

TEST(KeptAlerts, WhatAHelmetRaisedIsKnownAfterARestart) {
  const support::TemporaryFolder folder;
  const SystemClock clock;
  wire::LoopbackBus bus;
  std::optional<sharing::AlertKey> raised;
  {
    auto storage = open(folder, clock);
    storage->begin(layer("alpha"));
    auto channels = helmet_channels(bus);
    storage->attach(channels);
    sharing::HelmetSharing helmet(sharing_config("alpha"), std::move(channels), clock);
    ASSERT_TRUE(storage->attach(helmet));
    ASSERT_TRUE(helmet.raise_mayday("no air"));
    raised = helmet.own_mayday();
    storage->step(helmet);
  }
  auto storage = open(folder, clock);
  const auto& alerts = storage->memory().sharing.alerts;
  ASSERT_EQ(alerts.size(), 1U);
  EXPECT_EQ(alerts[0].text, "no air");
  storage->begin(layer("alpha"));
  auto channels = helmet_channels(bus);
  storage->attach(channels);
  sharing::HelmetSharing helmet(sharing_config("alpha"), std::move(channels), clock);
  ASSERT_TRUE(storage->attach(helmet));
  EXPECT_EQ(helmet.own_mayday(), raised);
}

class DamagedAlerts : public testing::Test {
 protected:
  Result<HelmetMemory> read(const std::string& alerts) {
    proto::HelmetProgress progress;
    progress.set_map_id(1);
    return read_helmet_memory(
        {{kProgressKey, progress.SerializeAsString()}, {store::kAlertsKey, alerts}}, {}, identity(),
        Floor{0});
  }
};

TEST_F(DamagedAlerts, AreTakenForADamagedState) {
  EXPECT_THAT(read("\xff\xff garbage").error().text, HasSubstr("record alerts"));
  for (const std::uint32_t kind : {0U, 3U, 256U, 4'000'000'000U}) {
    proto::KeptAlerts kept;
    auto& alert = *kept.add_alerts();
    alert.set_alert_id(1);
    alert.set_kind(kind);
    EXPECT_EQ(read(kept.SerializeAsString()).has_value(), kind == 0) << kind;
  }
  proto::KeptAlerts kept;
  kept.add_alerts()->set_subject_id("<b>");
  EXPECT_FALSE(read(kept.SerializeAsString()));
}

TEST_F(DamagedAlerts, MoreThanAHelmetMayHaveAreRefused) {
  proto::KeptAlerts kept;
  for (std::uint32_t i = 0; i < sharing::AlertList::kMostPerSender + 1; ++i)
    kept.add_alerts()->set_alert_id(i);
  EXPECT_FALSE(read(kept.SerializeAsString()));
}

}  // namespace
}  // namespace lifeline::test
