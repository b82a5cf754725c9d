#include "common/sharing/alert_list.hpp"

#include <algorithm>
#include <random>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/sharing_samples.hpp"

namespace lifeline::sharing {
namespace {

using ::testing::ElementsAre;

wire::Alert alert(const std::string& sender, std::uint32_t id = 1) {
  wire::Alert sample;
  sample.envelope = test::envelope(sender);
  sample.issuer_id = "alpha";
  sample.alert_id = id;
  sample.kind = wire::AlertKind::mayday;
  sample.text = "trapped";
  return sample;
}

wire::Alert answer(const std::string& sender,
                   wire::AlertState state = wire::AlertState::acknowledged) {
  auto sample = alert(sender);
  sample.state = state;
  sample.acknowledged_by = {sender};
  return sample;
}

class AlertListTest : public ::testing::Test {
 protected:
  bool put(const wire::Alert& sample, bool from_command = false) {
    return list_.apply(sample, from_command, SteadyTime{}).value();
  }
  AlertList list_;
  const AlertKey key_{"alpha", 1};
};

TEST_F(AlertListTest, AnswersAreGatheredInAnyOrderAndRepeatsChangeNothing) {
  std::vector<wire::Alert> samples{alert("alpha"), answer("bravo"), answer("charlie"),
                                   answer("delta")};
  std::mt19937 random(7);
  for (int i = 0; i < 20; ++i) {
    std::shuffle(samples.begin(), samples.end(), random);
    AlertList list;
    for (const auto& sample : samples) EXPECT_TRUE(list.apply(sample, false, {}).value());
    for (const auto& sample : samples) EXPECT_FALSE(list.apply(sample, false, {}).value());
    const auto* entry = list.find(key_);
    ASSERT_NE(entry, nullptr);
    EXPECT_EQ(entry->alert.text, "trapped");
    EXPECT_EQ(entry->alert.state, wire::AlertState::acknowledged);
    EXPECT_THAT(entry->alert.acknowledged_by, ElementsAre("bravo", "charlie", "delta"));
  }
}

TEST_F(AlertListTest, NobodyAnswersForAnother) {
  put(alert("alpha"));
  auto forged = answer("bravo");
  forged.acknowledged_by = {"charlie", "vehicle"};
  put(forged);
  EXPECT_TRUE(list_.find(key_)->alert.acknowledged_by.empty());
}

TEST_F(AlertListTest, NobodyElseSaysWhatAnAlertIsAbout) {
  auto changed = answer("bravo");
  changed.kind = wire::AlertKind::roll_call;
  changed.text = "all is well";
  put(changed);
  EXPECT_EQ(list_.find(key_), nullptr) << "its issuer was not heard";
  put(alert("alpha"));
  EXPECT_EQ(list_.find(key_)->alert.kind, wire::AlertKind::mayday);
  EXPECT_EQ(list_.find(key_)->alert.text, "trapped");
}

TEST_F(AlertListTest, OnlyItsIssuerAndTheCommandEndIt) {
  put(alert("alpha"));
  put(answer("bravo", wire::AlertState::cleared));
  EXPECT_EQ(list_.find(key_)->alert.state, wire::AlertState::acknowledged);
  put(answer("vehicle", wire::AlertState::cleared), true);
  EXPECT_EQ(list_.find(key_)->alert.state, wire::AlertState::cleared);
  put(alert("alpha"));
  EXPECT_EQ(list_.find(key_)->alert.state, wire::AlertState::cleared) << "what is over stays so";
}

TEST_F(AlertListTest, TheIssuerSaysAllNamesOnceItHeardThem) {
  put(alert("alpha"));
  EXPECT_TRUE(list_.find(key_)->is_gathered);
  put(answer("bravo"));
  EXPECT_FALSE(list_.find(key_)->is_gathered);
  auto gathered = alert("alpha");
  gathered.acknowledged_by = {"bravo"};
  put(gathered);
  EXPECT_TRUE(list_.find(key_)->is_gathered);
}

TEST_F(AlertListTest, WhatIsHostileIsRefused) {
  auto bad = alert("alpha");
  bad.kind = static_cast<wire::AlertKind>(3);
  EXPECT_FALSE(list_.apply(bad, false, {}));
  bad = alert("alpha");
  bad.subject_id = "<script>";
  EXPECT_FALSE(list_.apply(bad, false, {}));
  bad = alert("alpha");
  bad.acknowledged_by = {"no name"};
  EXPECT_FALSE(list_.apply(bad, false, {}));
  bad = alert("alpha");
  bad.text.assign(200, 'x');
  EXPECT_FALSE(list_.apply(bad, false, {}));
  EXPECT_TRUE(list_.entries().empty());
}

/// As many alerts as `count` tells, of the issuer's own, from `first_id` on.
void flood(AlertList& list, const std::string& issuer, std::size_t count, SteadyTime now = {}) {
  for (std::size_t id = 0; id < count; ++id) {
    auto sample = alert(issuer, static_cast<std::uint32_t>(id));
    sample.issuer_id = issuer;
    (void)list.apply(sample, false, now);
  }
}

std::size_t told_by(const AlertList& list, const std::string& issuer) {
  return static_cast<std::size_t>(std::ranges::count_if(list.entries(), [&](const auto& held) {
    return held.first.first == issuer && held.second.is_told;
  }));
}

TEST_F(AlertListTest, AFloodOfOneSenderLeavesRoomForTheOthers) {
  flood(list_, "alpha", 2 * AlertList::kMostPerSender);
  EXPECT_EQ(list_.entries().size(), AlertList::kMostPerSender);
  flood(list_, "bravo", 1);
  EXPECT_EQ(told_by(list_, "bravo"), 1U);
}

TEST_F(AlertListTest, AMaydayFindsRoomInAListThatAFewHaveFilled) {
  constexpr int kFlooders = 10;  // more than it takes
  for (int i = 0; i < kFlooders; ++i)
    flood(list_, "flood-" + std::to_string(i), AlertList::kMostPerSender);
  ASSERT_EQ(list_.entries().size(), AlertList::kMost);
  put(alert("alpha"));
  ASSERT_NE(list_.find(key_), nullptr);
  for (int i = 0; i < kFlooders; ++i)
    flood(list_, "flood-" + std::to_string(i), 2 * AlertList::kMostPerSender);
  EXPECT_NE(list_.find(key_), nullptr) << "and keeps it";
  EXPECT_EQ(list_.entries().size(), AlertList::kMost);
}

TEST_F(AlertListTest, WhoAnswersWhatNobodyRaisedTakesNobodysPlace) {
  for (std::uint32_t id = 0; id < 2 * AlertList::kMost; ++id) {
    auto forged = answer("bravo");
    forged.alert_id = id + 1000;
    (void)list_.apply(forged, false, {});
  }
  EXPECT_EQ(list_.entries().size(), AlertList::kMostPerSender);
  flood(list_, "alpha", AlertList::kMostPerSender);
  EXPECT_EQ(told_by(list_, "alpha"), AlertList::kMostPerSender);
}

TEST_F(AlertListTest, InAFullListAnswersToTheUnheardGoBeforeAlertsAndTheOldestFirst) {
  for (std::uint32_t id = 0; id < AlertList::kMostPerSender / 2; ++id) {
    auto forged = answer("flood-0");
    forged.alert_id = id + 1000;
    (void)list_.apply(forged, false, SteadyTime{std::chrono::seconds(9)});
  }
  flood(list_, "flood-0", AlertList::kMostPerSender / 2);
  for (int i = 1; i < 8; ++i)
    flood(list_, "flood-" + std::to_string(i), AlertList::kMostPerSender - 1);
  for (int i = 0; i < 7; ++i) flood(list_, "rest-" + std::to_string(i), 1);
  ASSERT_EQ(list_.entries().size(), AlertList::kMost);
  flood(list_, "charlie", 1);
  EXPECT_EQ(told_by(list_, "charlie"), 1U);
  EXPECT_EQ(told_by(list_, "flood-0"), AlertList::kMostPerSender / 2);
}

TEST_F(AlertListTest, WhatIsOverMakesRoomFirst) {
  for (int i = 0; i < 8; ++i) flood(list_, "flood-" + std::to_string(i), AlertList::kMostPerSender);
  auto over = alert("flood-3", 7);
  over.issuer_id = "flood-3";
  over.state = wire::AlertState::cleared;
  put(over);
  put(alert("alpha"));
  EXPECT_NE(list_.find(key_), nullptr);
  EXPECT_EQ(list_.find({"flood-3", 7}), nullptr);
}

}  // namespace
}  // namespace lifeline::sharing
