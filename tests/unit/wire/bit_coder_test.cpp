#include "common/wire/bit_coder.hpp"

#include <algorithm>

#include <gtest/gtest.h>

namespace lifeline::wire {
namespace {

// idl/tile.proto's arithmetic, with the divisions that it is written in.
std::uint32_t trust_by_division(std::uint64_t p, std::uint64_t seen) {
  return static_cast<std::uint32_t>((10 * seen + 3) * 65536 / (p * (65536 - p) / 65536 + 1311));
}
std::uint32_t learnt_by_division(std::int64_t p, std::int64_t seen, bool bit) {
  return static_cast<std::uint32_t>(p + ((bit ? 65535 : 0) - p) * 10 / (10 * seen + 16));
}

TEST(BitEstimateTest, IsTheSameAsByDivisionFromEveryState) {
  for (unsigned seen = 0; seen <= BitEstimate::kMaxSeen; ++seen) {
    for (unsigned p = 0; p < BitEstimate::kOne; ++p) {
      for (const bool bit : {false, true}) {
        BitEstimate estimate;
        estimate.probability = static_cast<std::uint16_t>(p);
        estimate.seen = static_cast<std::uint16_t>(seen);
        ASSERT_EQ(estimate.trust(), trust_by_division(p, seen)) << p << " after " << seen;
        estimate.learn(bit);
        ASSERT_EQ(estimate.probability, learnt_by_division(p, seen, bit)) << p << " after " << seen;
        ASSERT_EQ(estimate.seen, std::min(seen + 1, BitEstimate::kMaxSeen));
      }
    }
  }
}

}  // namespace
}  // namespace lifeline::wire
