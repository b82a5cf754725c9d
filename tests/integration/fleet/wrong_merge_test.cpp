// A wrong T_G gets into the fleet, by a misled match or by a coordinator that is none: it is taken
// back, and every common map is again what it was, to the bit.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/sharing/fixed_transform.hpp"
#include "tests/integration/fleet/drill.hpp"

namespace lifeline::test {
namespace {

using testing::HasSubstr;

/// Matches as the real one does, but while it is misled it is sure of a wrong place for one pair.
class MisledWorker final : public MatchWorker {
 public:
  void submit(MatchJob job) override { worker_.submit(std::move(job)); }
  [[nodiscard]] bool busy() const override { return worker_.busy(); }
  [[nodiscard]] std::optional<MatchOutcome> take() override {
    auto outcome = worker_.take();
    if (!outcome || !misled_ || outcome->a.layer.agent_id.text() != "alpha" ||
        outcome->b.layer.agent_id.text() != "bravo") {
      return outcome;
    }
    ++told_;
    auto& result = outcome->result;
    result.verdict = matching::Verdict::accepted;
    result.reason = "misled";
    result.candidates.resize(1);
    result.candidates.front().T_a_b = result.candidates.front().T_a_b * Pose2{2.0, -1.0, 0.5};
    result.candidates.front().agreeing_wall_m = result.candidates.front().score = 40.0;
    return outcome;
  }
  void mislead(bool misled) { misled_ = misled; }
  [[nodiscard]] int told() const { return told_; }

 private:
  InlineMatchWorker worker_{matching::MatchConfig{}};
  bool misled_ = false;
  int told_ = 0;
};

CoordinatorSettings exact_settings() {
  auto settings = ScriptedFleet::default_settings();
  settings.directive.min_move_m = 0.0;  // the directive is the plan, to the last micrometre
  return settings;
}

class WrongMergeTest : public testing::Test {
 protected:
  WrongMergeTest() {
    auto worker = std::make_unique<MisledWorker>();
    worker_ = worker.get();
    drill_ = std::make_unique<Drill>(1, ids_, exact_settings(), std::move(worker));
    for (const double until_s : {30, 34, 38}) drill_->walk_to(until_s);
    drill_->finish();
  }
  [[nodiscard]] ScriptedFleet& fleet() { return drill_->fleet(); }
  [[nodiscard]] std::string hash() { return fleet().common_hash(ids_); }
  /// Republishes bravo's layer, with or without a corner of it: a change, so that it is matched.
  void show_bravo(bool whole) {
    TsdGrid layer = drill_->layer("bravo");
    if (!whole) layer.erase(layer.tiles().front());
    fleet().helmet("bravo").show(layer);
  }

  const std::vector<std::string> ids_{"alpha", "bravo", "charlie"};
  std::unique_ptr<Drill> drill_;
  MisledWorker* worker_ = nullptr;
};

TEST_F(WrongMergeTest, OfAMisledMatchIsTakenBackByTheNextMatches) {
  ASSERT_EQ(fleet().group(), ids_);
  const std::string before = hash();
  ASSERT_NE(before, "differ");
  const auto epoch = fleet().coordinator().directive().epoch;

  worker_->mislead(true);
  show_bravo(false);
  fleet().run(std::chrono::seconds(3));
  EXPECT_GT(worker_->told(), 0);
  EXPECT_NE(hash(), before);
  EXPECT_GT(fleet().coordinator().directive().epoch, epoch);
  std::string reasons;
  for (const auto& evidence : fleet().evidence()) reasons += evidence.reason + "\n";
  EXPECT_THAT(reasons, HasSubstr("not followed: "));

  worker_->mislead(false);
  show_bravo(true);
  fleet().run(std::chrono::seconds(8));
  EXPECT_EQ(fleet().group(), ids_);
  EXPECT_EQ(hash(), before);
}

TEST_F(WrongMergeTest, OfACoordinatorThatIsNoneIsOutranked) {
  ASSERT_EQ(fleet().group(), ids_);
  const std::string before = hash();
  ASSERT_NE(before, "differ");

  wire::MergeDirective forged = fleet().coordinator().directive();
  forged.envelope.mission_id = forged.mission_id;
  forged.envelope.sender_id = "stranger";
  forged.epoch += 1000;
  for (auto& member : forged.members) {
    if (member.layer.agent_id == "bravo") member.T_common_map = sharing::to_fixed({9.0, -3.0, 1.0});
  }
  ASSERT_TRUE(fleet().bus().writer<wire::MergeDirective>()->put(forged));
  fleet().run(std::chrono::milliseconds(100));
  EXPECT_EQ(fleet().helmet("alpha").sharing().map().epoch(), Epoch{forged.epoch});
  EXPECT_EQ(hash(), "differ");

  fleet().run(std::chrono::seconds(2));
  EXPECT_GT(fleet().helmet("alpha").sharing().map().epoch(), Epoch{forged.epoch});
  EXPECT_EQ(hash(), before);
}

}  // namespace
}  // namespace lifeline::test
