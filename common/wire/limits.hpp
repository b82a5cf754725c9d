#pragma once

#include <cstddef>

namespace lifeline::wire {

// The bounds of idl/*.idl. A golden test compares both.
inline constexpr std::size_t kMaxIdLength = 32;
inline constexpr std::size_t kMaxMissionIdLength = 32;
inline constexpr std::size_t kMaxSignature = 64;
inline constexpr std::size_t kMaxScanBeams = 640;
inline constexpr std::size_t kMaxTilePart = 1000;
inline constexpr std::size_t kMaxTilesPerRequest = 48;
inline constexpr std::size_t kMaxMembers = 64;
inline constexpr std::size_t kMaxCandidates = 16;
inline constexpr std::size_t kMaxReason = 256;
inline constexpr std::size_t kMaxLayers = 64;
inline constexpr std::size_t kMaxPeers = 64;
inline constexpr std::size_t kMaxAlertText = 128;

// A tile's payload, of all parts together.
inline constexpr std::size_t kMaxTilePayload = 8192;
inline constexpr std::size_t kMaxTileParts = (kMaxTilePayload + kMaxTilePart - 1) / kMaxTilePart;

// About what a sample takes on the network besides its own octets: headers of IP, UDP and RTPS, and
// the time stamp.
inline constexpr std::size_t kOctetsAboutASample = 100;

}  // namespace lifeline::wire
