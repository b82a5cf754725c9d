#include "common/files/finds_json.hpp"

#include <gtest/gtest.h>

namespace lifeline::files {
namespace {

sharing::FleetDetection find() {
  return {.group = std::uint16_t{0},
          .layer = {AgentId::parse("alpha").value(), MapId{2}, Floor{-1}},
          .kind = wire::DetectionKind::victim,
          .state = wire::DetectionState::confirmed,
          .x_m = 1.5,
          .y_m = -2.0,
          .confidence = 0.75,
          .first = {12'500'000'000, "bravo"},
          .last = {20'000'000'000, "alpha"},
          .seen_by = {"alpha", "bravo"}};
}

TEST(FindsJson, HoldsEveryField) {
  const nlohmann::ordered_json expected = {{"kind", "victim"},
                                           {"state", "confirmed"},
                                           {"frame", "common"},
                                           {"floor", -1},
                                           {"x_m", 1.5},
                                           {"y_m", -2.0},
                                           {"confidence", 0.75},
                                           {"first_seen", {{"by", "bravo"}, {"at_s", 12.5}}},
                                           {"last_seen", {{"by", "alpha"}, {"at_s", 20.0}}},
                                           {"seen_by", {"alpha", "bravo"}}};
  EXPECT_EQ(to_json({find()}), nlohmann::ordered_json::array({expected}));
  EXPECT_EQ(to_json(std::vector<sharing::FleetDetection>{}).dump(), "[]");
}

TEST(FindsJson, NamesTheFrame) {
  auto other = find();
  other.group = 3;
  EXPECT_EQ(to_json({other})[0]["frame"], "common-3");
  other.group.reset();
  EXPECT_EQ(to_json({other})[0]["frame"], "alpha/2@-1");
}

}  // namespace
}  // namespace lifeline::files
