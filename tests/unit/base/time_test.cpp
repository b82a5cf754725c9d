#include "common/base/time.hpp"

#include <gtest/gtest.h>

#include "common/base/decimal_seconds.hpp"
#include "common/base/quantile.hpp"

namespace lifeline {
namespace {

using namespace std::chrono_literals;

TEST(Seconds, ConvertBothWays) {
  EXPECT_DOUBLE_EQ(to_seconds(1500ms), 1.5);
  EXPECT_EQ(from_seconds(-0.25), -250ms);
}

TEST(ManualClock, StandsStillUntilToldOtherwise) {
  ManualClock clock;
  const SteadyTime steady = clock.steady_now();
  const Timestamp wall = clock.wall_now();
  EXPECT_EQ(clock.steady_now(), steady);
  clock.advance(3s);
  EXPECT_EQ(clock.steady_now() - steady, 3s);
  EXPECT_EQ(clock.wall_now() - wall, 3s);
}

TEST(SystemClock, NeverGoesBack) {
  const SystemClock clock;
  const SteadyTime before = clock.steady_now();
  EXPECT_GE(clock.steady_now(), before);
  EXPECT_GT(clock.wall_now().time_since_epoch(), 24h * 365 * 50);
}

TEST(DecimalSeconds, KeepEveryNanosecond) {
  EXPECT_EQ(parse_decimal_seconds("976052890.244111"), Duration(976'052'890'244'111'000));
  EXPECT_EQ(parse_decimal_seconds("1699999999.123456789"), Duration(1'699'999'999'123'456'789));
  EXPECT_EQ(parse_decimal_seconds("-1.500000001"), Duration(-1'500'000'001));
  EXPECT_EQ(parse_decimal_seconds("1.13486e+09"), Duration(1'134'860'000'000'000'000));
  EXPECT_EQ(parse_decimal_seconds("25e-1"), 2500ms);
  EXPECT_EQ(parse_decimal_seconds(".5"), 500ms);
  EXPECT_EQ(parse_decimal_seconds("0"), 0ns);
}

TEST(DecimalSeconds, RoundWhatLiesBeyondTheNanosecond) {
  EXPECT_EQ(parse_decimal_seconds("0.0000000014"), 1ns);
  EXPECT_EQ(parse_decimal_seconds("0.0000000015"), 2ns);
}

TEST(DecimalSeconds, AreEmptyForAnyOtherText) {
  for (const char* bad : {"", "-", ".", "nan", "inf", "1.2.3", "1e", "0x1", "1 ", " 1", "5e9",
                          "1e99999", "123456789012345678901"}) {
    EXPECT_EQ(parse_decimal_seconds(bad), std::nullopt) << bad;
  }
}

TEST(Quantile, IsTheNearestRank) {
  EXPECT_EQ(quantile({}, 0.5), 0.0);
  EXPECT_EQ(quantile({7.0}, 0.99), 7.0);
  EXPECT_EQ(quantile({5.0, 1.0, 3.0, 2.0, 4.0}, 0.5), 3.0);
  EXPECT_EQ(quantile({5.0, 1.0, 3.0, 2.0, 4.0}, 0.0), 1.0);
  EXPECT_EQ(quantile({5.0, 1.0, 3.0, 2.0, 4.0}, 1.0), 5.0);
}

}  // namespace
}  // namespace lifeline
