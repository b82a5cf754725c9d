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
