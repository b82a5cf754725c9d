// Four helmets of which one draws a bent map: its heading drifts along the walk.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/integration/fleet/drill.hpp"

namespace lifeline::test {
namespace {

using testing::AnyOf;
using testing::ElementsAre;
using testing::HasSubstr;

struct Bend {
  std::uint64_t building;
  double drift_rad_per_m;
};

void PrintTo(const Bend& bend, std::ostream* out) {
  *out << "building " << bend.building << ", " << bend.drift_rad_per_m << " rad/m";
}

class BentMapTest : public testing::TestWithParam<Bend> {
 protected:
  BentMapTest() : drill_(GetParam().building, {"alpha", "bravo", "charlie", "delta"}) {
    drill_.view("delta").drift_rad_per_m = GetParam().drift_rad_per_m;
  }
  void expect_right(const std::vector<std::string>& others) {
    for (const std::string& id : others) EXPECT_LT(drill_.error_m("alpha", id), 0.1) << id;
  }
  Drill drill_;
};

TEST_P(BentMapTest, StaysOutWithItsReasonAndJoinsOnceCorrected) {
  for (const double until_s : {20, 26, 28, 30, 34, 38, 42, 46, 50, 54, 58}) drill_.walk_to(until_s);
  EXPECT_THAT(drill_.fleet().group(), ElementsAre("alpha", "bravo", "charlie"));
  expect_right({"bravo", "charlie"});
  std::string reasons;
  for (const char* other : {"alpha", "bravo", "charlie"}) {
    const std::string reason = drill_.fleet().reason(other, "delta");
    EXPECT_FALSE(reason.empty()) << other;
    reasons += reason + "\n";
  }
  // Bent by so much, no place is left where much of the wall agrees and little contradicts.
  EXPECT_THAT(reasons,
              AnyOf(HasSubstr("contradict"), HasSubstr("of wall agree at the best place")));

  drill_.view("delta").drift_rad_per_m = 0.0;
  for (const double until_s : {60, 64, 68, 72}) drill_.walk_to(until_s);
  drill_.finish();
  EXPECT_THAT(drill_.fleet().group(), ElementsAre("alpha", "bravo", "charlie", "delta"));
  expect_right({"bravo", "charlie", "delta"});
  EXPECT_NE(drill_.fleet().common_hash({"alpha", "bravo", "charlie", "delta"}), "differ");
}

INSTANTIATE_TEST_SUITE_P(Offices, BentMapTest,
                         testing::Values(Bend{1, 0.008}, Bend{2, 0.006}, Bend{3, -0.008}),
                         [](const auto& bend) {
                           return "InBuilding" + std::to_string(bend.param.building);
                         });

}  // namespace
}  // namespace lifeline::test
