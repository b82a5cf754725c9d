#include "common/sharing/helmet_mark.hpp"

#include <set>

#include <gtest/gtest.h>

namespace lifeline::sharing {
namespace {

TEST(HelmetMark, ALabelIsShortAndTellsHelmetsApart) {
  for (const auto& [id, label] : {std::pair("alpha", "AL"),
                                  {"ff03", "F3"},
                                  {"engine1-2", "E2"},
                                  {"helmet123", "H23"},
                                  {"7", "7"},
                                  {"007", "7"},
                                  {"a", "A"},
                                  {"x0", "X0"},
                                  {"_-", "_-"},
                                  {"helmet100", "H00"},
                                  {"", ""}}) {
    EXPECT_EQ(mark_of(id).label, label);
  }
}

// Written down in docs/hud.md and drawn by helmets of other builds.
TEST(HelmetMark, AShapeStaysAsItWasOnceGiven) {
  EXPECT_EQ(mark_of("alpha").shape, 3U);
  EXPECT_EQ(mark_of("bravo").shape, 3U);
  EXPECT_EQ(mark_of("charlie").shape, 3U);
  EXPECT_EQ(mark_of("ff12").shape, 3U);
}

TEST(HelmetMark, NumberedHelmetsHaveAllShapes) {
  std::set<std::uint32_t> shapes;
  for (int i = 1; i <= 5; ++i) shapes.insert(mark_of("ff" + std::to_string(i)).shape);
  EXPECT_EQ(shapes.size(), kMarkShapes);
}

}  // namespace
}  // namespace lifeline::sharing
