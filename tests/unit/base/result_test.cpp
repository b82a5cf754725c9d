#include "common/base/result.hpp"

#include <string>

#include <gtest/gtest.h>

#include "common/base/check.hpp"

namespace lifeline {
namespace {

Result<int> half_of(int number) {
  if (number % 2 != 0) return fail(ErrorCode::bad_data, "{} is odd; give an even one", number);
  return number / 2;
}

Result<std::string> half_as_text(int number) {
  const auto half = half_of(number);
  if (!half) return forward_error(half);
  return std::to_string(*half);
}

TEST(Result, HoldsAValueOrTheReasonWhyNot) {
  EXPECT_EQ(half_of(8).value(), 4);
  ASSERT_FALSE(half_of(7));
  EXPECT_EQ(half_of(7).error().code, ErrorCode::bad_data);
  EXPECT_EQ(half_of(7).error().text, "7 is odd; give an even one");
}

TEST(Result, AnErrorPassesOnToAnotherType) {
  EXPECT_EQ(half_as_text(8).value(), "4");
  EXPECT_EQ(half_as_text(7).error().text, "7 is odd; give an even one");
}

TEST(CheckDeath, ABugNamesItsConditionAndPlace) {
  const int legs = 5;
  EXPECT_DEATH(LIFELINE_CHECK(legs == 4), "result_test.cpp:[0-9]+: bug: legs == 4 does not hold");
  LIFELINE_CHECK(legs == 5);
}

}  // namespace
}  // namespace lifeline
