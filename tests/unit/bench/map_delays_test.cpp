#include "tests/bench/mission/map_delays.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/temporary_folder.hpp"

namespace lifeline::bench {
namespace {

using testing::DoubleNear;
using testing::ElementsAre;
using testing::IsEmpty;

// Both have shared since 1.2; the line at 9 is the last.
constexpr const char* kAlpha = R"({"fused":[0,0],"of":"alpha","revision":1,"at_s":1.0}
{"fused":[0,0],"of":"bravo","revision":1,"at_s":1.1}
{"published":[0,0],"revision":2,"scanned_at_s":1.9,"at_s":2.0}
{"fused":[0,0],"of":"alpha","revision":2,"at_s":2.01}
{"published":[3,0],"revision":1,"scanned_at_s":2.5,"at_s":2.6}
{"fused":[3,0],"of":"alpha","revision":1,"at_s":2.6}
{"fused":[9,9],"of":"bravo","revision":1,"at_s":9.0}
)";
constexpr const char* kBravo = R"({"fused":[0,0],"of":"bravo","revision":1,"at_s":1.1}
{"fused":[0,0],"of":"alpha","revision":1,"at_s":1.2}
{"fused":[0,0],"of":"alpha","revision":3,"at_s":2.2}
{"fused":[9,9],"of":"bravo","revision":1,"at_s":9.0}
)";

class MapDelaysTest : public testing::Test {
 protected:
  [[nodiscard]] Result<MapDelays> delays(const std::string& alpha, const std::string& bravo) const {
    return map_delays({{"alpha", folder_.write("alpha.journal", alpha)},
                       {"bravo", folder_.write("bravo.journal", bravo)}},
                      3.0);
  }
  support::TemporaryFolder folder_;
};

TEST_F(MapDelaysTest, AreFromTheScanUntilTheLastHasItOrANewerRevision) {
  const auto found = delays(kAlpha, kBravo);
  ASSERT_TRUE(found) << found.error().text;
  EXPECT_THAT(found->seconds, ElementsAre(DoubleNear(0.3, 1e-9)));
  EXPECT_THAT(found->until_published_s, ElementsAre(DoubleNear(0.1, 1e-9)));
  EXPECT_THAT(found->until_fused_s, ElementsAre(DoubleNear(0.2, 1e-9)));
}

TEST_F(MapDelaysTest, CountARevisionThatDidNotReachSomebody) {
  EXPECT_EQ(delays(kAlpha, kBravo)->missing, 1U);
}

TEST_F(MapDelaysTest, LeaveOutWhatWasPublishedBeforeAllShared) {
  const auto found = delays(R"({"published":[0,0],"revision":1,"scanned_at_s":0.1,"at_s":0.2}
)" + std::string(kAlpha),
                            kBravo);
  EXPECT_EQ(found->seconds.size() + found->missing, 2U);
}

TEST_F(MapDelaysTest, AreNoneWhereTwoNeverShared) {
  const auto found = delays(kAlpha, R"({"fused":[0,0],"of":"bravo","revision":1,"at_s":9.0}
)");
  EXPECT_THAT(found->seconds, IsEmpty());
}

TEST_F(MapDelaysTest, ALineThatIsNoneIsNamed) {
  const auto found = delays("nonsense\n{}\n", kBravo);
  ASSERT_FALSE(found);
  EXPECT_THAT(found.error().text, testing::HasSubstr("alpha.journal"));
}

}  // namespace
}  // namespace lifeline::bench
