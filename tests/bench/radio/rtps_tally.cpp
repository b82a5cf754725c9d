#include "tests/bench/radio/rtps_tally.hpp"

#include <algorithm>
#include <optional>
#include <utility>

namespace lifeline::bench {
namespace {

using Octets = std::span<const std::uint8_t>;

constexpr std::size_t kEthernet = 14, kUdp = 8, kRtpsHeader = 20;
constexpr std::uint8_t kAcknack = 0x06, kHeartbeat = 0x07, kGap = 0x08, kInfoDestination = 0x0e,
                       kNackFragment = 0x12, kHeartbeatFragment = 0x13, kData = 0x15,
                       kDataFragment = 0x16;
constexpr std::uint16_t kTopicName = 0x0005, kEndpointGuid = 0x005a, kSentinel = 0x0001;
constexpr std::array<std::uint8_t, 4> kPublicationsWriter{0x00, 0x00, 0x03, 0xc2};

// RTPS as Fast DDS writes it on the machines that are measured: little endian.
std::uint32_t number(Octets from, std::size_t at, std::size_t octets) {
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < octets; ++i)
    value |= static_cast<std::uint32_t>(from[at + i]) << (8 * i);
  return value;
}

/// The RTPS message of an Ethernet frame, if it holds one.
std::optional<Octets> rtps_of(Octets frame) {
  if (frame.size() < kEthernet + 20 || frame[12] != 0x08 || frame[13] != 0) return std::nullopt;
  const std::size_t begin = kEthernet + 4U * (frame[kEthernet] & 0x0fU) + kUdp;
  if (frame.size() < begin + kRtpsHeader) return std::nullopt;
  const Octets message = frame.subspan(begin);
  constexpr std::string_view kMagic = "RTPS";
  if (!std::equal(kMagic.begin(), kMagic.end(), message.begin())) return std::nullopt;
  return message;
}

bool is_builtin(Octets entity) {
  return (entity[3] & 0xc0U) == 0xc0U;
}

}  // namespace

void RtpsTally::take(Octets frame, bool counts) {
  Message about;
  about.counts = counts;
  about.unowned = frame.size();
  if (const auto message = rtps_of(frame)) {
    about.address = number(frame, kEthernet + 16, 4);
    std::copy_n(message->begin() + 8, 12, about.source.begin());
    take_message(message->subspan(kRtpsHeader), about);
  }
  if (counts) octets_[about.first.empty() ? "other" : about.first] += about.unowned;
}

void RtpsTally::take_message(Octets message, Message& about) {
  while (message.size() >= 4) {
    const std::uint8_t kind = message[0];
    std::size_t length = number(message, 2, 2);
    if (length == 0 && (kind == kData || kind == kDataFragment)) length = message.size() - 4;
    length = std::min(length, message.size() - 4);
    take_submessage(kind, message.subspan(4, length), about);
    message = message.subspan(4 + length);
  }
}

void RtpsTally::take_submessage(std::uint8_t kind, Octets body, Message& about) {
  const std::size_t octets = body.size() + 4;
  switch (kind) {
    case kInfoDestination:
      if (body.size() >= 12) std::copy_n(body.begin(), 12, about.destination.begin());
      return;
    case kData:
    case kDataFragment: {
      if (body.size() < 20) return;
      const Octets entity = body.subspan(8, 4);
      Endpoint writer{};
      std::copy(about.source.begin(), about.source.end(), writer.begin());
      std::copy(entity.begin(), entity.end(), writer.begin() + 12);
      const std::uint64_t sequence =
          (static_cast<std::uint64_t>(number(body, 12, 4)) << 32U) | number(body, 16, 4);
      const bool again = !sent_.emplace(writer, sequence, about.address).second;
      if (std::ranges::equal(entity, kPublicationsWriter)) learn(body);
      add(topic_of(about.source, entity), again ? "data again" : "data", octets, about);
      return;
    }
    case kHeartbeat:
    case kHeartbeatFragment:
    case kGap:
      if (body.size() < 8) return;
      add(topic_of(about.source, body.subspan(4, 4)), kind == kGap ? "gap" : "heartbeat", octets,
          about);
      return;
    case kAcknack:
    case kNackFragment:
      if (body.size() < 8) return;
      add(topic_of(about.destination, body.subspan(4, 4)), "acknack", octets, about);
      return;
    default:
      return;
  }
}

void RtpsTally::learn(Octets data) {
  std::size_t at = 4U + number(data, 2, 2) + 4U;  // past the inline QoS offset and encapsulation
  Endpoint endpoint{};
  std::string topic;
  while (at + 4 <= data.size()) {
    const auto parameter = static_cast<std::uint16_t>(number(data, at, 2));
    const std::size_t length = number(data, at + 2, 2);
    at += 4;
    if (parameter == kSentinel || at + length > data.size()) break;
    if (parameter == kEndpointGuid && length >= 16)
      std::copy_n(data.begin() + static_cast<std::ptrdiff_t>(at), 16, endpoint.begin());
    if (parameter == kTopicName && length > 4) {
      const std::size_t size = std::min<std::size_t>(number(data, at, 4), length - 4);
      topic.assign(data.begin() + static_cast<std::ptrdiff_t>(at + 4),
                   data.begin() + static_cast<std::ptrdiff_t>(at + 4 + size));
      while (!topic.empty() && topic.back() == '\0') topic.pop_back();
    }
    at += length;
  }
  if (!topic.empty()) topics_[endpoint] = topic;
}

std::string_view RtpsTally::topic_of(const Prefix& prefix, Octets entity) const {
  if (is_builtin(entity)) return "discovery";
  Endpoint endpoint{};
  std::copy(prefix.begin(), prefix.end(), endpoint.begin());
  std::copy(entity.begin(), entity.end(), endpoint.begin() + 12);
  const auto known = topics_.find(endpoint);
  return known == topics_.end() ? std::string_view("unknown topic") : known->second;
}

void RtpsTally::add(std::string_view topic, std::string_view kind, std::size_t octets,
                    Message& about) {
  if (!about.counts) return;
  std::string name(topic);
  name.append(", ").append(kind);
  octets_[name] += octets;
  about.unowned -= std::min(about.unowned, octets);
  if (about.first.empty()) about.first = std::move(name);
}

}  // namespace lifeline::bench
