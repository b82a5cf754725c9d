// What operators ask of the real programs: doctor, and results as JSON.

#include <filesystem>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/support/run_program.hpp"
#include "tests/support/temporary_folder.hpp"

namespace lifeline::test {
namespace {

using testing::HasSubstr;
using testing::Not;
const std::string kQos = LIFELINE_SOURCE_DIR "/config/qos/loopback.xml";

class OperatorsTest : public testing::Test {
 protected:
  Ended run(const std::vector<std::string>& arguments) {
    return run_program(arguments, folder_.path() / "log");
  }
  nlohmann::json json_of(const Ended& ended) {
    auto json = nlohmann::json::parse(ended.output, nullptr, false);
    EXPECT_TRUE(json.is_object()) << ended.output;
    return json;
  }
  support::TemporaryFolder folder_;
};

TEST_F(OperatorsTest, DoctorsOfBothProgramsFindNoFaultHere) {
  for (const std::string program : {"lifeline-agent", "lifeline-coordinator"}) {
    const Ended ended = run({program, "doctor", "--qos", kQos, "--domain", "96", "--state",
                             (folder_.path() / "state").string(), "--json"});
    EXPECT_NE(ended.status, 1) << ended.output;
    const auto json = json_of(ended);
    EXPECT_EQ(json.at("faults"), 0);
    EXPECT_EQ(ended.status, json.at("warnings") == 0 ? 0 : 3);
    EXPECT_GE(json.at("findings").size(), 7U);
  }
}

TEST_F(OperatorsTest, DoctorNamesEveryFaultAtOnceAndEndsWithOne) {
  const auto config = folder_.write("agent.yaml", "slam:\n  macher: direct\n  max_range_m: far\n");
  const Ended ended = run({"lifeline-agent", "doctor", "--config", config.string(), "--qos",
                           (folder_.path() / "none.xml").string(), "--source",
                           "rplidar:" + (folder_.path() / "ttyUSB0").string(), "--state",
                           (config / "state").string()});
  EXPECT_EQ(ended.status, 1);
  for (const auto* words : {"agent.yaml:2:", "agent.yaml:3:", "none.xml: no such",
                            "ttyUSB0: no such", "is no folder", "5 faults"})
    EXPECT_THAT(ended.output, HasSubstr(words));
  EXPECT_THAT(ended.output, Not(HasSubstr("\x1b["))) << "a file is no terminal";
}

TEST_F(OperatorsTest, DoctorIsUsedWronglyLikeRun) {
  EXPECT_EQ(run({"lifeline-agent", "doctor", "--source", "rplidar"}).status, 2);
  EXPECT_EQ(run({"lifeline-coordinator", "doctor", "--dashboard", "8642"}).status, 2);
  EXPECT_EQ(run({"lifeline-coordinator", "doctor", "--no-such"}).status, 2);
}

TEST_F(OperatorsTest, SlamAndExportPrintJsonAlone) {
  const std::string map = (folder_.path() / "map").string();
  const auto slam = json_of(run({"lifeline-agent", "slam", "--source",
                                 "sim:office?duration=3&beams=200", "--map", map, "--json"}));
  EXPECT_EQ(slam.at("scans"), 30);
  EXPECT_GT(slam.at("explored_m2"), 1.0);
  const auto written =
      json_of(run({"lifeline-coordinator", "export", map + ".lifemap", "--to",
                   (folder_.path() / "out").string(), "--format", "png,tum", "--json"}));
  EXPECT_EQ(written.at("formats"), nlohmann::json({"png", "tum"}));
  EXPECT_EQ(written.at("maps"), 1);
}

}  // namespace
}  // namespace lifeline::test
