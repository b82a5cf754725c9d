#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "common/base/result.hpp"

namespace lifeline::dds {

/// What a QoS profile file asks of the machine.
struct ProfileFacts {
  bool udp = false;                      ///< goes over the network, or the loopback interface
  bool shared_memory = false;            ///< goes through /dev/shm
  std::uint32_t segment_octets = 0;      ///< of shared memory, for each participant
  std::vector<std::string> interfaces;   ///< addresses or names it keeps to; empty: all
  std::uint32_t send_buffer_octets = 0;  ///< asked of the kernel; 0: its default
  std::uint32_t receive_buffer_octets = 0;
  std::uint32_t max_message_octets = 0;  ///< largest UDP payload
  bool multicast_discovery = false;      ///< finds others by 239.255.0.1
  std::vector<std::string> peers;        ///< addresses that it calls to find others
  std::uint32_t peers_range = 0;         ///< participants of one machine that are found by that
};

/// What a mission's profiles (mission_profiles()) in `file` ask for. Nothing is opened. Errors as
/// of Participant::create, each one line.
[[nodiscard]] Result<ProfileFacts> read_profile_facts(const std::filesystem::path& file);

}  // namespace lifeline::dds
