#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "common/base/time.hpp"
#include "common/dds/raw_subscriber.hpp"

namespace lifeline::sources {

/// Why nothing of use comes by a topic.
enum class TopicFault {
  none,
  unpublished,   ///< nobody announces it
  foreign_type,  ///< it is announced with another type
  foreign_qos,   ///< its publisher's QoS does not fit
  silent,        ///< there is a publisher, which says nothing
  unusable,      ///< messages come, and none can be used
};

/// Follows one topic of a ROS 2 driver: whose messages are taken, and what is wrong. Logs each
/// change in one line. One owner.
///
/// Of several publishers only one is taken, until it has been silent for kSilentAfter: the scans of
/// two lidars in one stream would be ruinous.
class TopicWatch {
 public:
  static constexpr Duration kSilentAfter = std::chrono::seconds(1);
  /// Until then, DDS may not have found a publisher that is there.
  static constexpr Duration kDiscovery = std::chrono::seconds(3);

  /// `topic` as ROS has it, `type` as DDS has it. `now`: when the topic was subscribed.
  TopicWatch(std::string topic, std::string type, std::uint32_t domain, SteadyTime now);

  /// A message came. False: it is not to be taken, somebody else is being followed.
  [[nodiscard]] bool takes(const dds::PublisherId& publisher, SteadyTime now);
  /// What was taken could be used, or not and why.
  void note_good(SteadyTime now);
  void note_bad(std::string_view why, SteadyTime now);

  /// Looks whether something is wrong or has been mended, and says so. Often: a few times a second.
  void look(const dds::RawTopicState& state, SteadyTime now);

  [[nodiscard]] TopicFault fault() const { return fault_; }
  [[nodiscard]] std::uint64_t good() const { return good_; }
  [[nodiscard]] std::uint64_t bad() const { return bad_; }
  /// The last message that could be used; empty before the first.
  [[nodiscard]] std::optional<SteadyTime> last_good() const { return last_good_; }
  [[nodiscard]] std::optional<SteadyTime> last_bad() const { return last_bad_; }

 private:
  [[nodiscard]] TopicFault find_fault(const dds::RawTopicState& state, SteadyTime now) const;
  [[nodiscard]] std::string fault_text(TopicFault fault, const dds::RawTopicState& state) const;

  const std::string topic_;
  const std::string type_;
  const std::uint32_t domain_;
  const SteadyTime since_;
  std::optional<dds::PublisherId> followed_;
  SteadyTime followed_spoke_{};
  bool told_of_others_ = false;
  bool had_publisher_ = false;
  std::uint64_t good_ = 0;
  std::uint64_t bad_ = 0;
  std::optional<SteadyTime> last_good_;
  std::optional<SteadyTime> last_bad_;
  std::string why_bad_;
  TopicFault fault_ = TopicFault::none;
};

}  // namespace lifeline::sources
