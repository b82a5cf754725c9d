#include "coordinator/dashboard/timeline.hpp"

#include "coordinator/dashboard/readable.hpp"
#include "idl/dashboard.pb.h"

namespace lifeline::dashboard {

std::string timeline_frame(const Timeline& timeline, std::uint32_t beat) {
  proto::dashboard::ServerFrame frame;
  auto& told = *frame.mutable_timeline();
  told.set_begin_unix_s(to_seconds(timeline.begin.time_since_epoch()));
  told.set_length_s(to_seconds(timeline.length));
  told.set_at_s(to_seconds(timeline.at));
  told.set_speed(timeline.speed);
  told.set_is_paused(timeline.is_paused);
  told.set_is_seeking(timeline.is_seeking);
  told.set_beat(beat);
  told.set_is_mission_live(timeline.is_mission_live);
  return frame.SerializeAsString();
}

std::string live_frame(const std::string& why) {
  proto::dashboard::ServerFrame frame;
  frame.mutable_live()->set_why(readable(why));
  return frame.SerializeAsString();
}

}  // namespace lifeline::dashboard
