#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "agents/agent_settings.hpp"
#include "common/base/result.hpp"
#include "common/base/time.hpp"

namespace lifeline::bench {

/// What one way of sharing cost.
struct SharingCost {
  std::size_t tiles = 0, revisions = 0;
  double final_octets = 0.0;   ///< payloads of the tiles as they stood at the end
  double all_octets = 0.0;     ///< all tile samples of the walk, envelopes included
  double on_air_octets = 0.0;  ///< the same with headers of IP, UDP and RTPS, for each receiver
  double lacked_m2_s = 0.0;    ///< area that others did not know yet, times how long
  /// The same for each rival: final payloads, and all revisions in the same samples.
  std::map<std::string, std::pair<double, double>> rivals;
};

struct CodecWalk {
  double known_m2 = 0.0;
  double lasted_s = 0.0;
  SharingCost coarse, fine;                  ///< fine: the same but for sharing.coarse_tiles
  std::vector<double> encode_ms, decode_ms;  ///< one coarse tile, one thread
};

/// Plays a source through a helmet's mapper, as fast as it goes, and publishes what it maps over a
/// link that loses nothing, by the time of the scans. An error: the source's.
[[nodiscard]] Result<CodecWalk> play_codec_walk(const std::string& source,
                                                const AgentSettings& settings);

}  // namespace lifeline::bench
