#pragma once

#include <optional>

#include "agents/helmet_mapper.hpp"
#include "agents/sharing/helmet_sharing.hpp"
#include "common/base/result.hpp"
#include "common/store/state_file.hpp"

namespace lifeline {

/// A start takes revisions out of a range of its own, so that none is ever given twice, whatever of
/// the starts before reached the disk: 2^24 for each tile are nine days at twenty a second.
inline constexpr std::uint64_t kRevisionsPerStart = std::uint64_t{1} << 24;

/// What a helmet goes on from.
struct HelmetMemory {
  std::uint32_t last_map = 0;          ///< the largest number its maps have had
  std::optional<MapId> map;            ///< the map to go on in; nothing: a new one begins
  std::optional<MapperMemory> mapper;  ///< where the map holds something
  sharing::SharingMemory sharing;
};

/// When a state was opened, and by which of its starts.
struct StartedAt {
  std::uint32_t start_number = 1;
  Timestamp opened_at{};
};

/// Reads the records of a state. On another floor than before a new map begins; what was shared is
/// kept. bad_data where they contradict each other: then nothing of them is to be used.
[[nodiscard]] Result<HelmetMemory> read_helmet_memory(const store::Records& records,
                                                      const StartedAt& start,
                                                      const store::StateIdentity& identity,
                                                      Floor floor);

// Keys of the records, for whoever writes them.
inline constexpr const char* kProgressKey = "helmet";
inline constexpr const char* kPlaceKey = "place";
inline constexpr const char* kLayerPrefix = "layer";
inline constexpr const char* kPathPrefix = "path/";
inline constexpr std::size_t kPosesPerPiece = 256;

}  // namespace lifeline
