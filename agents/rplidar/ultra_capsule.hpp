#pragma once

#include <cstdint>
#include <optional>

#include "agents/rplidar/frames.hpp"

namespace lifeline::rplidar {

/// Ultra capsules (0x84) are how an A3 sends its 16,000 readings a second over a line of 256,000
/// baud. Slamtec states that the encoding is patented (CN 108306649 A): they are decoded only in
/// builds that ask for it (LIFELINE_RPLIDAR_ULTRA). Without it ultra_format() is empty.
[[nodiscard]] std::optional<FrameFormat> ultra_format();

/// As decode_frame(); only where ultra_format() is not empty.
void decode_ultra(Bytes frame, Bytes next, std::int32_t start_q16, std::int32_t turn_q16,
                  Readings& out);

}  // namespace lifeline::rplidar
