// A mayday and a roll call over a network that loses, doubles, delays and cuts, and repeats
// nothing: what helmets and coordinator hold alike, they hold by their own protocol.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/fleet_channels.hpp"
#include "tests/support/simulated_network.hpp"

namespace lifeline::test {
namespace {

using std::chrono::seconds;

class AlertsOverABadNetwork : public testing::TestWithParam<std::uint64_t> {
 protected:
  AlertsOverABadNetwork() {
    for (const char* id : {"alpha", "bravo", "charlie"}) {
      NetworkEnd end{network_, id};
      helmets_[id] = std::make_unique<sharing::HelmetSharing>(sharing_config(id),
                                                              helmet_channels(end), clock_);
    }
    NetworkEnd end{network_, "vehicle"};
    auto channels = coordinator_channels(end);
    channels.alerts = end.reader<wire::Alert>();
    channels.alert = end.writer<wire::Alert>();
    coordinator_ = std::make_unique<Coordinator>(
        CoordinatorSettings{speaker("vehicle"), GridGeometry{}, {}, {}}, std::move(channels),
        worker_, clock_);
    network_.set_conditions(
        {.loss = 0.4, .doubled = 0.2, .most_delay = std::chrono::milliseconds(900)});
  }

  /// Steps everybody until it holds; false after two minutes of their clock.
  template <typename Condition>
  bool until(const Condition& holds) {
    for (Duration passed{}; passed < seconds(120); passed += kTick) {
      if (holds()) return true;
      clock_.advance(kTick);
      network_.deliver();
      for (auto& [id, helmet] : helmets_) helmet->step();
      coordinator_->step();
    }
    return false;
  }
  bool all_hold(const sharing::AlertKey& key, wire::AlertState state, std::size_t answers) {
    const auto holds = [&](const sharing::AlertList& list) {
      const auto* entry = list.find(key);
      return entry != nullptr && entry->alert.state == state &&
             entry->alert.acknowledged_by.size() == answers;
    };
    return holds(coordinator_->alerts()) && std::ranges::all_of(helmets_, [&](const auto& helmet) {
             return holds(helmet.second->alerts().list());
           });
  }

  ManualClock clock_;
  SimulatedNetwork network_{GetParam(), clock_};
  InlineMatchWorker worker_{matching::MatchConfig{}};
  std::map<std::string, std::unique_ptr<sharing::HelmetSharing>> helmets_;
  std::unique_ptr<Coordinator> coordinator_;
};

TEST_P(AlertsOverABadNetwork, EverybodyHoldsTheSameMaydayAnswersAndEnd) {
  using enum wire::AlertState;
  ASSERT_TRUE(helmets_.at("alpha")->raise_mayday("no air"));
  const auto key = helmets_.at("alpha")->own_mayday().value();
  ASSERT_TRUE(until([&] { return all_hold(key, raised, 0); }));
  ASSERT_TRUE(helmets_.at("bravo")->answer(key));
  ASSERT_TRUE(coordinator_->answer(key, acknowledged));
  ASSERT_TRUE(until([&] { return all_hold(key, acknowledged, 2); }));
  ASSERT_TRUE(helmets_.at("alpha")->cancel_mayday());
  EXPECT_TRUE(until([&] { return all_hold(key, cleared, 3); }));
}

TEST_P(AlertsOverABadNetwork, ARollCallGathersEverybodyThroughACutNetwork) {
  ASSERT_TRUE(coordinator_->raise(wire::AlertKind::roll_call, "", ""));
  const auto key = coordinator_->alerts().entries().begin()->first;
  network_.part({{"alpha", "bravo"}, {"charlie", "vehicle"}});
  ASSERT_TRUE(until([&] { return helmets_.at("charlie")->answer(key).has_value(); }));
  EXPECT_FALSE(helmets_.at("alpha")->answer(key)) << "cut off, it cannot have heard of it";
  network_.heal();
  for (const char* id : {"alpha", "bravo"})
    ASSERT_TRUE(until([&] { return helmets_.at(id)->answer(key).has_value(); })) << id;
  EXPECT_TRUE(until([&] { return all_hold(key, wire::AlertState::raised, 3); }));
}

INSTANTIATE_TEST_SUITE_P(Seeds, AlertsOverABadNetwork, testing::Range<std::uint64_t>(1, 9));

}  // namespace
}  // namespace lifeline::test
