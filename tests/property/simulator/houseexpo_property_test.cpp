#include <string>

#include <gtest/gtest.h>

#include "agents/sources/simulator/draw.hpp"
#include "agents/sources/simulator/free_space.hpp"
#include "agents/sources/simulator/houseexpo.hpp"

namespace lifeline::sources {
namespace {

constexpr const char* kPlan =
    R"({"id":"a1","room_num":2,"bbox":{"min":[0,0],"max":[9.5,4]},)"
    R"("room_category":{"Kitchen":{"bounds":[[0,0,4,4]],"n":null,"t":true}},)"
    R"("verts":[[0,0],[4.5,0],[4.5,1.5],[4.6,1.5],[4.6,0],[9.5,0],[9.5,4],[4.6,4],)"
    R"([4.6,2.5],[4.5,2.5],[4.5,4],[0,4]]})";

std::string damaged(Draw& draw) {
  constexpr const char* kPieces[] = {"[",   "]",       "{",    "}",          ",",    "\"",
                                     ":",   "-",       "e9",   "\"verts\":", "null", "1e308",
                                     "NaN", "\\u0000", "[[[[", "\xff",       "0.0",  " "};
  std::string text = kPlan;
  for (int i = draw.below(4); i >= 0; --i) {
    const auto at = static_cast<std::size_t>(draw.below(static_cast<int>(text.size())));
    switch (draw.below(4)) {
      case 0:
        text[at] = static_cast<char>(draw.below(256));
        break;
      case 1:
        text.erase(at, static_cast<std::size_t>(draw.below(12)));
        break;
      case 2:
        text.insert(at, kPieces[draw.below(18)]);
        break;
      default:
        text.resize(at + 1);
        break;
    }
  }
  return text;
}

TEST(HouseExpoPropertyTest, ADamagedPlanIsRefusedInOneLineOrIsAPlan) {
  ASSERT_TRUE(parse_houseexpo(kPlan, "plan").has_value());
  Draw draw(1);
  int refused = 0;
  for (int i = 0; i < 20'000; ++i) {
    const auto plan = parse_houseexpo(damaged(draw), "plan");
    if (!plan) {
      ++refused;
      EXPECT_EQ(plan.error().code, ErrorCode::bad_data);
      EXPECT_EQ(plan.error().text.find('\n'), std::string::npos);
      continue;
    }
    EXPECT_TRUE(plan->bounds().min().allFinite() && plan->bounds().max().allFinite());
    EXPECT_LE(plan->bounds().sizes().maxCoeff(), kMaxPlanSideM);
    EXPECT_GE(plan->walls.size(), 3U);
    if (i % 50 == 0) (void)FreeSpace::make(*plan);
  }
  EXPECT_GT(refused, 5000);
}

}  // namespace
}  // namespace lifeline::sources
