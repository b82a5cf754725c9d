#include "common/sharing/link_budget.hpp"

#include <gtest/gtest.h>

namespace lifeline::sharing {
namespace {

using std::chrono::milliseconds;

// 80,000 bit/s: 10,000 octets a second.
class LinkBudgetTest : public testing::Test {
 protected:
  void pass(Duration time, std::size_t receivers = 1) {
    now_ += time;
    link_.measure(now_, [&] { return Audience{receivers}; });
  }
  std::uint64_t counted_ = 0;
  SteadyTime now_{std::chrono::hours(1)};
  LinkBudget link_{80'000, [this] { return counted_; }};
};

TEST_F(LinkBudgetTest, HoldsTheRateOfWhatTheCounterShows) {
  pass({});
  std::size_t sent = 0;
  for (int i = 0; i < 10'000; ++i) {  // 100 s
    pass(milliseconds(10));
    if (!link_.allows(Traffic::tile)) continue;
    link_.expect(900);
    counted_ += 1000;
    sent += 1000;
  }
  EXPECT_NEAR(static_cast<double>(sent), 100.0 * 10'000, 11'000);  // the first second's allowance
}

TEST_F(LinkBudgetTest, CountsASampleOnceForEachReceiver) {
  pass({}, 4);
  link_.expect(900);
  EXPECT_EQ(link_.octets_queued(), 4000U);
  counted_ += 4000;
  pass(milliseconds(1), 4);
  EXPECT_EQ(link_.octets_queued(), 0U);
}

TEST_F(LinkBudgetTest, RepetitionsThatNobodyAnnouncedLeaveTheTilesATrickle) {
  pass({});
  std::size_t sent = 0;
  for (int i = 0; i < 10'000; ++i) {  // 100 s
    counted_ += 90;                   // 9,000 octets a second
    pass(milliseconds(10));
    if (!link_.allows(Traffic::tile)) continue;
    link_.expect(910);
    counted_ += 1010;
    sent += 1010;
  }
  EXPECT_NEAR(static_cast<double>(sent), 100.0 * 1'500, 15'000);
}

TEST_F(LinkBudgetTest, AsksOnceASecondWhoListens) {
  int asked = 0;
  for (int i = 0; i < 1'000; ++i) {  // 10 s
    now_ += milliseconds(10);
    link_.measure(now_, [&] { return Audience{static_cast<std::size_t>(++asked)}; });
  }
  EXPECT_EQ(asked, 10);
  EXPECT_EQ(link_.receivers(), 10U);
}

TEST_F(LinkBudgetTest, UrgentTrafficHasAReserve) {
  pass({});
  link_.expect(5'200);
  EXPECT_FALSE(link_.allows(Traffic::scan));
  EXPECT_TRUE(link_.allows(Traffic::tile));
  link_.expect(4'000);
  EXPECT_FALSE(link_.allows(Traffic::tile));
  EXPECT_TRUE(link_.allows(Traffic::pose));
  link_.expect(900);
  EXPECT_FALSE(link_.allows(Traffic::pose));
}

TEST_F(LinkBudgetTest, WhatWasNeverSentIsGivenBack) {
  pass({});
  link_.expect(20'000);
  EXPECT_FALSE(link_.allows(Traffic::pose));
  for (int i = 0; i < 25; ++i) pass(milliseconds(100));
  EXPECT_EQ(link_.octets_queued(), 0U);
  EXPECT_TRUE(link_.allows(Traffic::tile));
}

TEST_F(LinkBudgetTest, ACounterThatStartsAnewCostsNothing) {
  pass({});
  counted_ = 5'000;
  pass(milliseconds(500));
  counted_ = 10;  // the interface was made anew
  pass(milliseconds(500));
  pass(milliseconds(2000));
  EXPECT_TRUE(link_.allows(Traffic::tile));
}

}  // namespace
}  // namespace lifeline::sharing
