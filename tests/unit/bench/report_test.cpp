#include "tests/bench/report.hpp"

#include <fstream>
#include <limits>

#include <gmock/gmock.h>

#include "tests/support/temporary_folder.hpp"

namespace lifeline::bench {
namespace {

using ::testing::HasSubstr;

constexpr double kNothing = std::numeric_limits<double>::quiet_NaN();
constexpr Bar kAtMostOne{Bar::Side::at_most, 1.0};

TEST(Bar, HoldsUpToAndIncludingItsLimit) {
  EXPECT_TRUE(kAtMostOne.holds(1.0));
  EXPECT_FALSE(kAtMostOne.holds(1.001));
  const Bar at_least{Bar::Side::at_least, 100.0};
  EXPECT_TRUE(at_least.holds(100.0));
  EXPECT_FALSE(at_least.holds(99.0));
  EXPECT_EQ(at_least.text(), ">= 100");
}

TEST(Bar, NeverHoldsForWhatCouldNotBeMeasured) {
  EXPECT_FALSE(kAtMostOne.holds(kNothing));
  EXPECT_FALSE((Bar{Bar::Side::at_least, 0.0}).holds(kNothing));
}

TEST(Report, IsNotOkAsSoonAsOneRowIsNot) {
  Report report{.bench = "b", .machine = "m", .rows = {{"a", 0.5, "m", kAtMostOne}}};
  EXPECT_TRUE(report.ok());
  report.rows.push_back({"without a bar", 7.0, ""});
  EXPECT_TRUE(report.ok());
  report.rows.push_back({"c", 2.0, "m", kAtMostOne});
  EXPECT_FALSE(report.ok());
}

TEST(Report, ARowThatCouldNotBeMeasuredIsNotOkEvenWithoutABar) {
  EXPECT_FALSE((ReportRow{"a", kNothing, "m"}).ok());
}

TEST(Report, JsonHoldsEveryRowWithItsVerdict) {
  const Report report{.bench = "b",
                      .machine = "m",
                      .rows = {{"a", 0.5, "m", kAtMostOne, "others 0.7"}, {"lost", kNothing, ""}}};
  EXPECT_EQ(
      to_json(report).dump(),
      R"({"bench":"b","machine":"m","rows":[)"
      R"({"name":"a","value":0.5,"unit":"m","bar":"<= 1","reference":"others 0.7","ok":true},)"
      R"({"name":"lost","value":null,"unit":"","bar":null,"reference":"","ok":false}]})");
}

TEST(Report, TableShowsValueBarVerdictAndOthers) {
  const Report report{
      .bench = "b", .machine = "m", .rows = {{"error", 2.5, "m", kAtMostOne, "Hector 0.7"}}};
  const std::string table = render(report);
  EXPECT_THAT(table, HasSubstr("error"));
  EXPECT_THAT(table, HasSubstr("2.5 m  <= 1  MISS  Hector 0.7"));
  EXPECT_THAT(table, HasSubstr("1 rows, 1 missed"));
}

TEST(Report, FinishWritesTheFileAndAnswersWithTheExitStatus) {
  const support::TemporaryFolder folder;
  const auto file = folder.path() / "report.json";
  const Report good{.bench = "b", .machine = "m", .rows = {{"a", 0.5, "m", kAtMostOne}}};
  EXPECT_EQ(finish(good, file), 0);
  std::ifstream stream(file);
  EXPECT_EQ(nlohmann::ordered_json::parse(stream), to_json(good));

  const Report bad{.bench = "b", .machine = "m", .rows = {{"a", 1.5, "m", kAtMostOne}}};
  EXPECT_EQ(finish(bad, {}), 1);
  EXPECT_EQ(finish(good, folder.path() / "none" / "report.json"), 1);
}

}  // namespace
}  // namespace lifeline::bench
