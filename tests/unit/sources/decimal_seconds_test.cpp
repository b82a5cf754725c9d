#include "common/base/decimal_seconds.hpp"

#include <gtest/gtest.h>

namespace lifeline::sources {
namespace {

using std::chrono::nanoseconds;

TEST(DecimalSeconds, KeepsEveryDigitOfATimeSince1970) {
  EXPECT_EQ(parse_decimal_seconds("976052890.244111"), nanoseconds(976052890'244111000));
  EXPECT_EQ(parse_decimal_seconds("1763844090.123456789"), nanoseconds(1763844090'123456789));
  EXPECT_EQ(parse_decimal_seconds("976052857.3373"), nanoseconds(976052857'337300000));
}

TEST(DecimalSeconds, ReadsPlainExponentAndNegativeForms) {
  EXPECT_EQ(parse_decimal_seconds("0"), nanoseconds(0));
  EXPECT_EQ(parse_decimal_seconds("5."), nanoseconds(5'000'000'000));
  EXPECT_EQ(parse_decimal_seconds(".5"), nanoseconds(500'000'000));
  EXPECT_EQ(parse_decimal_seconds("0018.25"), nanoseconds(18'250'000'000));
  EXPECT_EQ(parse_decimal_seconds("1.13486e+09"), nanoseconds(1'134'860'000'000'000'000));
  EXPECT_EQ(parse_decimal_seconds("25E-1"), nanoseconds(2'500'000'000));
  EXPECT_EQ(parse_decimal_seconds("-1.5"), nanoseconds(-1'500'000'000));
}

TEST(DecimalSeconds, RoundsWhatIsFinerThanANanosecond) {
  EXPECT_EQ(parse_decimal_seconds("0.0000000004"), nanoseconds(0));
  EXPECT_EQ(parse_decimal_seconds("0.0000000005"), nanoseconds(1));
  EXPECT_EQ(parse_decimal_seconds("-0.0000000016"), nanoseconds(-2));
  EXPECT_EQ(parse_decimal_seconds("1.00000000000000000000000000000000001"),
            nanoseconds(1'000'000'000));
  EXPECT_EQ(parse_decimal_seconds("5e-300"), nanoseconds(0));
}

TEST(DecimalSeconds, RefusesWhatIsNoTime) {
  for (const char* text : {"", "-", ".", "x", "1x", "1.2.3", "1e", "1e+", "1e99999", "nan", "inf",
                           " 1", "1 ", "+1", "--1", "0x10", "1e5.5"}) {
    EXPECT_EQ(parse_decimal_seconds(text), std::nullopt) << text;
  }
}

TEST(DecimalSeconds, RefusesTimesThatCouldOverflow) {
  EXPECT_EQ(parse_decimal_seconds("4000000000"), nanoseconds(4'000'000'000'000'000'000));
  EXPECT_EQ(parse_decimal_seconds("4000000000.000000001"), std::nullopt);
  EXPECT_EQ(parse_decimal_seconds("-4000000001"), std::nullopt);
  EXPECT_EQ(parse_decimal_seconds("1e300"), std::nullopt);
  EXPECT_EQ(parse_decimal_seconds("123456789012345678901234567890"), std::nullopt);
}

}  // namespace
}  // namespace lifeline::sources
