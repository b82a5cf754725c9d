#include "tests/support/ahrs/sentences.hpp"

#include <cmath>
#include <cstdint>
#include <numbers>

#include <fmt/format.h>

#include "common/base/angles.hpp"

namespace lifeline::test {
namespace {

double wrapped_deg(double angle_deg) {
  return std::remainder(angle_deg, 360.0);
}

/// A table-driven CRC-16 as the protocol's description has it, byte by byte.
unsigned crc16(std::string_view text) {
  std::uint16_t crc = 0;
  for (const char c : text) {
    crc = static_cast<std::uint16_t>((crc >> 8) | (crc << 8));
    crc = static_cast<std::uint16_t>(crc ^ static_cast<std::uint8_t>(c));
    crc = static_cast<std::uint16_t>(crc ^ ((crc & 0xFF) >> 4));
    crc = static_cast<std::uint16_t>(crc ^ (crc << 12));
    crc = static_cast<std::uint16_t>(crc ^ ((crc & 0xFF) << 5));
  }
  return crc;
}

}  // namespace

NedState ned_state(const HeadAt& head, double t_s) {
  const sensing::Attitude now = head(t_s);
  constexpr double kStepS = 1e-3;
  const sensing::Attitude before = head(t_s - kStepS), after = head(t_s + kStepS);
  const double roll = now.roll_rad, pitch = -now.pitch_rad;
  const double roll_rate = (after.roll_rad - before.roll_rad) / (2.0 * kStepS);
  const double pitch_rate = -(after.pitch_rad - before.pitch_rad) / (2.0 * kStepS);
  const double yaw_rate =
      -std::remainder(after.yaw_rad - before.yaw_rad, 2.0 * std::numbers::pi) / (2.0 * kStepS);
  NedState state{wrapped_deg(90.0 - now.yaw_rad / kDegree), pitch / kDegree, roll / kDegree, {}};
  // From the rates of the angles to those about the axes.
  state.rate_rad_s = {roll_rate - std::sin(pitch) * yaw_rate,
                      std::cos(roll) * pitch_rate + std::sin(roll) * std::cos(pitch) * yaw_rate,
                      -std::sin(roll) * pitch_rate + std::cos(roll) * std::cos(pitch) * yaw_rate};
  return state;
}

std::string with_checksum(std::string_view body, Checksum kind) {
  if (kind == Checksum::crc16) return fmt::format("${}*{:04X}", body, crc16(body));
  unsigned sum = 0;
  for (const char c : body) sum ^= static_cast<std::uint8_t>(c);
  return fmt::format("${}*{:02X}", body, sum);
}

std::string vnymr(const NedState& state, Checksum kind, double rate_scale) {
  const auto& rate = state.rate_rad_s;
  return with_checksum(
      fmt::format("VNYMR,{:+08.3f},{:+08.3f},{:+08.3f},+00.1850,+00.0403,+00.1417,+00.324,-00.406,"
                  "-09.681,{:+010.6f},{:+010.6f},{:+010.6f}",
                  state.yaw_deg, state.pitch_deg, state.roll_deg, rate_scale * rate[0],
                  rate_scale * rate[1], rate_scale * rate[2]),
      kind);
}

std::string ahrs8_line(const NedState& state, unsigned ms, double rate_scale) {
  const double y = 0.5 * kDegree * state.yaw_deg, p = 0.5 * kDegree * state.pitch_deg,
               r = 0.5 * kDegree * state.roll_deg;
  const double cy = std::cos(y), sy = std::sin(y), cp = std::cos(p), sp = std::sin(p),
               cr = std::cos(r), sr = std::sin(r);
  const double scale = rate_scale / kDegree;
  const auto& rate = state.rate_rad_s;
  return fmt::format(
      "P:,{},ap,-6.34,-22.46,1011.71,gp,{:.4f},{:.4f},{:.4f},q,{:.6f},{:.6f},{:.6f},{:.6f}", ms,
      scale * rate[0], scale * rate[1], scale * rate[2], cr * cp * cy + sr * sp * sy,
      sr * cp * cy - cr * sp * sy, cr * sp * cy + sr * cp * sy, cr * cp * sy - sr * sp * cy);
}

}  // namespace lifeline::test
