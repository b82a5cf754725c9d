// What a helmet takes in from the others.
#include <algorithm>

#include "agents/sharing/helmet_sharing.hpp"
#include "common/base/log.hpp"
#include "common/sharing/accept.hpp"
#include "common/sharing/hear.hpp"

namespace lifeline::sharing {

void HelmetSharing::hear_statuses(SteadyTime now) {
  for (const auto& status : channels_.statuses->take()) {
    if (auto accepted = check_envelope(status.envelope, config_.speaker.mission_id); !accepted) {
      notes_.refusals.note("agent_status", accepted.error());
      continue;
    }
    const bool own_id = status.agent_id == config_.speaker.id.text();
    if (own_id && status.envelope.incarnation != config_.speaker.incarnation.value) {
      if (!contested_) {
        spdlog::error("another helmet calls itself {} too; rename one of them", status.agent_id);
      }
      contested_ = true;
    }
    if (!own_id) roster_.hear(status, now);
  }
}

void HelmetSharing::hear_directives() {
  for (const auto& directive : channels_.directives->take()) {
    auto accepted = check_envelope(directive.envelope, config_.speaker.mission_id);
    if (!accepted) {
      notes_.refusals.note("merge_directive", accepted.error());
      continue;
    }
    follow(directive, "merge_directive");
  }
}

void HelmetSharing::hear_told_directives(SteadyTime now) {
  hear(channels_.relay.told->take(), "directive_copy", config_.speaker.mission_id, now, notes_,
       [&](const wire::DirectiveCopy& copy) -> Result<void> {
         const auto taken = relay_.may_follow(copy, now, roster_, map_.directive());
         if (!taken) return forward_error(taken);
         if (*taken) follow(copy.directive, "directive_copy");
         return {};
       });
}

void HelmetSharing::follow(const wire::MergeDirective& directive, std::string_view topic) {
  if (auto followed = map_.follow(directive); !followed) {
    notes_.refusals.note(topic, followed.error());
  } else if (*followed) {
    detections_.follow(directive);
    spdlog::info("follows directive {}: {} helmets in the common map ({})", directive.epoch,
                 map_.common_map().placements().size(), topic);
  }
}

void HelmetSharing::hear_tiles(SteadyTime now) {
  auto samples = channels_.tiles->take();
  std::erase_if(samples, [&](const wire::TsdTile& sample) {  // our own, come back
    return is_own_map(sample.layer.agent_id, sample.layer.map_id);
  });
  hear(samples, "tsd_tile", config_.speaker.mission_id, now, notes_,
       [&](const wire::TsdTile& sample) { return map_.store().apply(sample); });
}

void HelmetSharing::hear_detections(SteadyTime now) {
  auto samples = channels_.detections->take();
  std::erase_if(samples, [&](const wire::Detection& sample) {  // our own, come back
    return sample.envelope.sender_id == config_.speaker.id.text() &&
           is_own_map(sample.agent_id, sample.map_id);
  });
  hear(samples, "detection", config_.speaker.mission_id, now, notes_,
       [&](const wire::Detection& sample) { return detections_.apply(sample); });
}

bool HelmetSharing::is_own_map(const std::string& agent_id, std::uint32_t map_id) const {
  return agent_id == config_.speaker.id.text() && map_id == config_.layer.map_id.value;
}

void HelmetSharing::hear_poses(SteadyTime now) {
  if (channels_.poses == nullptr) return;
  for (const auto& pose : channels_.poses->take()) {
    if (pose.envelope.sender_id == config_.speaker.id.text()) continue;  // our own, come back
    if (auto sound = check_pose(pose, config_.speaker.mission_id); !sound) {
      notes_.refusals.note("pose", sound.error());
      continue;
    }
    poses_.hear(pose, now);
  }
}

}  // namespace lifeline::sharing
