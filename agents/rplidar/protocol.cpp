#include "agents/rplidar/protocol.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "common/base/check.hpp"
#include "common/base/printable.hpp"

namespace lifeline::rplidar {
namespace {

constexpr std::uint8_t kStart = 0xA5, kAnswerStart = 0x5A;
constexpr std::uint8_t kHasPayload = 0x80;
/// The longest single answer is a mode's name; a descriptor that promises more is none.
constexpr std::uint32_t kLongestAnswer = 256;
constexpr std::size_t kInfoBytes = 20, kHealthBytes = 3, kSerialBytes = 16, kNameBytes = 32;

void append(std::vector<std::uint8_t>& bytes, std::uint32_t value, std::size_t size) {
  for (std::size_t i = 0; i < size; ++i) {
    bytes.push_back(static_cast<std::uint8_t>(value >> (8 * i)));
  }
}

}  // namespace

std::vector<std::uint8_t> encode_request(Command command, Bytes payload) {
  const auto code = static_cast<std::uint8_t>(command);
  LIFELINE_CHECK(payload.empty() == ((code & kHasPayload) == 0) && payload.size() <= 255);
  std::vector<std::uint8_t> request{kStart, code};
  if (payload.empty()) return request;
  request.push_back(static_cast<std::uint8_t>(payload.size()));
  request.insert(request.end(), payload.begin(), payload.end());
  std::uint8_t checksum = 0;
  for (const std::uint8_t byte : request) checksum ^= byte;
  request.push_back(checksum);
  return request;
}

std::vector<std::uint8_t> express_payload(std::uint16_t mode) {
  // The mode is one byte; flags and parameter, 16 bits each, are 0.
  return {static_cast<std::uint8_t>(mode), 0, 0, 0, 0};
}

std::vector<std::uint8_t> conf_payload(ConfEntry entry, std::optional<std::uint16_t> mode) {
  std::vector<std::uint8_t> payload;
  append(payload, static_cast<std::uint32_t>(entry), 4);
  if (mode) append(payload, *mode, 2);
  return payload;
}

std::vector<std::uint8_t> motor_payload(std::uint16_t pwm) {
  std::vector<std::uint8_t> payload;
  append(payload, pwm, 2);
  return payload;
}

std::optional<std::uint32_t> parse_number(Bytes value, std::size_t size) {
  if (value.size() < size) return std::nullopt;
  std::uint32_t number = 0;
  for (std::size_t i = size; i-- > 0;) number = number << 8 | value[i];
  return number;
}

std::optional<Descriptor> parse_descriptor(Bytes bytes) {
  if (bytes.size() < kDescriptorBytes || bytes[0] != kStart || bytes[1] != kAnswerStart) {
    return std::nullopt;
  }
  const std::uint32_t length_and_mode = *parse_number(bytes.subspan(2), 4);
  const std::uint32_t mode = length_and_mode >> 30;
  if (mode > 1) return std::nullopt;
  return Descriptor{length_and_mode & 0x3FFF'FFFFU, mode == 1, bytes[6]};
}

std::optional<DeviceInfo> parse_info(Bytes answer) {
  if (answer.size() < kInfoBytes) return std::nullopt;
  DeviceInfo info{answer[0], answer[2], answer[1], answer[3], {}};
  for (const std::uint8_t byte : answer.subspan(4, kSerialBytes)) {
    info.serial_number += fmt::format("{:02X}", byte);
  }
  return info;
}

std::optional<Health> parse_health(Bytes answer) {
  if (answer.size() < kHealthBytes || answer[0] > 2) return std::nullopt;
  return Health{static_cast<HealthStatus>(answer[0]),
                static_cast<int>(*parse_number(answer.subspan(1), 2))};
}

std::optional<bool> parse_accessory_flag(Bytes answer) {
  const auto flags = parse_number(answer, 4);
  if (!flags) return std::nullopt;
  return (*flags & 1U) != 0;
}

std::optional<Bytes> conf_value(Bytes answer, ConfEntry entry) {
  const auto about = parse_number(answer, 4);
  if (!about || *about != static_cast<std::uint32_t>(entry)) return std::nullopt;
  return answer.subspan(4);
}

std::string parse_name(Bytes value) {
  std::string name;
  for (const std::uint8_t byte : value.first(std::min(value.size(), kNameBytes))) {
    if (byte == 0) break;
    name += static_cast<char>(byte);
  }
  return printable(std::move(name));
}

bool AnswerFinder::push(Bytes bytes) {
  heard_ = heard_ || !bytes.empty();
  buffer_.insert(buffer_.end(), bytes.begin(), bytes.end());
  while (!found_ && buffer_.size() >= kDescriptorBytes) {
    if (look()) break;
    const auto next = std::find(buffer_.begin() + 1, buffer_.end(), kStart);
    buffer_.erase(buffer_.begin(), next);
  }
  return found_ && (found_->repeating || buffer_.size() >= found_->length);
}

/// Whether the buffer begins with the descriptor looked for; takes it off if so.
bool AnswerFinder::look() {
  const auto descriptor = parse_descriptor(buffer_);
  if (!descriptor || descriptor->type != static_cast<std::uint8_t>(type_) ||
      descriptor->length > kLongestAnswer) {
    return false;
  }
  found_ = descriptor;
  buffer_.erase(buffer_.begin(), buffer_.begin() + kDescriptorBytes);
  return true;
}

Bytes AnswerFinder::answer() const {
  LIFELINE_CHECK(found_.has_value());
  return found_->repeating ? Bytes{} : Bytes(buffer_).first(found_->length);
}

Bytes AnswerFinder::rest() const {
  return Bytes(buffer_).subspan(answer().size());
}

}  // namespace lifeline::rplidar
