#include "common/files/load_config.hpp"

#include <sstream>
#include <string>
#include <vector>

#include <gmock/gmock.h>

#include "idl/config.pb.h"
#include "tests/support/temporary_folder.hpp"

namespace lifeline::files {
namespace {

using ::testing::ElementsAre;
using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

class LoadConfig : public ::testing::Test {
 protected:
  /// The faults found in a file of this content, without the folder's name.
  std::vector<std::string> faults_in(const std::string& content) {
    const auto loaded = load_config(folder_.write("a.yaml", content), config_);
    std::vector<std::string> faults;
    if (loaded) return faults;
    code_ = loaded.error().code;
    std::istringstream lines(loaded.error().text);
    for (std::string line; std::getline(lines, line);) {
      const auto prefix = folder_.path().string() + "/";
      EXPECT_TRUE(line.starts_with(prefix)) << line;
      faults.push_back(line.substr(prefix.size()));
    }
    return faults;
  }

  support::TemporaryFolder folder_;
  proto::AgentConfig config_;
  ErrorCode code_ = ErrorCode::unavailable;
};

TEST_F(LoadConfig, ACeilingBelowTheLidarIsRefused) {
  const auto file =
      folder_.write("a.yaml", "sensing: {lidar_height_m: 2.5, ceiling_height_m: 2.4}");
  const auto loaded = load_agent_config(file);
  ASSERT_FALSE(loaded);
  EXPECT_EQ(loaded.error().code, ErrorCode::wrong_use);
  EXPECT_THAT(loaded.error().text,
              HasSubstr("sensing.ceiling_height_m is 2.4 and sensing.lidar_height_m is 2.5"));
}

TEST_F(LoadConfig, DefaultsNeedNoFile) {
  fill_defaults(config_);
  EXPECT_EQ(config_.mission().mission_id(), "mission");
  EXPECT_EQ(config_.mission().domain_id(), 42U);
  EXPECT_DOUBLE_EQ(config_.grid().cell_size_m(), 0.05);
  EXPECT_EQ(config_.slam().min_model_points(), 20U);
  EXPECT_TRUE(config_.sharing().match_working_map());
  EXPECT_EQ(config_.floor(), 0);
}

TEST_F(LoadConfig, WhatTheFileLeavesOutHasItsDefault) {
  EXPECT_THAT(faults_in("grid:\n  cell_size_m: 0.025\nslam:\nfloor: -2\n"), IsEmpty());
  EXPECT_DOUBLE_EQ(config_.grid().cell_size_m(), 0.025);
  EXPECT_DOUBLE_EQ(config_.grid().truncation_m(), 0.15);
  EXPECT_EQ(config_.floor(), -2);
  EXPECT_EQ(config_.slam().matcher(), "direct");
}

TEST_F(LoadConfig, AnEmptyFileIsAllDefaults) {
  EXPECT_THAT(faults_in(""), IsEmpty());
  EXPECT_THAT(faults_in("# nothing\n"), IsEmpty());
  EXPECT_EQ(config_.mission().domain_id(), 42U);
}

TEST_F(LoadConfig, ReportsEveryFaultAtOnceWithItsPlace) {
  EXPECT_THAT(
      faults_in("mission:\n"
                "  domain: 7\n"
                "  log_level: loud\n"
                "grid:\n"
                "  cell_size_m: five\n"
                "  truncation_m: 20\n"
                "slam: fast\n"
                "colour: red\n"
                "floor: 1\n"
                "floor: 2\n"),
      ElementsAre(
          "a.yaml:2:3: unknown key mission.domain; did you mean domain_id?",
          "a.yaml:3:14: mission.log_level is \"loud\"; give one of: trace debug info warn error",
          "a.yaml:5:16: grid.cell_size_m is five; give a number from 0.01 to 0.1",
          "a.yaml:6:17: grid.truncation_m is 20; give a number from 0.02 to 2",
          "a.yaml:7:7: slam must hold keys with values; give: matcher, max_range_m, "
          "min_model_points, max_mean_error_m, gicp_max_iterations",
          "a.yaml:8:1: unknown key colour; known here: mission, grid, slam, sharing, floor, "
          "sensing, storage, recording",
          "a.yaml:10:1: floor stands here again, first on line 9; keep one"));
  EXPECT_EQ(code_, ErrorCode::wrong_use);
}

TEST_F(LoadConfig, RefusesWrongTypes) {
  EXPECT_THAT(faults_in("floor: 1.5"), ElementsAre(HasSubstr("floor is 1.5; give a whole number")));
  EXPECT_THAT(faults_in("floor: '1'"), ElementsAre(HasSubstr("floor is \"1\"; give a whole")));
  EXPECT_THAT(faults_in("floor: 99999999999"), ElementsAre(HasSubstr("give a whole number")));
  EXPECT_THAT(faults_in("floor: [1, 2]"), ElementsAre(HasSubstr("holds several values")));
  EXPECT_THAT(faults_in("floor: ~"), ElementsAre(HasSubstr("floor has no value")));
  EXPECT_THAT(faults_in("floor:"), ElementsAre(HasSubstr("floor has no value")));
  EXPECT_THAT(faults_in("grid: {cell_size_m: .nan}"), ElementsAre(HasSubstr("give a number")));
  EXPECT_THAT(faults_in("grid: {cell_size_m: nan}"), ElementsAre(HasSubstr("give a number")));
  EXPECT_THAT(faults_in("grid: {cell_size_m: 0x1}"), ElementsAre(HasSubstr("give a number")));
  EXPECT_THAT(faults_in("sharing: {budget_bit_s: -1}"), ElementsAre(HasSubstr("8000")));
  EXPECT_THAT(faults_in("sharing: {match_working_map: yes}"),
              ElementsAre(HasSubstr("match_working_map is yes; give true or false")));
  EXPECT_THAT(faults_in("- floor"), ElementsAre(HasSubstr("the file must hold keys")));
  EXPECT_THAT(faults_in("[floor]: 1"), ElementsAre(HasSubstr("unknown key")));
}

TEST_F(LoadConfig, RefusesTextsThatAreEmptyOrTooLong) {
  EXPECT_THAT(faults_in("mission: {mission_id: \"\"}"),
              ElementsAre(EndsWith("is \"\"; give a text of 1 to 32 characters")));
  EXPECT_THAT(faults_in("mission: {mission_id: " + std::string(33, 'x') + "}"),
              ElementsAre(EndsWith("give a text of 1 to 32 characters")));
  EXPECT_THAT(faults_in("mission: {mission_id: 112}"), IsEmpty());
  EXPECT_EQ(config_.mission().mission_id(), "112");
}

TEST_F(LoadConfig, NamesThePlaceOfMalformedYaml) {
  EXPECT_THAT(faults_in("grid:\n  cell_size_m: [0.05\n"),
              ElementsAre(HasSubstr(": not valid YAML (")));
  EXPECT_THAT(faults_in("grid:\n\tcell_size_m: 0.05\n"),
              ElementsAre(::testing::StartsWith("a.yaml:2:")));
  EXPECT_THAT(faults_in("floor: *nowhere\n"), ElementsAre(HasSubstr("not valid YAML")));
  EXPECT_THAT(faults_in("floor: 1\n---\nfloor: 2\n"), ElementsAre(HasSubstr("second YAML")));
  EXPECT_THAT(faults_in(std::string(100'000, '[')), ElementsAre(HasSubstr("not valid YAML")));
  EXPECT_THAT(faults_in(std::string("\xff\xfe\x00\x01", 4)), ::testing::SizeIs(1));
}

TEST_F(LoadConfig, NamesAFileThatIsMissingAFolderOrTooLarge) {
  const auto missing = load_config(folder_.path() / "none.yaml", config_);
  ASSERT_FALSE(missing);
  EXPECT_EQ(missing.error().code, ErrorCode::not_found);
  EXPECT_THAT(missing.error().text, HasSubstr("none.yaml: no such file"));
  const auto folder = load_config(folder_.path(), config_);
  ASSERT_FALSE(folder);
  EXPECT_THAT(folder.error().text, HasSubstr("not a file"));
  EXPECT_THAT(
      load_config(folder_.write("big.yaml", std::string(2'000'000, '#')), config_).error().text,
      HasSubstr("more than"));
}

TEST_F(LoadConfig, AWholeConfigurationNeedsATruncationOfTwoCells) {
  const auto file = folder_.write("a.yaml", "grid: {cell_size_m: 0.1, truncation_m: 0.15}");
  for (const auto& error :
       {load_agent_config(file).error(), load_coordinator_config(file).error()}) {
    EXPECT_THAT(error.text, HasSubstr("grid.truncation_m is 0.15 and grid.cell_size_m is 0.1; give "
                                      "a truncation of at least two cells, 0.2"));
  }
}

struct Experiment {
  int number;
  double explored_percent, acceptance_index, s_overlapping;
};

class PaperExperiments : public ::testing::TestWithParam<Experiment> {};

TEST_P(PaperExperiments, AreThoseOfTable1) {
  const auto [number, explored, index, overlapping] = GetParam();
  const auto config =
      load_coordinator_config(std::string(LIFELINE_SOURCE_DIR "/config/experiments/experiment") +
                              std::to_string(number) + ".yaml");
  ASSERT_TRUE(config) << config.error().text;
  EXPECT_EQ(config->merging().matching(), "spectra");
  EXPECT_DOUBLE_EQ(config->merging().min_explored_percent(), explored);
  EXPECT_DOUBLE_EQ(config->merging().min_acceptance_index(), index);
  EXPECT_DOUBLE_EQ(config->merging().min_s_overlapping(), overlapping);
  EXPECT_DOUBLE_EQ(config->merging().area_x_m() / config->grid().cell_size_m(), 600.0);
}

INSTANTIATE_TEST_SUITE_P(Table1, PaperExperiments,
                         ::testing::Values(Experiment{1, 5, 0.95, 0.03},
                                           Experiment{2, 5, 0.95, 0.03},
                                           Experiment{3, 4, 0.85, 0.02},
                                           Experiment{4, 2.5, 0.85, 0.02}));

TEST(ShippedConfiguration, HoldsTheDefaults) {
  proto::AgentConfig agent;
  fill_defaults(agent);
  const auto shipped_agent = load_agent_config(LIFELINE_SOURCE_DIR "/config/agent.yaml");
  ASSERT_TRUE(shipped_agent) << shipped_agent.error().text;
  EXPECT_EQ(shipped_agent->SerializeAsString(), agent.SerializeAsString());

  proto::CoordinatorConfig coordinator;
  fill_defaults(coordinator);
  const auto shipped = load_coordinator_config(LIFELINE_SOURCE_DIR "/config/coordinator.yaml");
  ASSERT_TRUE(shipped) << shipped.error().text;
  EXPECT_EQ(shipped->SerializeAsString(), coordinator.SerializeAsString());
}

}  // namespace
}  // namespace lifeline::files
