#include "tests/support/rplidar/emulator.hpp"

#include <algorithm>
#include <chrono>
#include <utility>

namespace lifeline::test {
namespace {

constexpr std::uint8_t kStart = 0xA5;
/// Frames that are waiting to be sent, at most: as a device's own buffer.
constexpr std::size_t kMostWaiting = 4096;

void put(std::vector<std::uint8_t>& bytes, std::uint32_t value, int size) {
  for (int i = 0; i < size; ++i) bytes.push_back(static_cast<std::uint8_t>(value >> (8 * i)));
}

std::uint32_t number(std::span<const std::uint8_t> bytes, std::size_t at, std::size_t size) {
  std::uint32_t value = 0;
  for (std::size_t i = size; i-- > 0;) {
    value = value << 8 | (at + i < bytes.size() ? bytes[at + i] : 0U);
  }
  return value;
}

std::size_t frame_bytes(std::uint8_t type) {
  return type == 0x81 ? 5 : type == 0x84 ? 132 : 84;
}

}  // namespace

std::vector<EmulatedMode> a3_modes() {
  return {{"Standard", 252 << 8, 25 << 8, 0x81},  {"Express", 126 << 8, 25 << 8, 0x82},
          {"Boost", 63 << 8, 25 << 8, 0x84},      {"Sensitivity", 63 << 8, 25 << 8, 0x84},
          {"Stability", 100 << 8, 25 << 8, 0x84}, {"DenseBoost", 125 << 7, 40 << 8, 0x85}};
}

RplidarEmulator::RplidarEmulator(EmulatorOptions options, std::string link)
    : options_(std::move(options)),
      terminal_(std::move(link)),
      noise_(options_.seed),
      thread_([this](const std::stop_token& stop) { run(stop); }) {}

RplidarEmulator::~RplidarEmulator() = default;

std::string RplidarEmulator::device() const {
  std::lock_guard lock(mutex_);
  return terminal_.device();
}

void RplidarEmulator::set_noise(NoiseRates rates) {
  std::lock_guard lock(mutex_);
  rates_ = rates;
}

void RplidarEmulator::set_health(std::uint8_t status, std::uint16_t code) {
  std::lock_guard lock(mutex_);
  health_status_ = status;
  health_code_ = code;
}

void RplidarEmulator::unplug() {
  std::lock_guard lock(mutex_);
  terminal_.unplug();
  // Without power it forgets everything.
  scanning_ = false;
  pwm_ = 0;
  inbox_.clear();
  outbox_.clear();
}

void RplidarEmulator::plug_in() {
  std::lock_guard lock(mutex_);
  terminal_.plug_in();
}

std::vector<EmulatedFrame> RplidarEmulator::frames() const {
  std::lock_guard lock(mutex_);
  return frames_;
}

void RplidarEmulator::run(const std::stop_token& stop) {
  while (!stop.stop_requested()) {
    bool idle = false;
    {
      std::lock_guard lock(mutex_);
      step();
      idle = options_.real_time || !scanning_ || silent_ || !outbox_.empty();
    }
    // A pseudo-terminal cannot be waited for from both ends at once: looked at often instead.
    if (idle) std::this_thread::sleep_for(std::chrono::microseconds(200));
  }
}

void RplidarEmulator::step() {
  if (!terminal_.is_plugged_in()) return;
  receive();
  if (scanning_) stream();
  if (!outbox_.empty()) {
    const std::size_t sent = terminal_.send(outbox_);
    outbox_.erase(outbox_.begin(), outbox_.begin() + static_cast<std::ptrdiff_t>(sent));
  }
}

void RplidarEmulator::receive() {
  auto bytes = terminal_.receive(0);
  // At another rate than its own, it reads something else.
  if (terminal_.baud() != options_.baud) {
    for (std::uint8_t& byte : bytes) byte = static_cast<std::uint8_t>(byte * 37 + 11);
  }
  inbox_.insert(inbox_.end(), bytes.begin(), bytes.end());
  while (take_request()) {
  }
}

/// Takes one request off the inbox, or the byte that begins none; false where more has to come.
bool RplidarEmulator::take_request() {
  if (inbox_.empty()) return false;
  const auto drop = [&](std::size_t count) {
    inbox_.erase(inbox_.begin(), inbox_.begin() + static_cast<std::ptrdiff_t>(count));
    return true;
  };
  if (inbox_[0] != kStart) {
    // What it cannot read at a wrong rate, the other side reads as noise, too.
    if (terminal_.baud() != options_.baud) send(std::vector<std::uint8_t>(9, 0xF3), false);
    return drop(1);
  }
  if (inbox_.size() < 2) return false;
  const std::uint8_t command = inbox_[1];
  if ((command & 0x80) == 0) {
    drop(2);
    handle(command, {});
    return true;
  }
  if (inbox_.size() < 3) return false;
  const std::size_t length = inbox_[2];
  if (inbox_.size() < length + 4) return false;
  std::uint8_t checksum = 0;
  for (std::size_t i = 0; i < length + 3; ++i) checksum ^= inbox_[i];
  const bool whole = checksum == inbox_[length + 3];
  const std::vector<std::uint8_t> payload(inbox_.begin() + 3,
                                          inbox_.begin() + 3 + static_cast<std::ptrdiff_t>(length));
  drop(whole ? length + 4 : 1);
  if (whole) handle(command, payload);
  return true;
}

void RplidarEmulator::handle(std::uint8_t command, std::span<const std::uint8_t> payload) {
  switch (command) {
    case 0x25:
      scanning_ = false;
      break;
    case 0x40:
      scanning_ = false;
      ++resets_;
      if (heals_) health_status_ = 0;
      break;
    case 0x20:
      begin_scan(0);
      break;
    case 0x82:
      begin_scan(payload[0]);
      break;
    case 0x50: {
      std::vector<std::uint8_t> info{49, 0x1B, 0x01, 6};
      for (std::uint8_t i = 0; i < 16; ++i) info.push_back(static_cast<std::uint8_t>(0xA0 + i));
      answer(0x04, info);
      break;
    }
    case 0x52:
      answer(0x06, {health_status_, static_cast<std::uint8_t>(health_code_),
                    static_cast<std::uint8_t>(health_code_ >> 8)});
      break;
    case 0x84:
      answer_conf(payload);
      break;
    case 0xF0:
      pwm_ = static_cast<int>(number(payload, 0, 2));
      break;
    case 0xFF:
      answer(0xFF, {static_cast<std::uint8_t>(options_.has_motor_board ? 1 : 0), 0, 0, 0});
      break;
    default:
      break;  // unknown requests are not answered
  }
}

void RplidarEmulator::answer(std::uint8_t type, std::vector<std::uint8_t> data, bool repeating,
                             std::size_t length) {
  std::vector<std::uint8_t> bytes{kStart, 0x5A};
  const std::size_t size = repeating ? length : data.size();
  put(bytes, static_cast<std::uint32_t>(size) | (repeating ? 1U << 30 : 0U), 4);
  bytes.push_back(type);
  bytes.insert(bytes.end(), data.begin(), data.end());
  send(bytes, true);
}

void RplidarEmulator::answer_conf(std::span<const std::uint8_t> payload) {
  const std::uint32_t entry = number(payload, 0, 4);
  const std::uint32_t id = number(payload, 4, 2);
  std::vector<std::uint8_t> data;
  put(data, entry, 4);
  if (entry == 0x70) {
    put(data, static_cast<std::uint32_t>(options_.modes.size()), 2);
  } else if (entry == 0x7C) {
    put(data, 3, 2);  // Sensitivity
  } else if (id < options_.modes.size()) {
    const EmulatedMode& mode = options_.modes[id];
    if (entry == 0x71) put(data, mode.us_per_sample_q8, 4);
    if (entry == 0x74) put(data, mode.max_distance_q8, 4);
    if (entry == 0x75) put(data, mode.answer_type, 1);
    if (entry == 0x7F) {
      data.insert(data.end(), mode.name.begin(), mode.name.end());
      data.push_back(0);
    }
  }
  answer(0x20, data);
}

void RplidarEmulator::begin_scan(std::size_t mode) {
  if (mode >= options_.modes.size() || health_status_ == 2) return;
  mode_ = mode;
  const std::uint8_t type = options_.modes[mode].answer_type;
  outbox_.clear();
  answer(type, {}, true, frame_bytes(type));
  maker_.emplace(options_.modes[mode], options_.rotor_Hz, options_.world, angle_deg_);
  pending_.reset();
  frames_.clear();
  scan_began_ = std::chrono::steady_clock::now();
  scanning_ = true;
  ++scans_;
}

/// Sends the frames that are due. A silent device goes on measuring, and nobody hears of it.
void RplidarEmulator::stream() {
  if (options_.has_motor_board && pwm_ == 0) return;
  const EmulatedMode& mode = options_.modes[mode_];
  const double elapsed_s = to_seconds(std::chrono::steady_clock::now() - scan_began_);
  const double delay_s = 1e-6 * mode.us_per_sample() * 1.5 +
                         10.0 * static_cast<double>(frame_bytes(mode.answer_type)) / options_.baud;
  while (outbox_.size() < kMostWaiting) {
    if (!pending_) pending_ = maker_->next(!stalled_);
    if (options_.real_time && pending_->last_sample_s + delay_s > elapsed_s) return;
    if (!options_.real_time && silent_) return;
    angle_deg_ = maker_->angle_deg();
    if (!silent_) {
      ++frames_made_;
      send(pending_->bytes, true);
      if (options_.keep_frames) frames_.push_back(*std::move(pending_));
    }
    pending_.reset();
  }
}

void RplidarEmulator::send(std::span<const std::uint8_t> bytes, bool noisy) {
  std::vector<std::uint8_t> out(bytes.begin(), bytes.end());
  if (noisy && rates_.any()) out = noise_.damage(bytes, rates_);
  if (terminal_.baud() != options_.baud) {
    for (std::uint8_t& byte : out) byte = static_cast<std::uint8_t>(byte * 37 + 11);
  }
  outbox_.insert(outbox_.end(), out.begin(), out.end());
}

}  // namespace lifeline::test
