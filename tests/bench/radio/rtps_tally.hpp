#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <tuple>

namespace lifeline::bench {

/// Counts octets of RTPS messages by topic and kind of submessage. Which endpoint belongs to which
/// topic it learns from the discovery that it hears. What cannot be read counts as "other".
class RtpsTally {
 public:
  /// An Ethernet frame of IPv4 and UDP; others are counted as "other". Of one that does not count,
  /// only what it tells of topics is noted.
  void take(std::span<const std::uint8_t> frame, bool counts);

  [[nodiscard]] const std::map<std::string, std::uint64_t>& octets() const { return octets_; }

 private:
  using Octets = std::span<const std::uint8_t>;
  using Prefix = std::array<std::uint8_t, 12>;
  using Endpoint = std::array<std::uint8_t, 16>;

  struct Message {
    Prefix source{};
    Prefix destination{};  ///< of INFO_DST, all zero = everybody
    std::uint32_t address = 0;
    bool counts = false;
    std::string first;        ///< what its first submessage counted as
    std::size_t unowned = 0;  ///< octets of the frame that no submessage has taken yet
  };
  void take_message(Octets message, Message& about);
  void take_submessage(std::uint8_t kind, Octets body, Message& about);
  void learn(Octets data);
  void add(std::string_view topic, std::string_view kind, std::size_t octets, Message& about);
  [[nodiscard]] std::string_view topic_of(const Prefix& prefix, Octets entity) const;

  std::map<std::string, std::uint64_t> octets_;
  std::map<Endpoint, std::string> topics_;
  std::set<std::tuple<Endpoint, std::uint64_t, std::uint32_t>> sent_;
};

}  // namespace lifeline::bench
