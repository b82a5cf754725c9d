#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "common/base/result.hpp"
#include "common/dds/participant.hpp"

namespace lifeline::dds {

/// A topic of somebody else's system that we write, in messages that are serialised already.
struct RawOutput {
  std::string name;     ///< as DDS has it, e.g. `rt/tf`
  std::string type;     ///< as DDS has it; without key
  std::string profile;  ///< the publisher's profile in the QoS file
};

/// A seat in a domain of its own, whose only end is to write some topics of others. All QoS stands
/// in the file, under the profiles named. One thread.
class RawPublisher {
 public:
  /// `options.qos_profiles` must hold `participant_profile` and all of `profiles`. Errors as
  /// Participant::create() has them.
  [[nodiscard]] static Result<std::unique_ptr<RawPublisher>> open(
      const ParticipantOptions& options, const std::string& participant_profile,
      std::vector<std::string> profiles);

  virtual ~RawPublisher() = default;

  /// Writes a message: an encapsulation header, then CDR. The first of a topic opens it. Never
  /// waits for the network. unavailable where the middleware refuses.
  [[nodiscard]] virtual Result<void> put(const RawOutput& topic,
                                         std::span<const std::uint8_t> cdr) = 0;
};

}  // namespace lifeline::dds
