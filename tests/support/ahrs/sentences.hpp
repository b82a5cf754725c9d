#pragma once

#include <array>
#include <functional>
#include <string>
#include <string_view>

#include "agents/sensing/raw_scan.hpp"

/// What attitude sensors send, made from an attitude in our axes without the decoders' code.
namespace lifeline::test {

/// A head's attitude at a time in seconds.
using HeadAt = std::function<sensing::Attitude(double)>;

/// What the sensor counts: against north, east and down, x forward, y right, z down.
struct NedState {
  double yaw_deg = 0.0, pitch_deg = 0.0, roll_deg = 0.0;
  std::array<double, 3> rate_rad_s{};  ///< about its own axes
};
[[nodiscard]] NedState ned_state(const HeadAt& head, double t_s);

enum class Checksum { exclusive_or, crc16 };

/// `$BODY*SUM`, without the line's end.
[[nodiscard]] std::string with_checksum(std::string_view body, Checksum kind);
/// $VNYMR; the rates are multiplied by `rate_scale`.
[[nodiscard]] std::string vnymr(const NedState& state, Checksum kind, double rate_scale = 1.0);
/// A line of an AHRS-8's stream, rates in deg/s times `rate_scale`.
[[nodiscard]] std::string ahrs8_line(const NedState& state, unsigned ms, double rate_scale = 1.0);

}  // namespace lifeline::test
