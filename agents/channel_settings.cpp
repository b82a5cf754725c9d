#include "agents/channel_settings.hpp"

#include "agents/interface_counter.hpp"
#include "common/dds/open_channel.hpp"

namespace lifeline {

Result<sharing::HelmetChannels> open_channels(dds::Participant& participant,
                                              const std::string& interface, bool sees_mates) {
  sharing::HelmetChannels channels;
  Result<void> all;
  dds::open_outbox(participant, channels.pose, all);
  dds::open_outbox(participant, channels.scan, all);
  dds::open_outbox(participant, channels.tile, all);
  dds::open_outbox(participant, channels.status, all);
  dds::open_outbox(participant, channels.detection, all);
  dds::open_inbox(participant, channels.tiles, all);
  dds::open_inbox(participant, channels.directives, all);
  dds::open_inbox(participant, channels.statuses, all);
  dds::open_inbox(participant, channels.detections, all);
  dds::open_inbox(participant, channels.alerts, all);
  dds::open_outbox(participant, channels.alert, all);
  if (sees_mates) dds::open_inbox(participant, channels.poses, all);
  dds::open_exchange(participant, channels.exchange, all);
  dds::open_outbox(participant, channels.relay.tell, all);
  dds::open_inbox(participant, channels.relay.told, all);
  if (!all) return forward_error(all);
  channels.bytes_sent = [&participant] { return participant.bytes_sent(); };
  channels.octets_on_air = [&participant] { return participant.octets_on_air(); };
  if (interface != "none") {
    auto counter = interface_counter(interface);
    if (!counter) return forward_error(counter);
    channels.octets_on_air = *std::move(counter);
  }
  return channels;
}

}  // namespace lifeline
