#include "agents/hud/button.hpp"

#include <gtest/gtest.h>

namespace lifeline::hud {
namespace {

using std::chrono::milliseconds;

class ButtonTest : public testing::Test {
 protected:
  void set(bool down) { button_.set_down(down, now_); }
  /// Steps for so long; what was told, in order.
  std::vector<Press> wait(Duration time) {
    std::vector<Press> told;
    for (Duration passed{}; passed < time; passed += milliseconds(10)) {
      now_ += milliseconds(10);
      if (const Press press = button_.step(now_); press != Press::none) told.push_back(press);
    }
    return told;
  }
  using Told = std::vector<Press>;
  Button button_;
  SteadyTime now_{std::chrono::hours(1)};
};

TEST_F(ButtonTest, ABriefPressIsToldOnceItIsOver) {
  set(true);
  EXPECT_EQ(wait(milliseconds(200)), Told{});
  set(false);
  EXPECT_EQ(wait(milliseconds(500)), Told{Press::brief});
}

TEST_F(ButtonTest, HeldForTwoSecondsIsToldThenAndNotAgain) {
  set(true);
  EXPECT_EQ(wait(milliseconds(1990)), Told{});
  EXPECT_EQ(wait(milliseconds(20)), Told{Press::held});
  EXPECT_EQ(wait(milliseconds(9000)), Told{}) << "a button that is stuck calls once";
  set(false);
  EXPECT_EQ(wait(milliseconds(500)), Told{});
  set(true);
  EXPECT_EQ(wait(milliseconds(2500)), Told{Press::held}) << "pressed anew";
}

TEST_F(ButtonTest, LetGoOfInBetweenNothingHappens) {
  set(true);
  (void)wait(milliseconds(1500));
  set(false);
  EXPECT_EQ(wait(milliseconds(500)), Told{});
}

TEST_F(ButtonTest, ContactsThatBounceAreOnePress) {
  for (int i = 0; i < 4; ++i) {
    set(true);
    EXPECT_EQ(wait(milliseconds(20)), Told{});
    set(false);
    EXPECT_EQ(wait(milliseconds(20)), Told{});
  }
  EXPECT_EQ(wait(milliseconds(500)), Told{Press::brief});
}

TEST_F(ButtonTest, AFingerThatSlipsForAMomentStillHolds) {
  set(true);
  (void)wait(milliseconds(1000));
  set(false);
  (void)wait(milliseconds(40));
  set(true);
  EXPECT_EQ(wait(milliseconds(1000)), Told{Press::held});
}

TEST_F(ButtonTest, TheBarGrowsWhileItIsHeldAndIsNotThereForABriefPress) {
  EXPECT_EQ(button_.held_share(now_), 0.0);
  set(true);
  (void)wait(milliseconds(200));
  EXPECT_EQ(button_.held_share(now_), 0.0);
  (void)wait(milliseconds(800));
  EXPECT_NEAR(button_.held_share(now_), 0.5, 0.01);
  (void)wait(milliseconds(2000));
  EXPECT_EQ(button_.held_share(now_), 0.0) << "done";
}

TEST_F(ButtonTest, AReleaseThatWasNeverAPressIsNothing) {
  set(false);
  EXPECT_EQ(wait(milliseconds(500)), Told{});
}

}  // namespace
}  // namespace lifeline::hud
