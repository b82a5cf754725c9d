#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "common/base/result.hpp"
#include "common/sharing/envelope_stamper.hpp"
#include "common/wire/channel.hpp"

namespace lifeline::sharing {

/// A helmet's first seconds in a mission: it says who it is, listens whether its id is taken, and
/// learns from what others hold which map numbers it used before (a reboot starts a new map; the
/// old layer keeps its place). A state machine: step() until it answers. One owner, not
/// thread-safe.
class MissionJoin {
 public:
  MissionJoin(Speaker speaker, Floor floor, Duration listen,
              wire::Outbox<wire::AgentStatus>& outbox, wire::Inbox<wire::AgentStatus>& inbox,
              const Clock& clock);

  /// Empty while listening; then the number of the new map, or why this helmet must not start: its
  /// id is in use. Of two that start at once under one id, the one with the smaller incarnation
  /// stays.
  [[nodiscard]] std::optional<Result<MapId>> step();
  /// Statuses sent: whoever speaks on counts from here.
  [[nodiscard]] std::uint64_t announced() const { return announced_; }

 private:
  void announce();
  [[nodiscard]] bool is_taken_by(const wire::AgentStatus& status);
  void learn_map_numbers(const wire::AgentStatus& status);

  Speaker speaker_;
  Floor floor_;
  Duration listen_;
  wire::Outbox<wire::AgentStatus>& outbox_;
  wire::Inbox<wire::AgentStatus>& inbox_;
  const Clock& clock_;
  EnvelopeStamper stamper_;
  SteadyTime started_;
  SteadyTime announce_due_{};
  std::uint32_t last_map_ = 0;
  std::uint64_t announced_ = 0;
};

}  // namespace lifeline::sharing
