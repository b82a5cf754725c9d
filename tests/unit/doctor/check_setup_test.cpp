#include "common/doctor/check_setup.hpp"

#include <algorithm>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/temporary_folder.hpp"

namespace lifeline::doctor {
namespace {

using testing::Contains;
using testing::Each;
using testing::ElementsAre;
using testing::Field;

const std::filesystem::path kQos = LIFELINE_SOURCE_DIR "/config/qos";

std::vector<std::string> checks_of(const Findings& findings) {
  std::vector<std::string> checks;
  for (const Finding& finding : findings) {
    if (checks.empty() || checks.back() != finding.check) checks.push_back(finding.check);
  }
  return checks;
}

class CheckSetup : public testing::Test {
 protected:
  CheckSetup() {
    setup_.qos_file = kQos / "loopback.xml";
    setup_.domain = 98;
    setup_.folders = {{"state", folder_.path().string(), "--state", {0, 0}},
                      {"recording", "off", "--record", {0, 0}}};
    setup_.tcp_ports = {{"dashboard", "127.0.0.1", 0, "", true}};
  }
  support::TemporaryFolder folder_;
  doctor::Setup setup_;
};

TEST_F(CheckSetup, EverythingIsLookedAtOnThisVeryMachine) {
  const Findings found = check_setup(setup_);
  EXPECT_THAT(checks_of(found), ElementsAre("config", "qos", "interface", "buffers", "domain",
                                            "dashboard", "state", "recording", "clock"));
  EXPECT_THAT(found, Each(Field(&Finding::level, testing::Ne(Level::fault))));
}

TEST_F(CheckSetup, ABadConfigurationHidesNothingElse) {
  setup_.config_file = "a.yaml";
  setup_.config_error = Error{ErrorCode::wrong_use, "a.yaml:1:1: x; y\na.yaml:2:1: z; y"};
  const Findings found = check_setup(setup_);
  EXPECT_EQ(std::ranges::count(found, "config", &Finding::check), 2);
  EXPECT_THAT(checks_of(found), Contains("clock"));
  EXPECT_EQ(exit_status(found), 1);
}

TEST_F(CheckSetup, ProfilesThatDoNotLoadAreAFaultOfTheirOwn) {
  setup_.qos_file = folder_.write("bad.xml", "<dds>");
  const Findings found = check_setup(setup_);
  EXPECT_THAT(checks_of(found), Contains("qos"));
  EXPECT_EQ(exit_status(found), 1);
  setup_.qos_file = fail(ErrorCode::not_found, "no configuration folder; set LIFELINE_CONFIG");
  EXPECT_EQ(exit_status(check_setup(setup_)), 1);
}

TEST_F(CheckSetup, APortThatIsAConvenienceIsNoFault) {
  setup_.tcp_ports = {{"dashboard", "203.0.113.1", 8642, "", false}};
  const Findings found = check_setup(setup_);
  const auto port = std::ranges::find(found, "dashboard", &Finding::check);
  ASSERT_NE(port, found.end());
  EXPECT_EQ(port->level, Level::warning);
}

TEST_F(CheckSetup, SharedMemoryIsLookedAtWhereProfilesUseIt) {
  std::string profiles = support::content_of(kQos / "loopback.xml");
  const std::string off = "<useBuiltinTransports>false", on = "<useBuiltinTransports>true";
  profiles.replace(profiles.find(off), off.size(), on);
  setup_.qos_file = folder_.write("shm.xml", profiles);
  EXPECT_THAT(checks_of(check_setup(setup_)), Contains("memory"));
}

}  // namespace
}  // namespace lifeline::doctor
