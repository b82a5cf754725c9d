#include "deploy/demo/summary.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace lifeline::demo {
namespace {

using nlohmann::json;
using testing::HasSubstr;
using testing::Not;

json report(const std::string& hash) {
  return {{"scans", 400},          {"scans_dropped", 2}, {"common_map_sha256", hash},
          {"fingerprint", "f00d"}, {"failures", 0},      {"slam_ms_median", 1.5},
          {"slam_ms_p99", 4.25},   {"bytes_sent", 98765}};
}

/// Two helmets in a world where bravo's map lies 5 m ahead of alpha's.
std::vector<HelmetOutcome> two_helmets(const std::string& hash_a, const std::string& hash_b) {
  return {{"alpha", report(hash_a), 0.03, Pose2{1.0, 1.0, 0.0}},
          {"bravo", report(hash_b), 0.04, Pose2{6.0, 1.0, 0.0}}};
}

json merge(bool accepted, double x_m) {
  return {{"a", "alpha"},          {"b", "bravo"},
          {"accepted", accepted},  {"T_a_b", {{"x_m", x_m}, {"y_m", 0.0}, {"yaw_rad", 0.0}}},
          {"s_overlapping", 0.25}, {"acceptance_index", 0.97},
          {"at_s", 21.5},          {"overlap_centre_b", {{"x_m", 2.0}, {"y_m", 3.0}}}};
}

json coordinator(const std::string& hash) {
  return {{"common_map_sha256", hash}, {"epoch", 2}, {"merges", json::array({merge(true, 5.06)})}};
}

TEST(Summary, has_the_fields_that_are_promised) {
  const json summary = make_summary(two_helmets("abc1", "abc1"), coordinator("abc1"), {}, 47.5);
  EXPECT_EQ(summary["shared"], true);
  EXPECT_EQ(summary["wall_s"], 47.5);
  EXPECT_EQ(summary["coordinator"], json({{"common_map_sha256", "abc1"}}));
  EXPECT_EQ(summary["helmets"][1], json({{"agent_id", "bravo"},
                                         {"scans", 400},
                                         {"scans_dropped", 2},
                                         {"common_map_sha256", "abc1"},
                                         {"fingerprint", "f00d"},
                                         {"trajectory_rmse_m", 0.04},
                                         {"slam_ms_median", 1.5},
                                         {"slam_ms_p99", 4.25},
                                         {"bytes_sent", 98765}}));
}

TEST(Summary, judges_a_merge_against_the_truth) {
  const json summary = make_summary(two_helmets("abc1", "abc1"), coordinator("abc1"), {}, 1.0);
  const json& judged = summary["merges"][0];
  EXPECT_EQ(judged["a"], "alpha");
  EXPECT_EQ(judged["accepted"], true);
  EXPECT_EQ(judged["s_overlapping"], 0.25);
  EXPECT_EQ(judged["acceptance_index"], 0.97);
  EXPECT_EQ(judged["at_s"], 21.5);
  EXPECT_NEAR(judged["error_m"].get<double>(), 0.06, 1e-9);
  EXPECT_NEAR(judged["error_at_origin_m"].get<double>(), 0.06, 1e-9);
  EXPECT_NEAR(judged["error_deg"].get<double>(), 0.0, 1e-9);
}

TEST(Summary, leaves_errors_open_where_the_truth_is_unknown) {
  auto helmets = two_helmets("abc1", "abc1");
  helmets[0].T_world_map.reset();
  helmets[0].rmse_m.reset();
  const json summary = make_summary(helmets, coordinator("abc1"), {}, 1.0);
  EXPECT_TRUE(summary["merges"][0]["error_m"].is_null());
  EXPECT_TRUE(summary["merges"][0]["error_deg"].is_null());
  EXPECT_TRUE(summary["helmets"][0]["trajectory_rmse_m"].is_null());
}

TEST(Summary, is_not_shared_when_one_hash_differs) {
  const auto shared = [](const char* a, const char* b, const char* c) {
    return make_summary(two_helmets(a, b), coordinator(c), {}, 1.0)["shared"];
  };
  EXPECT_EQ(shared("abc1", "abc1", "abc1"), true);
  EXPECT_EQ(shared("abc1", "abc2", "abc1"), false);
  EXPECT_EQ(shared("abc1", "abc1", "abc2"), false);
}

TEST(Summary, is_not_shared_when_nobody_has_a_common_map) {
  EXPECT_EQ(make_summary(two_helmets("0000", "0000"), coordinator("0000"), {}, 1.0)["shared"],
            false);
  EXPECT_EQ(make_summary(two_helmets("", ""), coordinator(""), {}, 1.0)["shared"], false);
}

TEST(Summary, bears_missing_and_odd_reports) {
  auto helmets = two_helmets("abc1", "abc1");
  helmets[1].report = json();
  EXPECT_EQ(make_summary(helmets, json(), {}, 1.0)["shared"], false);
  helmets[1].report = json::array({1, 2});
  const json odd{{"common_map_sha256", 7}, {"merges", json::array({json(3), json::object()})}};
  const json summary = make_summary(helmets, odd, {}, 1.0);
  EXPECT_EQ(summary["shared"], false);
  EXPECT_TRUE(summary["helmets"][1]["scans"].is_null());
  EXPECT_FALSE(is_one_map(summary));
  EXPECT_THAT(render_summary(summary), HasSubstr("bravo"));
}

TEST(IsOneMap, counts_accepted_merges_only) {
  json seen = coordinator("abc1");
  EXPECT_TRUE(is_one_map(make_summary(two_helmets("abc1", "abc1"), seen, {}, 1.0)));
  seen["merges"] = json::array({merge(false, 5.0)});
  EXPECT_FALSE(is_one_map(make_summary(two_helmets("abc1", "abc1"), seen, {}, 1.0)));
}

TEST(Judge, wants_one_map_that_all_hold) {
  json seen = coordinator("abc1");
  const auto verdict = [&](const char* hash_b, const char* outcome) {
    seen["outcome"] = outcome;
    return judge(make_summary(two_helmets("abc1", hash_b), seen, {}, 1.0), seen);
  };
  EXPECT_TRUE(verdict("abc1", "shared").good);
  EXPECT_FALSE(verdict("abc2", "shared").good);
  EXPECT_FALSE(verdict("abc1", "apart").good);
  EXPECT_THAT(verdict("abc1", "working").text, HasSubstr("in time"));
  seen["merges"] = json::array();
  EXPECT_THAT(verdict("abc1", "apart").text, HasSubstr("not all in one map"));
  EXPECT_FALSE(judge(make_summary(two_helmets("abc1", "abc1"), json(), {}, 1.0), json()).good);
}

TEST(Judge, a_helmet_alone_shares_nothing_and_has_not_failed) {
  auto helmets = two_helmets("", "");
  helmets.pop_back();
  json seen{{"common_map_sha256", ""}, {"merges", json::array()}, {"outcome", "apart"}};
  const json summary = make_summary(helmets, seen, {}, 1.0);
  EXPECT_EQ(summary["shared"], false);
  EXPECT_TRUE(judge(summary, seen).good);
  EXPECT_THAT(judge(summary, seen).text, HasSubstr("alpha was alone"));
  seen["outcome"] = "working";  // the coordinator never got all of it
  EXPECT_FALSE(judge(summary, seen).good);
}

TEST(RenderSummary, shows_helmets_hashes_and_errors) {
  const std::string table =
      render_summary(make_summary(two_helmets("abc1", "abc1"), coordinator("abc1"), {}, 1.0));
  EXPECT_THAT(table, HasSubstr("alpha"));
  EXPECT_THAT(table, HasSubstr("abc1"));
  EXPECT_THAT(table, HasSubstr("alpha - bravo"));
  EXPECT_THAT(table, HasSubstr("0.060"));
  EXPECT_THAT(table, Not(HasSubstr("none")));
}

TEST(RenderSummary, has_one_line_for_a_pair_with_its_largest_error) {
  json seen = coordinator("abc1");
  seen["merges"] = json::array({merge(true, 5.25), merge(true, 5.02)});
  const std::string table =
      render_summary(make_summary(two_helmets("abc1", "abc1"), seen, {}, 1.0));
  EXPECT_EQ(table.find("alpha - bravo"), table.rfind("alpha - bravo"));
  EXPECT_THAT(table, HasSubstr("0.020"));
  EXPECT_THAT(table, HasSubstr("0.250"));
}

/// A victim as a report lists it.
json find(const std::string& frame, double x_m, double y_m) {
  return {{"kind", "victim"},
          {"frame", frame},
          {"x_m", x_m},
          {"y_m", y_m},
          {"confidence", 0.9},
          {"first_seen", {{"by", "bravo"}, {"at_s", 12.5}}},
          {"seen_by", {"alpha", "bravo"}}};
}

TEST(Summary, judges_the_list_of_finds_against_the_truth) {
  json seen = coordinator("abc1");
  seen["common_frame_of"] = "bravo";  // whose map lies at (6, 1)
  seen["detections"] = json::array({find("common", 1.0, 2.0), find("alpha/1", 1.0, 2.0)});
  const json summary =
      make_summary(two_helmets("abc1", "abc1"), seen,
                   {{"victim", 7.3, 3.4}, {"uwb_tag", 7.0, 3.0}, {"victim", 9.0, 9.0}}, 1.0);
  ASSERT_EQ(summary["detections"].size(), 2U);
  EXPECT_NEAR(summary["detections"][0]["error_m"].get<double>(), 0.5, 1e-9);
  EXPECT_TRUE(summary["detections"][1]["error_m"].is_null());  // its frame is not the common one
  const std::string table = render_summary(summary);
  EXPECT_THAT(table, HasSubstr("first by"));
  EXPECT_THAT(table, HasSubstr("alpha, bravo"));
}

TEST(Summary, says_whether_all_machines_list_the_same_finds) {
  auto helmets = two_helmets("abc1", "abc1");
  json seen = coordinator("abc1");
  EXPECT_EQ(make_summary(helmets, seen, {}, 1.0)["detections_agree"], false);  // nobody has a list
  const json list = json::array({find("common", 1.0, 2.0)});
  seen["detections"] = list;
  for (auto& helmet : helmets) helmet.report["detections"] = list;
  EXPECT_EQ(make_summary(helmets, seen, {}, 1.0)["detections_agree"], true);
  helmets[1].report["detections"] = json::array();
  EXPECT_EQ(make_summary(helmets, seen, {}, 1.0)["detections_agree"], false);
}

TEST(Summary, takes_lists_of_finds_that_are_none) {
  json seen = coordinator("abc1");
  seen["common_frame_of"] = 7;
  seen["detections"] = json::array({json::object(), json::object({{"frame", "common"}}), 7});
  const json summary = make_summary(two_helmets("abc1", "abc1"), seen, {{"victim", 0.0, 0.0}}, 1.0);
  EXPECT_EQ(summary["detections"].size(), 2U);
  EXPECT_THAT(render_summary(summary), HasSubstr("alpha"));
}

}  // namespace
}  // namespace lifeline::demo
