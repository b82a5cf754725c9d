#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "common/base/time.hpp"

namespace lifeline::dashboard {

/// Where in a recording the page is: nothing of it is live.
struct Timeline {
  Timestamp begin{};  ///< when the recording began, by its recorder's clock
  Duration length{};
  Duration at{};
  double speed = 1.0;  ///< times as fast as it was; 0: as fast as it goes
  bool is_paused = false;
  bool is_seeking = false;       ///< on the way to a time that was asked for
  bool is_mission_live = false;  ///< it is being recorded just now
};

/// What somebody at a page wants of a recording.
struct Steer {
  bool is_paused = false;
  double speed = 1.0;          ///< as in Timeline
  std::optional<Duration> to;  ///< go there
};

/// A page is to be live again.
struct GoLive {};

inline constexpr double kMostSpeed = 1000.0;

/// A ServerFrame of idl/dashboard.proto. `beat` differs from frame to frame, so that a page hears
/// something while a recording stands still.
[[nodiscard]] std::string timeline_frame(const Timeline& timeline, std::uint32_t beat);
/// As above: what follows is live. `why` for people; empty where it was asked for.
[[nodiscard]] std::string live_frame(const std::string& why);

}  // namespace lifeline::dashboard
