#include "agents/sources/simulator/houseexpo.hpp"

#include <string>
#include <utility>
#include <vector>

#include <gmock/gmock.h>

#include "tests/support/temporary_folder.hpp"
#include "tests/unit/simulator/simulated_plans.hpp"

namespace lifeline::sources {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

constexpr const char* kSquare = "[[0,0],[4.5,0],[4.5,3],[0,3]]";

std::string with_verts(const std::string& verts) {
  return R"({"id":"x","bbox":{"max":[5,3],"min":[0,0]},"verts":)" + verts + R"(,"room_num":1})";
}

void expect_refused(const std::string& json, const std::string& reason) {
  const auto plan = parse_houseexpo(json, "plan.json");
  ASSERT_FALSE(plan.has_value()) << json.substr(0, 80);
  EXPECT_EQ(plan.error().code, ErrorCode::bad_data);
  EXPECT_THAT(plan.error().text, HasSubstr("plan.json: "));
  EXPECT_THAT(plan.error().text, HasSubstr(reason));
  EXPECT_THAT(plan.error().text, Not(HasSubstr("\n")));
  EXPECT_LT(plan.error().text.size(), 200U);
}

TEST(HouseExpo, ThePolygonsEdgesAreTheWalls) {
  const auto plan = parse_houseexpo(with_verts(kSquare), "square").value();

  ASSERT_EQ(plan.walls.size(), 4U);
  EXPECT_EQ(plan.walls[0].b, Eigen::Vector2d(4.5, 0.0));
  EXPECT_EQ(plan.walls[3].a, Eigen::Vector2d(0.0, 3.0));
  EXPECT_EQ(plan.walls[3].b, Eigen::Vector2d(0.0, 0.0));
  EXPECT_DOUBLE_EQ(plan.floor_area_m2(), 13.5);
  EXPECT_EQ(plan.name, "square");
}

TEST(HouseExpo, APolygonThatRepeatsItsFirstCornerIsTheSame) {
  const auto plan = parse_houseexpo(with_verts("[[0,0],[4.5,0],[4.5,3],[4.5,3],[0,3],[0,0]]"), "p");
  EXPECT_EQ(plan.value().walls.size(), 4U);
}

TEST(HouseExpo, APolygonMayTouchItself) {
  // The wall between two rooms as a slit of no thickness: there and back along x = 2.
  const auto plan =
      parse_houseexpo(with_verts("[[0,0],[2,0],[2,2],[2,0],[4,0],[4,3],[0,3]]"), "slit");
  ASSERT_TRUE(plan.has_value());
  EXPECT_TRUE(plan->is_floor({1.0, 1.0}));
  EXPECT_TRUE(plan->is_floor({3.0, 1.0}));
  EXPECT_DOUBLE_EQ(plan->floor_area_m2(), 12.0);
}

TEST(HouseExpo, PassesOverEverythingElse) {
  const std::string json = R"({"rooms":[{"verts":[[1,[2]],"x"],"n":null}],"b":true,"s":"verts",)"
                           R"("verts":[[0,0],[4,0],[4,3]],"verts2":7})";
  EXPECT_EQ(parse_houseexpo(json, "p").value().walls.size(), 3U);
}

TEST(HouseExpo, RefusesWhatIsNoJson) {
  for (const char* json : {"", " ", "{", "verts", R"({"verts":[[0,0],)", R"({"verts":[[0,0]]}x)",
                           "\x89PNG\r\n\x1a\n", R"({"a":"\ud800"})"}) {
    expect_refused(json, "not JSON at byte");
  }
}

TEST(HouseExpo, RefusesNumbersThatAreNone) {
  for (const char* number : {"NaN", "nan", "Infinity", "-Infinity", "1e999", "0x10", "1.", "--1"}) {
    expect_refused(with_verts(std::string("[[0,0],[4,") + number + "],[4,3]]"), "not JSON at byte");
  }
}

TEST(HouseExpo, RefusesATextWithoutVerts) {
  expect_refused("{}", "has no 'verts'");
  expect_refused(R"({"rooms":{"verts":[[0,0],[1,0],[1,1]]}})", "has no 'verts'");
  for (const char* json : {"[]", "[[0,0],[4,0],[4,3]]", "7", "\"verts\"", "null", "true"}) {
    expect_refused(json, "there is no object at the top");
  }
}

TEST(HouseExpo, RefusesVertsOfAnotherShape) {
  for (const char* verts : {"7", "null", "true", "\"text\"", "{}", "[1,2]", "[[0,0],null]",
                            "[[0,0],\"a\"]", "[[0,0],[1,\"2\"]]", "[[0,0],[1,[2]]]",
                            "[[0,0],{\"x\":1}]", "[[0,0],[1,2,3]]", "[[[0,0]]]", "[[0,true]]"}) {
    expect_refused(with_verts(verts), "'verts' is not a list of [x, y]");
  }
  expect_refused(with_verts("[[0,0],[1]]"), "does not have two coordinates");
  expect_refused(with_verts("[[0,0],[]]"), "does not have two coordinates");
  expect_refused(R"({"verts":[[0,0],[4,0],[4,3]],"verts":[]})", "stands there twice");
}

TEST(HouseExpo, RefusesTooFewCorners) {
  expect_refused(with_verts("[]"), "only 0 corners");
  expect_refused(with_verts("[[1,1]]"), "only 0 corners");
  expect_refused(with_verts("[[0,0],[4,0]]"), "only 2 corners");
  expect_refused(with_verts("[[0,0],[0,0],[0,0],[0,0]]"), "only 0 corners");
}

TEST(HouseExpo, RefusesSizesThatMakeNoSense) {
  expect_refused(with_verts("[[0,0],[0.1,0],[0.1,0.1]]"), "the plan is 0.10 x 0.10 m");
  expect_refused(with_verts("[[0,0],[300,0],[300,30]]"), "the plan is 300.00 x 30.00 m");
  expect_refused(with_verts("[[0,0],[4,0],[8,0]]"), "the plan is 8.00 x 0.00 m");
  expect_refused(with_verts("[[0,0],[1e300,0],[4,3]]"), "a coordinate of 'verts' is 1e+300 m");
  expect_refused(with_verts("[[0,0],[4,-9999],[4,3]]"), "a coordinate of 'verts' is -9999 m");
  expect_refused(with_verts("[[0,0],[18446744073709551615,0],[4,3]]"), "a coordinate of 'verts'");
}

TEST(HouseExpo, RefusesMoreVerticesOrWallsThanAnyPlanHas) {
  std::string many = "[[0,0]";
  for (std::size_t i = 0; i <= kMaxHouseExpoVertices; ++i) many += ",[1,1]";
  expect_refused(with_verts(many + "]"), "more than 100000 vertices");

  std::string zigzag = "[[0,0]";
  for (int i = 0; i < 1000; ++i) zigzag += i % 2 == 0 ? ",[150,1]" : ",[0,2]";
  expect_refused(with_verts(zigzag + "]"), "m of walls");
}

TEST(HouseExpo, DeepNestingTakesNoMemory) {
  expect_refused(std::string(1'000'000, '['), "there is no object at the top");
  expect_refused(R"({"a":)" + std::string(1'000'000, '['), "not JSON at byte");
}

TEST(HouseExpo, RefusesMoreBytesThanAnyPlanHas) {
  expect_refused(with_verts(kSquare) + std::string(kMaxHouseExpoBytes, ' '), "larger than 16 MiB");
}

TEST(HouseExpoFile, IsReadLikeItsText) {
  const support::TemporaryFolder folder;
  const auto file = folder.write("plan.json", with_verts(kSquare));

  const auto plan = read_houseexpo(file);

  ASSERT_TRUE(plan.has_value());
  EXPECT_EQ(plan->walls.size(), 4U);
  EXPECT_EQ(plan->name, file.string());
}

TEST(HouseExpoFile, OneThatIsNotThereIsNamed) {
  const support::TemporaryFolder folder;
  for (const auto& path : {folder.path() / "none.json", folder.path()}) {
    const auto plan = read_houseexpo(path);
    ASSERT_FALSE(plan.has_value());
    EXPECT_EQ(plan.error().code, ErrorCode::not_found);
    EXPECT_EQ(plan.error().text, path.string() + ": there is no such plan file");
  }
}

TEST(HouseExpoFile, EveryPlanOfTheDataSetIsRead) {
  const auto files = support::houseexpo_files();
  if (files.empty()) GTEST_SKIP() << "the HouseExpo plans are not here";
  for (const auto& file : files) {
    const auto plan = read_houseexpo(file);
    ASSERT_TRUE(plan.has_value()) << plan.error().text;
    EXPECT_GT(plan->floor_area_m2(), 40.0) << file;
    EXPECT_LT(plan->floor_area_m2(), 1000.0) << file;
  }
}

}  // namespace
}  // namespace lifeline::sources
