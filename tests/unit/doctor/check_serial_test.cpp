#include "common/doctor/check_serial.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "agents/serial/serial_port.hpp"
#include "tests/support/another_user.hpp"
#include "tests/support/pseudo_terminal.hpp"
#include "tests/support/temporary_folder.hpp"

namespace lifeline::doctor {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

/// A kernel's view of USB adapters, as Linux lays it out.
class CheckSerial : public testing::Test {
 protected:
  void plug_in(const std::string& name, const std::string& vendor, const std::string& product) {
    const fs::path usb = folder_.path() / "sys/devices/usb1" / ("port-" + name);
    const fs::path tty = usb / "interface" / name;
    fs::create_directories(tty);
    fs::create_directories(folder_.path() / "sys/class/tty" / name);
    fs::create_directories(folder_.path() / "dev");
    fs::create_symlink(tty, folder_.path() / "sys/class/tty" / name / "device");
    std::ignore = folder_.write(fs::relative(usb / "idVendor", folder_.path()).string(), vendor);
    std::ignore = folder_.write(fs::relative(usb / "idProduct", folder_.path()).string(), product);
    std::ignore = folder_.write("dev/" + name, "");
    fs::permissions(folder_.path() / "dev" / name, fs::perms::none);
    fs::permissions(folder_.path(), fs::perms::all);  // another user may look
  }
  const fs::path& root() { return folder_.path(); }

  support::TemporaryFolder folder_;
};

TEST_F(CheckSerial, ALineThatOpensIsGood) {
  const test::PseudoTerminal line;
  const auto found = check_serial_port(line.device(), 256'000, root());
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].level, Level::ok) << found[0].what;
  EXPECT_EQ(found[0].what, "opens at 256000 baud");
}

TEST_F(CheckSerial, ALineThatAnotherHolds) {
  const test::PseudoTerminal line;
  const auto helmet = serial::SerialPort::open(line.device(), 115'200);
  ASSERT_TRUE(helmet);
  const auto found = check_serial_port(line.device(), 115'200, root());
  EXPECT_EQ(found[0].level, Level::fault);
  EXPECT_THAT(found[0].what, HasSubstr("in use"));
  EXPECT_THAT(found[0].advice, HasSubstr("stop it"));
}

TEST_F(CheckSerial, ALineThatThisUserMayNotOpen) {
  const test::PseudoTerminal line;
  fs::permissions(line.device(), fs::perms::none);
  const test::AnotherUser nobody;
  const auto found = check_serial_port(line.device(), 115'200, root());
  EXPECT_EQ(found[0].level, Level::fault);
  EXPECT_EQ(found[0].what, "permission denied");
  EXPECT_THAT(found[0].advice, HasSubstr("dialout"));
}

TEST_F(CheckSerial, ADeviceThatIsNotThereIsSoughtAmongThoseThatAre) {
  plug_in("ttyUSB1", "10c4\n", "ea60\n");
  const auto found = check_serial_port("/dev/lifeline-no-such-device", 256'000, root());
  EXPECT_EQ(found[0].level, Level::fault);
  EXPECT_THAT(found[0].advice, HasSubstr("/dev/ttyUSB1 USB 10c4:ea60 (Silicon Labs CP210x"));
}

TEST_F(CheckSerial, AFileIsNoSerialDevice) {
  const auto found = check_serial_port(folder_.write("file", "x").string(), 256'000, root());
  EXPECT_EQ(found[0].level, Level::fault);
  EXPECT_THAT(found[0].what, HasSubstr("not a serial device"));
}

TEST_F(CheckSerial, AdaptersAreListedByNameWithWhatTheyUsuallyAre) {
  plug_in("ttyUSB1", "0403", "6001");
  plug_in("ttyUSB0", "dead", "beef");
  fs::create_directories(root() / "sys/class/tty/tty0");  // none of USB
  const auto adapters = list_usb_serial(root());
  ASSERT_EQ(adapters.size(), 2U);
  EXPECT_EQ(adapters[0].device, "/dev/ttyUSB0");
  EXPECT_EQ(adapters[0].maker, "");
  EXPECT_EQ(adapters[1].usb_id, "0403:6001");
  EXPECT_THAT(adapters[1].maker, HasSubstr("FTDI"));
  EXPECT_TRUE(list_usb_serial(root() / "nowhere").empty());
}

TEST_F(CheckSerial, WhatIsPluggedInMustBeOursToOpen) {
  plug_in("ttyUSB0", "10c4", "ea60");
  const test::AnotherUser nobody;
  const auto found = check_plugged_in(root());
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].level, Level::fault);
  EXPECT_THAT(found[0].advice, HasSubstr("dialout"));
}

}  // namespace
}  // namespace lifeline::doctor
