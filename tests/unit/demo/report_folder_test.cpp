#include "deploy/demo/report_folder.hpp"

#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include "deploy/demo/programs.hpp"

namespace lifeline::demo {
namespace {

using std::filesystem::exists;
using std::filesystem::path;
using testing::ElementsAre;
using testing::HasSubstr;

class ReportFolder : public testing::Test {
 protected:
  ReportFolder() : folder_(testing::TempDir() + "report_folder_" + std::to_string(getpid())) {
    std::filesystem::create_directories(folder_);
  }
  ~ReportFolder() override { std::filesystem::remove_all(folder_); }

  void write(const path& file, const std::string& text) {
    std::filesystem::create_directories((folder_ / file).parent_path());
    std::ofstream(folder_ / file) << text;
  }

  path folder_;
};

TEST_F(ReportFolder, is_made_with_all_folders_above_it) {
  ASSERT_TRUE(prepare_report_folder(folder_ / "a/b"));
  EXPECT_TRUE(std::filesystem::is_directory(folder_ / "a/b"));
  EXPECT_TRUE(std::filesystem::is_empty(folder_ / "a/b"));
}

TEST_F(ReportFolder, loses_what_an_earlier_demo_left_and_nothing_else) {
  for (const char* file : {"summary.json", "papa.lifemap", "common_map.png", "notes.txt"}) {
    write(file, "old");
  }
  ASSERT_TRUE(prepare_report_folder(folder_));
  EXPECT_FALSE(exists(folder_ / "summary.json"));
  EXPECT_FALSE(exists(folder_ / "papa.lifemap"));
  EXPECT_FALSE(exists(folder_ / "common_map.png"));
  EXPECT_TRUE(exists(folder_ / "notes.txt"));
}

TEST_F(ReportFolder, that_cannot_be_written_to_is_named_with_the_way_out) {
  write("file", "");
  for (const path& bad : {folder_ / "file/report", path("/proc/report")}) {
    const auto made = prepare_report_folder(bad);
    ASSERT_FALSE(made);
    EXPECT_THAT(made.error().text, HasSubstr(bad.string()));
    EXPECT_THAT(made.error().text, HasSubstr("--report"));
  }
}

TEST_F(ReportFolder, gives_reports_that_are_objects_only) {
  write("good.json", R"({"scans": 3})");
  write("list.json", "[1, 2]");
  write("torn.json", R"({"scans": )");
  EXPECT_EQ(read_report(folder_ / "good.json")["scans"], 3);
  EXPECT_TRUE(read_report(folder_ / "list.json").is_null());
  EXPECT_TRUE(read_report(folder_ / "torn.json").is_null());
  EXPECT_TRUE(read_report(folder_ / "missing.json").is_null());
}

TEST_F(ReportFolder, gives_back_the_summary_it_was_given) {
  ASSERT_TRUE(write_summary(folder_, {{"shared", true}}));
  EXPECT_EQ(read_report(folder_ / "summary.json"), nlohmann::json({{"shared", true}}));
}

TEST_F(ReportFolder, lists_the_common_map_before_the_helmets_pictures) {
  for (const char* file : {"bravo.png", "alpha.png", "common_map.png", "alpha.json"}) {
    write(file, "");
  }
  EXPECT_THAT(pictures(folder_), ElementsAre(folder_ / "common_map.png", folder_ / "alpha.png",
                                             folder_ / "bravo.png"));
}

TEST_F(ReportFolder, knows_each_helmet_s_outcome_even_when_it_left_nothing) {
  write("alpha.json", R"({"scans": 3})");
  const auto outcomes =
      read_outcomes(folder_, {.helmets = {{"alpha", ""}, {"bravo", ""}}, .finds = {}});
  ASSERT_EQ(outcomes.size(), 2U);
  EXPECT_EQ(outcomes[0].report["scans"], 3);
  EXPECT_FALSE(outcomes[0].rmse_m);
  EXPECT_EQ(outcomes[1].agent_id, "bravo");
  EXPECT_TRUE(outcomes[1].report.is_null());
}

TEST_F(ReportFolder, gives_the_last_line_that_says_something) {
  write("a.log", "first\nlast words\n\n");
  EXPECT_EQ(last_line(folder_ / "a.log"), "last words");
  EXPECT_EQ(last_line(folder_ / "missing.log"), "");
}

class FindPrograms : public ReportFolder {
 protected:
  void write_programs() {
    write("build/release/bin/lifeline-agent", "");
    write("build/release/bin/lifeline-coordinator", "");
  }
  const path self_ = folder_ / "build/release/bin/lifeline-demo";
};

TEST_F(FindPrograms, stand_beside_us_and_their_profiles_with_the_configuration) {
  write_programs();
  write("config/qos/loopback.xml", "");
  const auto programs = find_programs(self_, folder_ / "config");
  ASSERT_TRUE(programs) << programs.error().text;
  EXPECT_EQ(programs->agent, folder_ / "build/release/bin/lifeline-agent");
  EXPECT_EQ(programs->coordinator, folder_ / "build/release/bin/lifeline-coordinator");
  EXPECT_EQ(programs->qos, folder_ / "config/qos/loopback.xml");
}

TEST_F(FindPrograms, that_are_missing_are_named) {
  write("build/release/bin/lifeline-agent", "");
  const auto programs = find_programs(self_, folder_ / "config");
  ASSERT_FALSE(programs);
  EXPECT_THAT(programs.error().text, HasSubstr("lifeline-coordinator"));
}

TEST_F(FindPrograms, need_their_profiles) {
  write_programs();
  const auto programs = find_programs(self_, folder_ / "config");
  ASSERT_FALSE(programs);
  EXPECT_THAT(programs.error().text, HasSubstr("config/qos/loopback.xml"));
}

}  // namespace
}  // namespace lifeline::demo
