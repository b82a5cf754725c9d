#include "agents/sharing/mission_join.hpp"

#include <algorithm>

#include "common/base/log.hpp"
#include "common/sharing/accept.hpp"

namespace lifeline::sharing {
namespace {

constexpr Duration kAnnounceInterval = std::chrono::milliseconds(300);
// No helmet restarts a million times: a larger number is a broken or hostile status.
constexpr std::uint32_t kMaxMapNumber = 1'000'000;

}  // namespace

MissionJoin::MissionJoin(Speaker speaker, Floor floor, Duration listen,
                         wire::Outbox<wire::AgentStatus>& outbox,
                         wire::Inbox<wire::AgentStatus>& inbox, const Clock& clock)
    : speaker_(std::move(speaker)),
      floor_(floor),
      listen_(listen),
      outbox_(outbox),
      inbox_(inbox),
      clock_(clock),
      stamper_(speaker_),
      started_(clock.steady_now()) {}

std::optional<Result<MapId>> MissionJoin::step() {
  const SteadyTime now = clock_.steady_now();
  for (const auto& status : inbox_.take()) {
    if (!check_envelope(status.envelope, speaker_.mission_id)) continue;
    learn_map_numbers(status);
    if (is_taken_by(status)) {
      announce();  // so that the other one can tell its people too
      return fail(ErrorCode::unavailable,
                  "another helmet calls itself {} already; give this one another --id",
                  speaker_.id.text());
    }
  }
  // After listening: our own status, heard back, replaces another's under the same key.
  if (now >= announce_due_) {
    announce_due_ = now + kAnnounceInterval;
    announce();
  }
  if (now - started_ < listen_) return std::nullopt;
  return MapId{last_map_ + 1};
}

void MissionJoin::announce() {
  wire::AgentStatus status;
  status.envelope = stamper_.next(clock_.wall_now());
  ++announced_;
  status.agent_id = speaker_.id.text();
  status.state = wire::AgentState::starting;
  status.floor = floor_.value;
  if (auto sent = outbox_.put(status); !sent) spdlog::warn("{}", sent.error().text);
}

bool MissionJoin::is_taken_by(const wire::AgentStatus& status) {
  if (status.agent_id != speaker_.id.text() ||
      status.envelope.incarnation == speaker_.incarnation.value) {
    return false;
  }
  const bool starting_too = status.state == wire::AgentState::starting;
  return !starting_too || status.envelope.incarnation < speaker_.incarnation.value;
}

void MissionJoin::learn_map_numbers(const wire::AgentStatus& status) {
  for (const auto& held : status.layers) {
    if (held.layer.agent_id == speaker_.id.text() && held.layer.map_id < kMaxMapNumber) {
      last_map_ = std::max(last_map_, held.layer.map_id);
    }
  }
}

}  // namespace lifeline::sharing
