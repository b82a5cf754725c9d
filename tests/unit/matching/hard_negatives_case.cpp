// Simulated floors that tempt to a wrong merge; the benchmark runs many more of them.

#include <gtest/gtest.h>

#include "tests/bench/merge/negatives.hpp"

namespace lifeline::bench {
namespace {

TEST(HardNegativesTest, NoneOf300IsMergedAndMapsThatShareAFloorAre) {
  // No folder of plans: the same floors wherever the test runs.
  const NegativesOutcome outcome = run_negatives({.pairs = 300}, {});
  std::size_t pairs = 0, right = 0;
  for (const NegativeKind& kind : outcome.kinds) {
    EXPECT_EQ(kind.accepted_wrong, 0U) << kind.name;
    pairs += kind.pairs;
    right += kind.accepted_right;
  }
  EXPECT_EQ(pairs, 300U);
  // A matcher that merges nothing would pass else.
  EXPECT_GT(right, 50U);
  for (const FalseAccept& wrong : outcome.wrong) {
    ADD_FAILURE() << wrong.kind << ": " << wrong.a << " and " << wrong.b << ": " << wrong.reason;
  }
}

}  // namespace
}  // namespace lifeline::bench
