#pragma once

#include <gtest/gtest.h>

#include "agents/sharing/helmet_sharing.hpp"
#include "agents/sharing/mission_join.hpp"
#include "common/sharing/fixed_transform.hpp"
#include "common/wire/loopback.hpp"
#include "tests/support/helmet_channels.hpp"

namespace lifeline::sharing {

using std::chrono::milliseconds;
using test::layer;

inline Speaker speaker(const std::string& id, std::uint64_t incarnation) {
  return {AgentId::parse(id).value(), test::kMission, Incarnation{incarnation}};
}

// A few helmets and a hand-driven coordinator on one bus and one clock.
class HelmetSharingTest : public testing::Test {
 protected:
  std::unique_ptr<HelmetSharing> make_helmet(const std::string& id, std::uint64_t incarnation = 1) {
    HelmetSharingConfig config{speaker(id, incarnation), layer(id), {}, publisher_, budget_bit_s_};
    auto helmet = std::make_unique<HelmetSharing>(config, test::helmet_channels(bus_), clock_);
    HelmetState state;
    state.state = wire::AgentState::tracking;
    helmet->put(state);
    return helmet;
  }

  void run(std::initializer_list<HelmetSharing*> helmets, Duration time = milliseconds(3000)) {
    for (Duration passed{}; passed < time; passed += milliseconds(50)) {
      clock_.advance(milliseconds(50));
      for (HelmetSharing* helmet : helmets) helmet->step();
    }
  }

  MapTiles random_tiles(std::initializer_list<TileIndex> indices) {
    MapTiles tiles;
    for (const TileIndex index : indices) {
      tiles.emplace_back(index, std::make_shared<const QuantisedTile>(test::random_tile(random_)));
    }
    return tiles;
  }

  void direct(std::uint64_t epoch, const std::vector<std::pair<std::string, Pose2>>& members) {
    wire::MergeDirective directive;
    directive.envelope = test::envelope("coordinator", epoch);
    directive.mission_id = test::kMission;
    directive.epoch = epoch;
    for (const auto& [id, T_common_map] : members) {
      directive.members.push_back({{id, 1, 0}, 0, to_fixed(T_common_map), {}, 1.0F});
    }
    ASSERT_TRUE(coordinator_->put(directive));
  }

  std::mt19937 random_{3};
  ManualClock clock_;
  wire::LoopbackBus bus_;
  TilePublisherConfig publisher_{{milliseconds(500), 0.0, 0.0, 0.0}, false};  // nothing waits
  double budget_bit_s_ = test::kAmple;
  std::unique_ptr<wire::Outbox<wire::MergeDirective>> coordinator_ =
      bus_.writer<wire::MergeDirective>();
};

}  // namespace lifeline::sharing
