#include <algorithm>
#include <array>
#include <numbers>
#include <string_view>

#include <fmt/ranges.h>

#include "agents/ahrs/ahrs_source.hpp"
#include "agents/sensing/rotation.hpp"

namespace lifeline::ahrs {

Result<AhrsOptions> read_ahrs_options(const sources::SourceSpec& spec) {
  if (spec.kind != "ahrs") {
    return fail(ErrorCode::wrong_use,
                "attitude '{}:{}': unknown kind '{}'; there is: ahrs (ahrs:DEVICE?kind=vectornav)",
                spec.kind, spec.target, spec.kind);
  }
  // Not allow_options(), which also offers the rate that scans have.
  constexpr std::array<std::string_view, 5> kKnown{"kind", "baud", "roll", "pitch", "yaw"};
  for (const auto& option : spec.options) {
    if (std::find(kKnown.begin(), kKnown.end(), option.first) != kKnown.end()) continue;
    return fail(ErrorCode::wrong_use, "ahrs: has no option '{}'; there are: {}", option.first,
                fmt::join(kKnown, ", "));
  }
  const auto kind = spec.choice("kind", "vectornav", {"vectornav", "ahrs8"});
  if (!kind) return forward_error(kind);
  const auto baud = spec.integer("baud", 115'200, 9'600, 3'000'000);
  if (!baud) return forward_error(baud);
  std::array<double, 3> angles_rad{};
  constexpr std::array<const char*, 3> kNames{"roll", "pitch", "yaw"};
  for (std::size_t i = 0; i < 3; ++i) {
    const auto angle_deg = spec.number(kNames[i], 0.0, -180.0, 180.0);
    if (!angle_deg) return forward_error(angle_deg);
    angles_rad[i] = *angle_deg * std::numbers::pi / 180.0;
  }
  AhrsOptions options{spec.target, *kind, static_cast<int>(*baud), {}};
  options.R_body_sensor = sensing::rotation_zyx(angles_rad[0], angles_rad[1], angles_rad[2]);
  return options;
}

}  // namespace lifeline::ahrs
