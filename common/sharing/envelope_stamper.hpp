#pragma once

#include <cstdint>
#include <string>
#include <utility>

#include "common/base/ids.hpp"
#include "common/base/time.hpp"
#include "common/wire/messages.hpp"

namespace lifeline::sharing {

/// Who is speaking.
struct Speaker {
  AgentId id;
  std::string mission_id;
  Incarnation incarnation;
};

/// Fills the envelopes of one topic's samples: same speaker, growing sequence.
class EnvelopeStamper {
 public:
  /// `said`: samples that the speaker has sent before under this incarnation.
  explicit EnvelopeStamper(Speaker speaker, std::uint64_t said = 0)
      : speaker_(std::move(speaker)), sequence_(said) {}

  [[nodiscard]] wire::Envelope next(Timestamp now) {
    wire::Envelope envelope;
    envelope.mission_id = speaker_.mission_id;
    envelope.sender_id = speaker_.id.text();
    envelope.incarnation = speaker_.incarnation.value;
    envelope.sequence = ++sequence_;
    envelope.sent_at_ns = now.time_since_epoch().count();
    return envelope;
  }

 private:
  Speaker speaker_;
  std::uint64_t sequence_;
};

}  // namespace lifeline::sharing
