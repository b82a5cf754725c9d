#include "common/sharing/flood_watch.hpp"

#include <gtest/gtest.h>

#include "tests/support/logged.hpp"

namespace lifeline::sharing {
namespace {

using std::chrono::microseconds;
using std::chrono::seconds;

class FloodWatchTest : public testing::Test {
 protected:
  /// Samples at an even rate from now on; how often their sender was named.
  int hear(const std::string& sender, double per_second, Duration time) {
    const auto count = static_cast<int>(per_second * to_seconds(time));
    int named = 0;
    for (int i = 0; i < count; ++i) {
      now_ += from_seconds(1.0 / per_second);
      named += watch_.note("tsd_tile", sender, now_) ? 1 : 0;
    }
    return named;
  }

  const test::Logged log_;
  FloodWatch watch_;
  SteadyTime now_{std::chrono::hours(1)};
};

TEST_F(FloodWatchTest, AThousandSamplesASecondAreNamedOnceHoweverLongTheyLast) {
  EXPECT_EQ(hear("mallory", 1000.0, seconds(30)), 1);
  EXPECT_EQ(watch_.floods(), 1U);
  EXPECT_NE(log_.text().find("mallory floods tsd_tile"), std::string::npos);
}

TEST_F(FloodWatchTest, WhoSendsWhatABudgetAllowsIsNotNamed) {
  EXPECT_EQ(hear("alpha", 300.0, seconds(30)), 0);
}

TEST_F(FloodWatchTest, WhoWasQuietMeanwhileIsNamedAgain) {
  EXPECT_EQ(hear("mallory", 1000.0, seconds(5)), 1);
  EXPECT_EQ(hear("mallory", 10.0, seconds(10)), 0);
  EXPECT_EQ(hear("mallory", 1000.0, seconds(5)), 1);
}

TEST_F(FloodWatchTest, AFloodOfNamesTakesNoMoreMemory) {
  for (int i = 0; i < 100'000; ++i) {
    now_ += microseconds(10);
    EXPECT_FALSE(watch_.note("tsd_tile", std::to_string(i), now_));
  }
}

}  // namespace
}  // namespace lifeline::sharing
