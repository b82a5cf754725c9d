#include "common/sharing/pose_watch.hpp"

#include <utility>

#include "common/sharing/roster.hpp"

namespace lifeline::sharing {

bool PoseWatch::hear(const wire::HelmetPose& pose, SteadyTime now) {
  auto found = entries_.find(pose.agent_id);
  const auto& heard = pose.envelope;
  if (found == entries_.end()) {
    if (entries_.size() >= Roster::kMaxEntries) return false;
    entries_.emplace(pose.agent_id, Entry{pose, now, 0.0, heard.sequence, 1});
    return true;
  }
  Entry& entry = found->second;
  if (entry.pose.envelope.incarnation != heard.incarnation) {
    entry = {pose, now, 0.0, heard.sequence, 1};
    return true;
  }
  if (heard.sequence <= entry.pose.envelope.sequence) return false;
  entry.pose = pose;
  entry.heard_at = now;
  ++entry.window_heard;
  const std::uint64_t sent = heard.sequence - entry.window_begin + 1;
  if (sent >= kWindow) {
    entry.loss = 1.0 - static_cast<double>(entry.window_heard) / static_cast<double>(sent);
    entry.window_begin = heard.sequence + 1;
    entry.window_heard = 0;
  }
  return true;
}

const PoseWatch::Entry* PoseWatch::find(const std::string& agent_id) const {
  const auto found = entries_.find(agent_id);
  return found == entries_.end() ? nullptr : &found->second;
}

}  // namespace lifeline::sharing
