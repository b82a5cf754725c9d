#include "common/base/ids.hpp"

#include <set>
#include <string>

#include <gmock/gmock.h>

namespace lifeline {
namespace {

using ::testing::HasSubstr;

LayerKey layer(const char* agent, std::uint32_t map, std::int16_t floor) {
  return {AgentId::parse(agent).value(), {map}, {floor}};
}

TEST(AgentId, TakesLettersDigitsAndThreeSigns) {
  EXPECT_EQ(AgentId::parse("Alpha-1_b.c").value().text(), "Alpha-1_b.c");
  EXPECT_TRUE(AgentId::parse(std::string(32, 'a')));
}

TEST(AgentId, RefusesWhatCouldBreakAFileNameATopicOrALog) {
  for (const char* bad : {"a b", "a/b", "a\nb", "ä", "a\"", "a$", "*"}) {
    const auto id = AgentId::parse(bad);
    ASSERT_FALSE(id) << bad;
    EXPECT_EQ(id.error().code, ErrorCode::wrong_use);
    EXPECT_THAT(id.error().text, HasSubstr("outside of a-z A-Z 0-9 _ - ."));
  }
}

TEST(AgentId, RefusesEmptyAndLongNamesWithTheirLength) {
  EXPECT_EQ(AgentId::parse("").error().text, "agent id has 0 characters; give 1 to 32");
  EXPECT_EQ(AgentId::parse(std::string(33, 'a')).error().text,
            "agent id has 33 characters; give 1 to 32");
}

TEST(LayerKey, IsOrderedByAgentThenMapThenFloor) {
  EXPECT_LT(layer("alpha", 9, 9), layer("bravo", 1, 1));
  EXPECT_LT(layer("alpha", 2, 9), layer("alpha", 10, 1));
  EXPECT_LT(layer("alpha", 2, -1), layer("alpha", 2, 0));
  EXPECT_EQ(layer("alpha", 2, 0), layer("alpha", 2, 0));
}

TEST(LayerKey, NamesItsFloorOnlyOffTheGround) {
  EXPECT_EQ(to_string(layer("alpha", 1, 0)), "alpha/1");
  EXPECT_EQ(to_string(layer("alpha", 3, -2)), "alpha/3@-2");
}

TEST(Incarnation, IsNeitherZeroNorTheSameTwice) {
  std::set<Incarnation> seen;
  for (int i = 0; i < 100; ++i) EXPECT_TRUE(seen.insert(random_incarnation()).second);
  EXPECT_FALSE(seen.contains(Incarnation{0}));
}

}  // namespace
}  // namespace lifeline
