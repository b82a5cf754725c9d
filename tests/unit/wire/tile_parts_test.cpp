#include "common/wire/tile_parts.hpp"

#include <numeric>

#include <gtest/gtest.h>

#include "common/wire/limits.hpp"

namespace lifeline::wire {
namespace {

std::vector<std::uint8_t> counted(std::size_t size) {
  std::vector<std::uint8_t> octets(size);
  std::iota(octets.begin(), octets.end(), std::uint8_t{0});
  return octets;
}

TEST(SplitPayload, GivesFullPartsAndTheRest) {
  for (const auto& [size, parts, last] :
       {std::tuple<std::size_t, std::size_t, std::size_t>{1, 1, 1},
        {kMaxTilePart, 1, kMaxTilePart},
        {kMaxTilePart + 1, 2, 1},
        {kMaxTilePayload, kMaxTileParts, 192}}) {
    const auto split = split_payload(counted(size));
    ASSERT_EQ(split.size(), parts) << size;
    EXPECT_EQ(split.back().size(), last) << size;
  }
}

TEST(TileParts, JoinedInAnyOrderGiveThePayload) {
  const auto payload = counted(2 * kMaxTilePart + 7);
  const auto split = split_payload(payload);
  TileParts parts;
  TsdTile sample;
  sample.revision = 5;
  sample.parts = 3;
  for (const std::uint8_t part : {std::uint8_t{2}, std::uint8_t{0}}) {
    sample.part = part;
    sample.payload = split[part];
    EXPECT_FALSE(parts.add(sample).value());
  }
  sample.part = 1;
  sample.payload = split[1];
  EXPECT_EQ(parts.add(sample).value(), payload);
}

class TwoRevisions : public testing::Test {
 protected:
  std::optional<std::vector<std::uint8_t>> add(std::uint64_t revision, std::uint8_t part) {
    TsdTile sample;
    sample.revision = revision;
    sample.parts = 2;
    sample.part = part;
    sample.payload = {static_cast<std::uint8_t>(revision), part};
    return parts_.add(sample).value();
  }
  TileParts parts_;
};

TEST_F(TwoRevisions, AnOlderOneIsJoinedWhileTheRestOfTheNewestDoesNotCome) {
  EXPECT_FALSE(add(3, 0));
  EXPECT_FALSE(add(2, 0));
  EXPECT_EQ(add(2, 1), (std::vector<std::uint8_t>{2, 0, 2, 1}));
  EXPECT_EQ(add(3, 1), (std::vector<std::uint8_t>{3, 0, 3, 1}));
  EXPECT_TRUE(parts_.empty());
}

TEST_F(TwoRevisions, TheNewestEndsTheOlderOne) {
  EXPECT_FALSE(add(2, 0));
  EXPECT_FALSE(add(3, 0));
  EXPECT_TRUE(add(3, 1));
  EXPECT_TRUE(parts_.empty());
}

TEST_F(TwoRevisions, OfThreeTheOldestOtherIsForgotten) {
  EXPECT_FALSE(add(3, 0));
  EXPECT_FALSE(add(4, 0));
  EXPECT_FALSE(add(2, 0));  // instead of 3
  EXPECT_TRUE(add(2, 1));
  EXPECT_FALSE(add(3, 1));
  EXPECT_TRUE(add(4, 1));
}

TEST(TileParts, APartThatIsTooLargeIsRefused) {
  TileParts parts;
  TsdTile sample;
  sample.revision = 1;
  sample.payload = counted(kMaxTilePart + 1);
  const auto added = parts.add(sample);
  ASSERT_FALSE(added);
  EXPECT_EQ(added.error().text, "tile refused: a part of 1001 octets, at most 1000 are allowed");
}

}  // namespace
}  // namespace lifeline::wire
