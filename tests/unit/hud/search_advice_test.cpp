#include "agents/hud/search_advice.hpp"

#include <numbers>

#include "tests/support/hud_rooms.hpp"
#include "tests/unit/sharing/helmet_sharing_fixture.hpp"

namespace lifeline::hud {
namespace {

using sharing::HelmetSharing;

/// A hall of 12 m, walls along it, open at both ends: nobody knows what is beyond x = 4 and x = 16.
const std::vector<std::string> kHall{"                                        ",  //
                                     "        ########################        ",  //
                                     "        ........................        ",  //
                                     "        ........................        ",  //
                                     "        ........................        ",  //
                                     "        ########################        ",  //
                                     "                                        "};
constexpr double kMiddleY_m = 1.75;

class SearchAdviceTest : public sharing::HelmetSharingTest {
 protected:
  struct Wearer {
    std::unique_ptr<HelmetSharing> helmet;
    std::shared_ptr<SearchAdvice> advice;
  };
  Wearer make_wearer(const std::string& id, const Pose2& T_map_head) {
    Wearer wearer{make_helmet(id), std::make_shared<SearchAdvice>(0.05)};
    wearer.helmet->set_map_listener(
        [advice = wearer.advice](TileIndex tile) { advice->mark(tile); });
    stand(wearer, T_map_head);
    return wearer;
  }
  void stand(Wearer& wearer, const Pose2& T_map_head, std::uint8_t trust_percent = 90) {
    sharing::HelmetState state;
    state.state = trust_percent > 0 ? wire::AgentState::tracking : wire::AgentState::lost;
    state.trust_percent = trust_percent;
    state.T_map_head = T_map_head;
    wearer.helmet->put(state);
  }
  void walk(std::initializer_list<Wearer*> wearers) {
    for (Duration passed{}; passed < std::chrono::seconds(4); passed += sharing::milliseconds(50)) {
      clock_.advance(sharing::milliseconds(50));
      for (Wearer* wearer : wearers) {
        wearer->helmet->step();
        wearer->advice->step(*wearer->helmet, clock_.steady_now());
      }
    }
  }
};

TEST_F(SearchAdviceTest, AloneTheNearerEndOfTheOwnMapIsShown) {
  Wearer alpha = make_wearer("alpha", {7.0, kMiddleY_m, 0.0});
  alpha.helmet->put(test::plan_tiles(kHall));
  walk({&alpha});
  ASSERT_TRUE(alpha.advice->facts());
  EXPECT_NEAR(alpha.advice->facts()->p_map_m.x(), 4.1, 0.2);
  EXPECT_NEAR(alpha.advice->facts()->distance_m, 2.9, 0.4);
  stand(alpha, {13.0, kMiddleY_m, 0.0});
  walk({&alpha});
  EXPECT_NEAR(alpha.advice->facts()->p_map_m.x(), 15.9, 0.2);
}

TEST_F(SearchAdviceTest, NothingIsShownToWhoIsLostOrHasSeenItAll) {
  Wearer alpha = make_wearer("alpha", {7.0, kMiddleY_m, 0.0});
  alpha.helmet->put(test::plan_tiles(kHall));
  walk({&alpha});
  ASSERT_TRUE(alpha.advice->facts());
  stand(alpha, {7.0, kMiddleY_m, 0.0}, 0);
  walk({&alpha});
  EXPECT_FALSE(alpha.advice->facts());
  auto closed = kHall;
  for (std::size_t row = 2; row < 5; ++row) closed[row][7] = closed[row][32] = '#';
  alpha.helmet->put(test::plan_tiles(closed));
  stand(alpha, {7.0, kMiddleY_m, 0.0});
  walk({&alpha});
  EXPECT_FALSE(alpha.advice->facts());
}

// Both stand nearer to the western end; alpha the nearest.
TEST_F(SearchAdviceTest, TwoOnOneMapAreNotSentToOnePlaceAndEachSeesItOnTheOwnMap) {
  const Pose2 T_common_bravo{2.0, 1.0, std::numbers::pi / 2.0};
  Wearer alpha = make_wearer("alpha", {6.0, kMiddleY_m, 0.0});
  Wearer bravo = make_wearer("bravo", T_common_bravo.inverse() * Pose2{8.0, kMiddleY_m, 0.0});
  alpha.helmet->put(test::plan_tiles(kHall));
  direct(1, {{"alpha", {}}, {"bravo", T_common_bravo}});
  walk({&alpha, &bravo});
  ASSERT_TRUE(bravo.helmet->map().shares());
  ASSERT_TRUE(alpha.advice->facts() && bravo.advice->facts());
  EXPECT_NEAR(alpha.advice->facts()->p_map_m.x(), 4.1, 0.2);
  EXPECT_NEAR((T_common_bravo * bravo.advice->facts()->p_map_m).x(), 15.9, 0.2);
}

TEST_F(SearchAdviceTest, AMergeThatIsWithdrawnLeavesTheOwnMap) {
  Wearer alpha = make_wearer("alpha", {6.0, kMiddleY_m, 0.0});
  Wearer bravo = make_wearer("bravo", {8.0, kMiddleY_m, 0.0});
  alpha.helmet->put(test::plan_tiles(kHall));
  direct(1, {{"alpha", {}}, {"bravo", {}}});
  walk({&alpha, &bravo});
  ASSERT_TRUE(bravo.advice->facts());
  direct(2, {});
  walk({&alpha, &bravo});
  EXPECT_TRUE(alpha.advice->facts());
  EXPECT_FALSE(bravo.advice->facts()) << "it has drawn nothing of its own";
}

}  // namespace
}  // namespace lifeline::hud
