#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <mutex>
#include <optional>
#include <span>

#include "common/base/time.hpp"

namespace lifeline::dds {

/// Spaces out the ACKNACKs by which a reader asks a writer that has not said anything yet. Fast DDS
/// 2.9 repeats them every 70 ms for each reader and each writer until a heartbeat comes: on a link
/// that is too narrow they crowd out the very announcements that would end them (decision 0115).
/// Those of the first two seconds go as they come, since
/// any may be lost; then the pauses grow by half each time, from 0.2 s to 0.5 s. Thread-safe.
class FirstAckNacks {
 public:
  /// Whether an RTPS message may go now. Always, unless it holds such an ACKNACK and nothing else.
  [[nodiscard]] bool may_send(std::span<const std::uint8_t> message, SteadyTime now);

 private:
  /// Participant asked, reader and writer, as they stand in the message.
  using Question = std::array<std::uint8_t, 20>;
  struct Asked {
    SteadyTime begun_at{};
    SteadyTime tried_at{};
    SteadyTime next_at{};
    Duration pause{};
  };

  [[nodiscard]] static std::optional<Question> question_in(std::span<const std::uint8_t> message);
  void forget_ended(SteadyTime now);

  std::mutex mutex_;
  std::map<Question, Asked> asked_;
  SteadyTime forgot_at_{};
};

}  // namespace lifeline::dds
