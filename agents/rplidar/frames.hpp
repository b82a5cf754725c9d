#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "agents/rplidar/protocol.hpp"

namespace lifeline::rplidar {

/// Angles are degrees in fixed point: q16 counts 1/65536 deg, q6 counts 1/64 deg. They grow
/// clockwise, seen from above, from the device's own zero.
constexpr std::int32_t kTurn_q16 = 360 << 16;
constexpr int kTurn_q6 = 360 << 6;

/// One distance reading, without its time.
struct Reading {
  std::int32_t angle_q16 = 0;           ///< in [0, one turn)
  std::int32_t step_q16 = 0;            ///< how far the rotor turns from reading to reading, here
  std::uint32_t distance_quarters = 0;  ///< 1/4 mm; 0 = nothing measured

  bool operator==(const Reading&) const = default;
};

constexpr std::size_t kMostReadings = 96;  ///< of one frame of any format

/// The readings of one frame.
struct Readings {
  std::array<Reading, kMostReadings> of{};
  std::size_t count = 0;

  [[nodiscard]] std::span<const Reading> span() const { return std::span(of).first(count); }
};

/// How a format cuts its stream into frames.
struct FrameFormat {
  std::size_t bytes = 0;
  std::size_t readings = 0;
  double max_distance_m = 0.0;  ///< the farthest that it can express
};

/// Nothing for types that hold no readings, or that this build does not decode (ultra capsules
/// without LIFELINE_RPLIDAR_ULTRA).
[[nodiscard]] std::optional<FrameFormat> frame_format(AnswerType type);

/// Whether these bytes are a frame of that format, as far as they tell by themselves: marks and
/// checksum (capsules), or the few marks that a standard node has. `frame` has the format's size.
[[nodiscard]] bool is_frame(AnswerType type, Bytes frame);

/// The readings of `frame`, given the frame that follows it without a gap: the angles of a capsule
/// lie between its own start angle and the next one's. Both must be is_frame().
///
/// Nothing where both do not go together: the scan began anew with `next`, or the rotor would have
/// turned farther than `most_turn_q16` in between.
[[nodiscard]] std::optional<Readings> decode_frame(AnswerType type, Bytes frame, Bytes next,
                                                   std::int32_t most_turn_q16);

}  // namespace lifeline::rplidar
