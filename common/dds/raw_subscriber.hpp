#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "common/base/result.hpp"
#include "common/dds/participant.hpp"

namespace lifeline::dds {

/// A topic of somebody else's system, whose messages are taken as they come.
struct RawTopic {
  std::string name;             ///< as DDS has it, e.g. `rt/scan`
  std::string type;             ///< as DDS has it; without key
  std::string profile;          ///< the subscriber's profile in the QoS file
  std::uint32_t max_bytes = 0;  ///< a larger message is dropped before memory is taken for it
};

/// Which writer a message came from, whatever that is; another one after its restart.
using PublisherId = std::array<std::uint8_t, 16>;

/// One message, from bytes that may be anything: an encapsulation header, then CDR.
struct RawSample {
  std::vector<std::uint8_t> bytes;
  PublisherId publisher{};
};

/// What is known of the publishers of a topic at the moment.
struct RawTopicState {
  std::size_t matched = 0;           ///< heard
  std::size_t announced = 0;         ///< of the topic's type, heard or not
  std::string foreign_type;          ///< of one that publishes another type; empty where none does
  std::uint32_t refused_policy = 0;  ///< the QoS policy, by its number in DDS, that kept one away
};

/// A seat in a domain of its own, whose only end is to hear some topics of others. All QoS stands
/// in the file, under the profiles named.
class RawSubscriber {
 public:
  /// `options.qos_profiles` must hold `participant_profile` and each topic's profile. Errors as
  /// Participant::create() has them. At least one topic, and no two of the same name.
  [[nodiscard]] static Result<std::unique_ptr<RawSubscriber>> open(
      const ParticipantOptions& options, const std::string& participant_profile,
      std::vector<RawTopic> topics);

  virtual ~RawSubscriber() = default;

  /// Sleeps until a message arrives, at most `timeout`; as Participant::wait_for_data().
  virtual bool wait_for_data(Duration timeout) = 0;
  /// Ends wait_for_data() from any thread.
  virtual void wake() = 0;
  /// What has arrived of the topic with that place in `topics`, oldest first. One thread.
  [[nodiscard]] virtual std::vector<RawSample> take(std::size_t topic) = 0;
  [[nodiscard]] virtual RawTopicState state(std::size_t topic) const = 0;
};

}  // namespace lifeline::dds
