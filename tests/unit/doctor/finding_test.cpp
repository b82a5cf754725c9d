#include "common/doctor/finding.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace lifeline::doctor {
namespace {

using testing::HasSubstr;
using testing::Not;

const Finding kGood = ok("clock", "system clock", "synchronised");
const Finding kPoor = warning("buffers", "net.core.rmem_max", "small", "raise it");
const Finding kBad = fault("serial", "/dev/ttyUSB0", "no such device", "plug it in");

TEST(DoctorFindings, ExitStatusTellsFaultsFromWarningsFromNothing) {
  EXPECT_EQ(exit_status({}), 0);
  EXPECT_EQ(exit_status({kGood, kGood}), 0);
  EXPECT_EQ(exit_status({kGood, kPoor}), 3);
  EXPECT_EQ(exit_status({kPoor, kBad, kGood}), 1);
}

TEST(DoctorFindings, TextSaysWhatAndWhereAndWhatToDo) {
  EXPECT_EQ(to_text({kGood, kBad}, false),
            "ok       clock      system clock: synchronised\n"
            "fault    serial     /dev/ttyUSB0: no such device\n"
            "                    -> plug it in\n"
            "1 fault, 0 warnings\n");
  EXPECT_THAT(to_text({kGood}, false), HasSubstr("nothing is wrong\n"));
}

TEST(DoctorFindings, ColourIsOnlyAddedWhereItIsWanted) {
  EXPECT_THAT(to_text({kBad}, true), HasSubstr("\x1b[31mfault   \x1b[0m"));
  EXPECT_THAT(to_text({kGood, kPoor, kBad}, false), Not(HasSubstr("\x1b")));
}

TEST(DoctorFindings, JsonHoldsEveryPart) {
  const auto json = nlohmann::json::parse(to_json({kGood, kPoor, kBad}));
  EXPECT_EQ(json.at("outcome"), "faults");
  EXPECT_EQ(json.at("faults"), 1);
  EXPECT_EQ(json.at("warnings"), 1);
  ASSERT_EQ(json.at("findings").size(), 3U);
  const nlohmann::json serial{{"level", "fault"},
                              {"check", "serial"},
                              {"where", "/dev/ttyUSB0"},
                              {"what", "no such device"},
                              {"advice", "plug it in"}};
  EXPECT_EQ(json.at("findings")[2], serial);
  EXPECT_EQ(nlohmann::json::parse(to_json({kPoor})).at("outcome"), "warnings");
  EXPECT_EQ(nlohmann::json::parse(to_json({kGood})).at("outcome"), "ok");
}

TEST(DoctorFindings, JsonStaysJsonWhateverAFileIsCalled) {
  const auto json = nlohmann::json::parse(to_json({ok("state", "/tmp/\xff\"\n", "there")}));
  EXPECT_THAT(json.at("findings")[0].at("where").get<std::string>(), HasSubstr("/tmp/"));
}

TEST(DoctorFindings, AnErrorOfSeveralLinesBecomesSeveralFaults) {
  const auto found = faults("config", "a.yaml",
                            {ErrorCode::wrong_use,
                             "a.yaml:2:3: slam.macher: no such key; did you mean matcher?\n"
                             "a.yaml: no such file"});
  ASSERT_EQ(found.size(), 2U);
  EXPECT_EQ(found[0].what, "a.yaml:2:3: slam.macher: no such key");
  EXPECT_EQ(found[0].advice, "did you mean matcher?");
  EXPECT_EQ(found[1].what, "no such file");
  EXPECT_EQ(found[1].advice, "");
  EXPECT_EQ(found[1].level, Level::fault);
}

}  // namespace
}  // namespace lifeline::doctor
