#include "common/store/state_file.hpp"

#include <fstream>

#include <gtest/gtest.h>

#include "tests/support/temporary_folder.hpp"

namespace lifeline::store {
namespace {

using std::chrono::hours;
using std::chrono::seconds;

class StateFileTest : public testing::Test {
 protected:
  static StateIdentity identity() { return {"helmet", "alpha", "drill", GridGeometry{}, 7}; }

  OpenState open(const StateIdentity& as = identity()) {
    auto opened = open_state(folder_.path(), as, {}, now_);
    EXPECT_TRUE(opened.has_value()) << (opened ? "" : opened.error().text);
    EXPECT_TRUE(opened->has_value());
    return std::move(**opened);
  }
  /// A start that leaves something behind, and lives long enough or not.
  std::uint32_t live(bool long_enough, const StateIdentity& as = identity()) {
    OpenState opened = open(as);
    const std::uint32_t number = opened.start_number;
    const Records records = opened.records;
    RecordStore store(std::move(opened.file));
    ManualClock clock;
    StateBeat beat(store, records, clock.steady_now());
    store.put("mine", "x");
    clock.advance(long_enough ? seconds(6) : seconds(1));
    beat.step(clock.steady_now(), now_);
    return number;
  }
  static bool goes_on(const OpenState& opened) { return opened.records.contains("mine"); }
  [[nodiscard]] bool is_there(const std::string& name) const {
    return std::filesystem::exists(folder_.path() / name);
  }

  support::TemporaryFolder folder_;
  Timestamp now_{hours(1'000'000)};
};

TEST_F(StateFileTest, GoesOnAndCountsEachStart) {
  EXPECT_EQ(live(true), 1U);
  EXPECT_EQ(live(true), 2U);
  now_ += seconds(90);
  const OpenState third = open();
  EXPECT_EQ(third.start_number, 3U);
  EXPECT_TRUE(goes_on(third));
  EXPECT_EQ(third.away, seconds(90));
}

TEST_F(StateFileTest, AStartThatWasKilledAtOnceHasItsNumberAllTheSame) {
  EXPECT_EQ(open().start_number, 1U);
  EXPECT_EQ(open().start_number, 2U);
}

TEST_F(StateFileTest, AnotherMissionsStateIsKeptAsideAndNeverMixedIn) {
  (void)live(true);
  StateIdentity other = identity();
  other.mission_id = "another";
  const OpenState opened = open(other);
  EXPECT_EQ(opened.start_number, 1U);
  EXPECT_FALSE(goes_on(opened));
  EXPECT_TRUE(is_there("alpha.state.other-mission-1"));
}

TEST_F(StateFileTest, AnotherGridOrRoleIsKeptAside) {
  (void)live(true);
  StateIdentity finer = identity();
  finer.geometry.cell_size_m = 0.04;
  EXPECT_FALSE(goes_on(open(finer)));
  EXPECT_TRUE(is_there("alpha.state.other-grid-1"));
  StateIdentity coordinator = finer;
  coordinator.role = "coordinator";
  EXPECT_FALSE(goes_on(open(coordinator)));
  EXPECT_TRUE(is_there("alpha.state.other-owner-1"));
}

TEST_F(StateFileTest, AnOldStateIsKeptAsideButAClockThatWentBackHarmsNothing) {
  (void)live(true);
  now_ -= hours(24 * 365 * 50);
  {
    const OpenState opened = open();
    EXPECT_TRUE(goes_on(opened));
    EXPECT_EQ(opened.away, Duration{});
  }
  now_ += hours(7);
  EXPECT_FALSE(goes_on(open()));
  EXPECT_TRUE(is_there("alpha.state.old-1"));
}

TEST_F(StateFileTest, AStateThatStartsDoNotSurviveIsPutAside) {
  EXPECT_EQ(live(true), 1U);
  EXPECT_EQ(live(false), 2U);
  EXPECT_EQ(live(false), 3U);
  EXPECT_EQ(live(false), 4U);
  const OpenState fifth = open();
  EXPECT_EQ(fifth.start_number, 1U);
  EXPECT_FALSE(goes_on(fifth));
  EXPECT_TRUE(is_there("alpha.state.crashed-1"));
}

TEST_F(StateFileTest, ASoundStartInBetweenBeginsTheCountAnew) {
  for (int i = 0; i < 3; ++i) {
    (void)live(false);
    (void)live(false);
    (void)live(true);
  }
  EXPECT_TRUE(goes_on(open()));
}

TEST_F(StateFileTest, ADamagedStateIsPutAsideAndANewOneBegins) {
  (void)live(true);
  {
    std::fstream file(folder_.path() / "alpha.state",
                      std::ios::in | std::ios::out | std::ios::binary);
    file.seekp(0);
    file << std::string(200, 'x');
  }
  EXPECT_FALSE(goes_on(open()));
  EXPECT_TRUE(is_there("alpha.state.damaged-1"));
}

TEST_F(StateFileTest, WhatMakesNoSenseIsPutAsideToo) {
  (void)live(true);
  const auto again = begin_anew(open(), folder_.path(), identity(), "record x", now_);
  ASSERT_TRUE(again && *again);
  EXPECT_FALSE(goes_on(**again));
  EXPECT_TRUE(is_there("alpha.state.damaged-1"));
}

TEST_F(StateFileTest, AStateInUseIsAnErrorThatNamesIt) {
  const OpenState held = open();
  const auto second = open_state(folder_.path(), identity(), {}, now_);
  ASSERT_FALSE(second);
  EXPECT_NE(second.error().text.find("is in use by process"), std::string::npos);
  EXPECT_EQ(folder_.files(), 3U) << "the file, its log and its lock";
}

TEST_F(StateFileTest, ADiskThatRefusesIsNoError) {
  const auto file = folder_.write("file", "x");
  const auto opened = open_state(file / "sub", identity(), {}, now_);
  ASSERT_TRUE(opened);
  EXPECT_FALSE(*opened);
}

}  // namespace
}  // namespace lifeline::store
