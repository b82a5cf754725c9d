#include "common/dds/profile_facts.hpp"

#include <algorithm>
#include <memory>

#include <fastdds/rtps/transport/UDPv4TransportDescriptor.h>
#include <fastdds/rtps/transport/shared_mem/SharedMemTransportDescriptor.h>
#include <fastrtps/utils/IPLocator.h>

#include "common/dds/fastdds_version.hpp"
#include "common/dds/qos_profiles.hpp"

namespace lifeline::dds {
namespace {

using eprosima::fastdds::rtps::SharedMemTransportDescriptor;
using eprosima::fastdds::rtps::UDPTransportDescriptor;
using eprosima::fastrtps::rtps::IPLocator;

constexpr std::uint32_t kDefaultSegment = 512 * 1024;  // Fast DDS, where nothing is said

void add_transport(ProfileFacts& facts, const UDPTransportDescriptor& udp) {
  facts.udp = true;
  facts.interfaces = udp.interfaceWhiteList;
  facts.send_buffer_octets = udp.sendBufferSize;
  facts.receive_buffer_octets = udp.receiveBufferSize;
  facts.max_message_octets = udp.max_message_size();
  facts.peers_range = udp.max_initial_peers_range();
}

void add_transport(ProfileFacts& facts, const SharedMemTransportDescriptor& memory) {
  facts.shared_memory = true;
  facts.segment_octets = memory.segment_size() > 0 ? memory.segment_size() : kDefaultSegment;
}

void add_transports(ProfileFacts& facts, const fast::TransportConfigQos& transports) {
  if (transports.use_builtin_transports) {
    add_transport(facts, eprosima::fastdds::rtps::UDPv4TransportDescriptor());
    add_transport(facts, SharedMemTransportDescriptor());
  }
  for (const auto& transport : transports.user_transports) {
    if (const auto* udp = dynamic_cast<const UDPTransportDescriptor*>(transport.get()))
      add_transport(facts, *udp);
    if (const auto* memory = dynamic_cast<const SharedMemTransportDescriptor*>(transport.get()))
      add_transport(facts, *memory);
  }
}

void add_discovery(ProfileFacts& facts, const rtps::BuiltinAttributes& builtin) {
  bool calls_multicast = builtin.initialPeersList.empty();
  for (const auto& peer : builtin.initialPeersList) {
    if (IPLocator::isMulticast(peer)) {
      calls_multicast = true;
    } else {
      facts.peers.push_back(IPLocator::ip_to_string(peer));
    }
  }
  const bool hears_multicast = builtin.metatrafficUnicastLocatorList.empty() ||
                               !builtin.metatrafficMulticastLocatorList.empty();
  facts.multicast_discovery = facts.udp && calls_multicast && hears_multicast;
}

}  // namespace

Result<ProfileFacts> read_profile_facts(const std::filesystem::path& file) {
  route_middleware_log();
  const std::lock_guard lock(profiles_mutex());
  const LogCapture capture;
  const ProfileNames& names = mission_profiles();
  if (auto loaded = load_qos_profiles(file, names, capture); !loaded) return forward_error(loaded);
  fast::DomainParticipantQos qos;
  const auto code =
      fast::DomainParticipantFactory::get_instance()->get_participant_qos_from_profile(
          names.participant, qos);
  if (!is_ok(code)) {
    return fail(ErrorCode::bad_data, "{}: participant profile '{}': {}", file.string(),
                names.participant, describe(code));
  }
  ProfileFacts facts;
  add_transports(facts, qos.transport());
  add_discovery(facts, qos.wire_protocol().builtin);
  return facts;
}

}  // namespace lifeline::dds
