#include "common/sharing/link_pace.hpp"

#include <algorithm>
#include <deque>
#include <vector>

#include <gtest/gtest.h>

#include "common/base/quantile.hpp"

namespace lifeline::sharing {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

constexpr Duration kStep = milliseconds(20);

/// A sender that always has something to send, and a link with a queue: what does not fit in is
/// dropped. What receivers tell is 1.5 s old.
class LinkPaceTest : public testing::Test {
 protected:
  void send_for(Duration time) {
    for (const SteadyTime until = now_ + time; now_ < until; now_ += kStep) {
      const double dt_s = to_seconds(kStep);
      queued_bits_ = std::min(queued_bits_ + pace_.rate_bit_s() * dt_s, kQueue_bits);
      const double passes_bits = std::min(queued_bits_, link_bit_s_ * dt_s);
      queued_bits_ -= passes_bits;
      passed_bits_ += passes_bits;
      delays_s_.push_back(queued_bits_ / link_bit_s_);
      on_their_way_.push_back(from_seconds(delays_s_.back()));
      if (on_their_way_.size() > static_cast<std::size_t>(milliseconds(1500) / kStep))
        on_their_way_.pop_front();
      if (!pace_.is_due(now_)) continue;
      pace_.look(now_, static_cast<std::uint64_t>(passed_bits_ / 8.0), {8, on_their_way_.front()});
    }
  }
  void forget() {
    delays_s_.clear();
    passed_bits_before_ = passed_bits_;
  }
  double mean_bit_s(Duration time) const {
    return (passed_bits_ - passed_bits_before_) / to_seconds(time);
  }

  static constexpr double kQueue_bits = 8 * 22'000;
  double link_bit_s_ = 250'000;
  double queued_bits_ = 0.0, passed_bits_ = 0.0, passed_bits_before_ = 0.0;
  std::vector<double> delays_s_;
  std::deque<Duration> on_their_way_;
  SteadyTime now_{seconds(100)};
  LinkPace pace_{256'000};
};

TEST_F(LinkPaceTest, KeepsTheQueueOfANarrowLinkShortAndTheLinkBusy) {
  for (const double most_bit_s : {256'000.0, 2'000'000.0, 50'000'000.0}) {
    SCOPED_TRACE(most_bit_s);
    pace_ = LinkPace(most_bit_s);
    send_for(seconds(20));
    forget();
    send_for(seconds(120));
    EXPECT_LT(quantile(delays_s_, 0.95), 0.5);
    EXPECT_LT(quantile(delays_s_, 0.5), 0.2);
    EXPECT_GT(mean_bit_s(seconds(120)), 0.7 * link_bit_s_);
  }
}

TEST_F(LinkPaceTest, UsesALinkThatBecameBetter) {
  pace_ = LinkPace(2'000'000);
  send_for(seconds(60));
  link_bit_s_ = 10'000'000;
  send_for(seconds(60));
  EXPECT_EQ(pace_.rate_bit_s(), 2'000'000);
}

TEST_F(LinkPaceTest, LeavesALinkThatPassesAllAsItIs) {
  link_bit_s_ = 300'000;
  send_for(seconds(60));
  EXPECT_EQ(pace_.rate_bit_s(), 256'000);
}

TEST_F(LinkPaceTest, AMachineThatWasBusyForAMomentSlowsNothing) {
  pace_.look(now_, 0, {8, milliseconds(20)});
  pace_.look(now_ += seconds(1), 10'000, {8, milliseconds(900)});
  pace_.look(now_ += seconds(1), 20'000, {8, milliseconds(20)});
  EXPECT_EQ(pace_.rate_bit_s(), 256'000);
}

TEST_F(LinkPaceTest, WhereNobodyTellsADelayNothingIsSlowedDown) {
  for (int i = 0; i < 60; ++i) pace_.look(now_ += seconds(1), 0, {8, std::nullopt});
  EXPECT_EQ(pace_.rate_bit_s(), 256'000);
}

TEST_F(LinkPaceTest, WhoSendsLittleIsNotStoppedByALinkThatOthersFill) {
  for (int i = 0; i < 600; ++i) pace_.look(now_ += seconds(1), 0, {8, seconds(5)});
  EXPECT_EQ(pace_.rate_bit_s(), 96'000);
  pace_ = LinkPace(2'000'000);  // many receivers
  for (int i = 0; i < 600; ++i) pace_.look(now_ += seconds(1), 0, {32, seconds(5)});
  EXPECT_EQ(pace_.rate_bit_s(), 384'000);
  pace_ = LinkPace(20'000);  // configured for less
  for (int i = 0; i < 600; ++i) pace_.look(now_ += seconds(1), 0, {8, seconds(5)});
  EXPECT_EQ(pace_.rate_bit_s(), 20'000);
}

}  // namespace
}  // namespace lifeline::sharing
