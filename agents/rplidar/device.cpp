#include "agents/rplidar/device.hpp"

#include <algorithm>
#include <array>

#include <fmt/ranges.h>

#include "agents/rplidar/frames.hpp"
#include "common/base/log.hpp"

namespace lifeline::rplidar {
namespace {

using std::chrono::milliseconds;

constexpr Duration kAnswerTime = milliseconds(200);
constexpr int kAttempts = 3;
/// A device that was reset says nothing for a while.
constexpr Duration kResetTime = milliseconds(2000);
constexpr Duration kWriteTime = milliseconds(100);
constexpr Duration kQuiet = milliseconds(20), kLongestDrain = milliseconds(300);
constexpr std::uint32_t kMostModes = 32;

SteadyTime in(Duration wait) {
  return std::chrono::steady_clock::now() + wait;
}

}  // namespace

Result<std::unique_ptr<Device>> Device::open(const DeviceSettings& settings,
                                             const std::stop_token& stop) {
  auto port = serial::SerialPort::open(settings.device, settings.baud, stop);
  if (!port) return forward_error(port);
  std::unique_ptr<Device> device(new Device(*std::move(port), settings));
  if (auto greeted = device->greet(); !greeted) return forward_error(greeted);
  if (auto healthy = device->check_health(); !healthy) return forward_error(healthy);
  auto modes = device->list_modes();
  if (!modes) return forward_error(modes);
  auto mode = choose_mode(*modes, settings.mode, settings.device);
  if (!mode) return forward_error(mode);
  device->mode_ = *std::move(mode);
  if (auto turning = device->turn_rotor(settings.motor_pwm); !turning) {
    return forward_error(turning);
  }
  return device;
}

Device::~Device() {
  // Best effort: the device may be gone.
  (void)send(Command::stop);
  (void)turn_rotor(0);
}

/// Ends what the device may still be doing for somebody before us, and asks who it is.
Result<void> Device::greet() {
  if (auto sent = send(Command::stop); !sent) return sent;
  if (auto drained = drain(kQuiet); !drained) return drained;
  const auto info = ask(Command::get_info, AnswerType::info);
  if (!info) return forward_error(info);
  const auto parsed = parse_info(info->answer());
  if (!parsed) return no_answer(true);
  info_ = *parsed;
  std::uint8_t nothing[4] = {};
  const auto flag = ask(Command::get_accessory_flag, AnswerType::accessory_flag, nothing);
  // Boards that do not know the request do not answer; a port that is gone is seen at the next one.
  has_motor_control_ = flag && parse_accessory_flag(flag->answer()).value_or(false);
  return {};
}

Result<void> Device::check_health() {
  auto health = ask_health();
  if (health && health->status == HealthStatus::error) {
    if (auto sent = send(Command::reset); !sent) return sent;
    const SteadyTime until = in(kResetTime);
    do {
      if (auto drained = drain(kAnswerTime); !drained) return drained;
      health = ask_health();
    } while (!health && !port_.stop_requested() && std::chrono::steady_clock::now() < until);
  }
  if (!health) return forward_error(health);
  if (health->status == HealthStatus::error) {
    return fail(ErrorCode::unavailable,
                "{}: reports health error {:#06x}; check its power (5 V, up to 1.5 A at the start) "
                "and that nothing blocks the rotor, then switch it off and on",
                settings_.device, health->error_code);
  }
  if (health->status == HealthStatus::warning) {
    spdlog::warn("{}: reports health warning {:#06x}; it may fail soon", settings_.device,
                 health->error_code);
  }
  return {};
}

Result<Health> Device::ask_health() {
  const auto answer = ask(Command::get_health, AnswerType::health);
  if (!answer) return forward_error(answer);
  const auto health = parse_health(answer->answer());
  if (!health) return no_answer(true);
  return *health;
}

Result<void> Device::turn_rotor(std::uint16_t pwm) {
  // Boards without a motor command turn the rotor while the line is cleared.
  port_.set_dtr(pwm == 0);
  if (!has_motor_control_) return {};
  return send(Command::set_motor_pwm, motor_payload(pwm));
}

Result<ScanModes> Device::list_modes() {
  const auto value = ask_conf(ConfEntry::mode_count, std::nullopt);
  if (!value) {
    if (port_.stop_requested()) return forward_error(value);
    return fail(ErrorCode::unsupported,
                "{}: does not tell its scan modes (firmware {}.{:02}); it needs firmware 1.24 or "
                "newer",
                settings_.device, info_.firmware_major, info_.firmware_minor);
  }
  const auto count = parse_number(*value, 2);
  if (!count || *count == 0 || *count > kMostModes) return no_answer(true);
  ScanModes modes;
  for (std::uint16_t id = 0; id < *count; ++id) {
    auto mode = ask_mode(id);
    if (!mode) return forward_error(mode);
    modes.all.push_back(*std::move(mode));
  }
  const auto typical = ask_conf(ConfEntry::typical_mode, std::nullopt);
  if (!typical) return forward_error(typical);
  if (const auto id = parse_number(*typical, 2)) modes.typical = static_cast<std::uint16_t>(*id);
  return modes;
}

Result<ScanMode> Device::ask_mode(std::uint16_t id) {
  const auto name = ask_conf(ConfEntry::mode_name, id);
  if (!name) return forward_error(name);
  const auto sample = ask_conf(ConfEntry::us_per_sample, id);
  if (!sample) return forward_error(sample);
  const auto distance = ask_conf(ConfEntry::max_distance, id);
  if (!distance) return forward_error(distance);
  const auto type = ask_conf(ConfEntry::answer_type, id);
  if (!type) return forward_error(type);
  const auto us_q8 = parse_number(*sample, 4);
  const auto distance_q8 = parse_number(*distance, 4);
  // 20 us to 10 ms a sample: anything else is no scan mode of a lidar.
  if (!us_q8 || *us_q8 < 20 * 256 || *us_q8 > 10'000 * 256 || !distance_q8 || type->empty()) {
    return no_answer(true);
  }
  return ScanMode{id, parse_name(*name), *us_q8 / 256.0, *distance_q8 / 256.0, type->front()};
}

Result<std::vector<std::uint8_t>> Device::ask_conf(ConfEntry entry,
                                                   std::optional<std::uint16_t> mode) {
  const auto payload = conf_payload(entry, mode);
  const auto answer = ask(Command::get_lidar_conf, AnswerType::lidar_conf, payload);
  if (!answer) return forward_error(answer);
  const auto value = conf_value(answer->answer(), entry);
  if (!value) return no_answer(true);
  return std::vector<std::uint8_t>(value->begin(), value->end());
}

Result<std::vector<std::uint8_t>> Device::start_scan() {
  const auto type = static_cast<AnswerType>(mode_.answer_type);
  port_.discard_input();
  const auto begun = type == AnswerType::standard_nodes
                         ? ask(Command::scan, type)
                         : ask(Command::express_scan, type, express_payload(mode_.id));
  if (!begun) return forward_error(begun);
  return std::vector<std::uint8_t>(begun->rest().begin(), begun->rest().end());
}

Result<void> Device::send(Command command, Bytes payload) {
  return port_.write(encode_request(command, payload), in(kWriteTime));
}

/// Sends a request until its answer comes: lines lose bytes.
Result<AnswerFinder> Device::ask(Command command, AnswerType type, Bytes payload) {
  bool heard = false;
  for (int attempt = 0; attempt < kAttempts; ++attempt) {
    if (auto sent = send(command, payload); !sent) return forward_error(sent);
    AnswerFinder finder(type);
    const auto complete = wait_for(finder);
    if (!complete) return forward_error(complete);
    if (*complete) return finder;
    heard = heard || finder.heard();
  }
  return no_answer(heard);
}

/// Whether the answer came in time.
Result<bool> Device::wait_for(AnswerFinder& finder) {
  const SteadyTime until = in(kAnswerTime);
  std::array<std::uint8_t, 512> bytes{};
  while (std::chrono::steady_clock::now() < until) {
    const auto size = port_.read(bytes, until);
    if (!size) return forward_error(size);
    if (port_.stop_requested()) {
      return fail(ErrorCode::unavailable, "{}: stopped while it was asked", settings_.device);
    }
    if (finder.push(Bytes(bytes).first(*size))) return true;
  }
  return false;
}

/// Throws away what comes, until nothing came for `quiet`.
Result<void> Device::drain(Duration quiet) {
  const SteadyTime until = in(kLongestDrain + quiet);
  std::array<std::uint8_t, 512> bytes{};
  while (std::chrono::steady_clock::now() < until) {
    const auto size = port_.read(bytes, in(quiet));
    if (!size) return forward_error(size);
    if (*size == 0) break;
  }
  return {};
}

tl::unexpected<Error> Device::no_answer(bool heard) const {
  if (heard) {
    return fail(ErrorCode::unavailable,
                "{}: what it answers makes no sense at {} baud; set baud (A3: 256000, A1 and A2: "
                "115200) and check the cable",
                settings_.device, settings_.baud);
  }
  return fail(ErrorCode::unavailable,
              "{}: no answer; check that it is an RPLIDAR, its power (5 V, up to 1.5 A at the "
              "start), the cable, and baud (A3: 256000, A1 and A2: 115200; now {})",
              settings_.device, settings_.baud);
}

}  // namespace lifeline::rplidar
