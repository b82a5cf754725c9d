#include "agents/serial/serial_port.hpp"

#include <array>
#include <numeric>
#include <thread>

#include <gmock/gmock.h>
#include <sys/stat.h>

#include "tests/support/pseudo_terminal.hpp"
#include "tests/support/temporary_folder.hpp"

namespace lifeline::serial {
namespace {

using test::PseudoTerminal;
using testing::AllOf;
using testing::HasSubstr;

constexpr int kBaud = 256'000;

SteadyTime in(std::chrono::milliseconds wait) {
  return std::chrono::steady_clock::now() + wait;
}
/// For what should come at once: longer only where the machine stands still.
SteadyTime patience() {
  return in(std::chrono::seconds(30));
}

std::vector<std::uint8_t> every_byte() {
  std::vector<std::uint8_t> bytes(256);
  std::iota(bytes.begin(), bytes.end(), std::uint8_t{0});
  return bytes;
}

/// Reads until `count` bytes came or the line is silent.
std::vector<std::uint8_t> read_all(SerialPort& port, std::size_t count) {
  std::vector<std::uint8_t> all;
  std::array<std::uint8_t, 100> part{};
  while (all.size() < count) {
    const auto size = port.read(part, patience());
    if (!size || *size == 0) break;
    all.insert(all.end(), part.begin(), part.begin() + static_cast<std::ptrdiff_t>(*size));
  }
  return all;
}

/// The error of a device that this user may not open.
Error error_without_permission(const std::string& device) {
  const bool root = ::geteuid() == 0;
  if (root) {
    EXPECT_EQ(::seteuid(65534), 0);
  } else {
    EXPECT_EQ(::chmod(device.c_str(), 0), 0);
  }
  const auto port = SerialPort::open(device, kBaud);
  if (root) {
    EXPECT_EQ(::seteuid(0), 0);
  }
  EXPECT_FALSE(port.has_value());
  return port ? Error{} : port.error();
}

TEST(SerialPort, reads_every_byte_as_it_was_sent) {
  PseudoTerminal line;
  auto port = SerialPort::open(line.device(), kBaud);
  ASSERT_TRUE(port) << port.error().text;
  EXPECT_EQ(line.send(every_byte()), 256U);
  EXPECT_EQ(read_all(*port, 256), every_byte());
}

TEST(SerialPort, writes_every_byte_as_it_is_given) {
  PseudoTerminal line;
  auto port = SerialPort::open(line.device(), kBaud);
  ASSERT_TRUE(port) << port.error().text;
  ASSERT_TRUE(port->write(every_byte(), patience()));
  std::vector<std::uint8_t> received;
  while (received.size() < 256) {
    const auto part = line.receive(30'000);
    ASSERT_FALSE(part.empty());
    received.insert(received.end(), part.begin(), part.end());
  }
  EXPECT_EQ(received, every_byte());
}

TEST(SerialPort, runs_at_rates_that_are_not_classic) {
  for (const int baud : {115'200, 256'000, 1'000'000}) {
    PseudoTerminal line;
    const auto port = SerialPort::open(line.device(), baud);
    ASSERT_TRUE(port) << port.error().text;
    EXPECT_EQ(line.baud(), baud);
  }
}

TEST(SerialPort, gives_no_bytes_when_the_deadline_passes) {
  PseudoTerminal line;
  auto port = SerialPort::open(line.device(), kBaud);
  ASSERT_TRUE(port);
  std::array<std::uint8_t, 4> bytes{};
  EXPECT_EQ(port->read(bytes, in(std::chrono::milliseconds(5))).value(), 0U);
  ASSERT_EQ(line.send(std::array<std::uint8_t, 1>{7}), 1U);
  EXPECT_EQ(read_all(*port, 1), std::vector<std::uint8_t>{7});
}

TEST(SerialPort, forgets_what_came_in_when_asked_to) {
  PseudoTerminal line;
  auto first = SerialPort::open(line.device(), kBaud);
  ASSERT_TRUE(first);
  ASSERT_EQ(line.send(every_byte()), 256U);
  first->discard_input();
  ASSERT_EQ(line.send(std::array<std::uint8_t, 1>{7}), 1U);
  EXPECT_EQ(read_all(*first, 1), std::vector<std::uint8_t>{7});
}

TEST(SerialPort, a_stop_from_another_thread_ends_a_waiting_read) {
  PseudoTerminal line;
  std::stop_source stop;
  auto port = SerialPort::open(line.device(), kBaud, stop.get_token());
  ASSERT_TRUE(port);
  std::jthread stopper([&stop] { stop.request_stop(); });
  std::array<std::uint8_t, 4> bytes{};
  EXPECT_EQ(port->read(bytes, SteadyTime::max()).value(), 0U);
  EXPECT_TRUE(port->stop_requested());
}

TEST(SerialPort, still_writes_after_the_stop) {
  PseudoTerminal line;
  std::stop_source stop;
  auto port = SerialPort::open(line.device(), kBaud, stop.get_token());
  ASSERT_TRUE(port);
  stop.request_stop();
  ASSERT_TRUE(port->write(std::array<std::uint8_t, 2>{0xA5, 0x25}, patience()));
  EXPECT_EQ(line.receive(30'000), (std::vector<std::uint8_t>{0xA5, 0x25}));
}

TEST(SerialPort, a_line_that_takes_nothing_is_an_error_at_the_deadline) {
  PseudoTerminal line;
  auto port = SerialPort::open(line.device(), kBaud);
  ASSERT_TRUE(port);
  const std::vector<std::uint8_t> much(1 << 20);
  const auto written = port->write(much, in(std::chrono::milliseconds(20)));
  ASSERT_FALSE(written);
  EXPECT_THAT(written.error().text, HasSubstr("takes no more bytes"));
}

TEST(SerialPort, an_unplugged_device_ends_a_waiting_read_with_advice) {
  PseudoTerminal line;
  auto port = SerialPort::open(line.device(), kBaud);
  ASSERT_TRUE(port);
  const std::string device = line.device();
  std::jthread unplugger([&line] { line.unplug(); });
  std::array<std::uint8_t, 4> bytes{};
  const auto size = port->read(bytes, SteadyTime::max());
  ASSERT_FALSE(size);
  EXPECT_EQ(size.error().code, ErrorCode::unavailable);
  EXPECT_EQ(size.error().text, device + ": unplugged; check the plug and the cable");
  unplugger.join();
  EXPECT_FALSE(port->write(bytes, patience()));
}

TEST(SerialPort, opens_again_after_the_device_was_plugged_in_again) {
  const support::TemporaryFolder folder;
  PseudoTerminal line((folder.path() / "lidar").string());
  auto port = SerialPort::open(line.device(), kBaud);
  ASSERT_TRUE(port);
  line.unplug();
  const auto missing = SerialPort::open(line.device(), kBaud);
  ASSERT_FALSE(missing);
  EXPECT_EQ(missing.error().code, ErrorCode::not_found);
  line.plug_in();
  port = SerialPort::open(line.device(), kBaud);
  ASSERT_TRUE(port) << port.error().text;
  ASSERT_EQ(line.send(every_byte()), 256U);
  EXPECT_EQ(read_all(*port, 256), every_byte());
}

TEST(SerialPort, a_missing_device_is_an_error_with_advice) {
  const auto port = SerialPort::open("/dev/lifeline_no_such_device", kBaud);
  ASSERT_FALSE(port);
  EXPECT_EQ(port.error().code, ErrorCode::not_found);
  EXPECT_THAT(port.error().text, AllOf(HasSubstr("/dev/lifeline_no_such_device: no such device"),
                                       HasSubstr("/dev/serial/by-id")));
}

TEST(SerialPort, a_device_of_somebody_else_is_an_error_that_names_the_group) {
  PseudoTerminal line;
  const Error error = error_without_permission(line.device());
  EXPECT_EQ(error.code, ErrorCode::unavailable);
  EXPECT_THAT(error.text, AllOf(HasSubstr("permission denied"), HasSubstr("group dialout")));
}

TEST(SerialPort, a_device_in_use_is_an_error_that_says_so) {
  PseudoTerminal line;
  const auto first = SerialPort::open(line.device(), kBaud);
  ASSERT_TRUE(first);
  const auto second = SerialPort::open(line.device(), kBaud);
  ASSERT_FALSE(second);
  EXPECT_EQ(second.error().code, ErrorCode::unavailable);
  EXPECT_THAT(second.error().text, HasSubstr("in use by another program"));
}

TEST(SerialPort, files_and_folders_are_no_serial_devices) {
  const support::TemporaryFolder folder;
  for (const auto& path : {folder.path(), folder.write("file", "text")}) {
    const auto port = SerialPort::open(path.string(), kBaud);
    ASSERT_FALSE(port);
    EXPECT_EQ(port.error().code, ErrorCode::wrong_use);
    EXPECT_THAT(port.error().text, HasSubstr("not a serial device"));
  }
}

}  // namespace
}  // namespace lifeline::serial
