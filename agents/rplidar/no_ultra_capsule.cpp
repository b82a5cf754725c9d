#include "agents/rplidar/ultra_capsule.hpp"
#include "common/base/check.hpp"

namespace lifeline::rplidar {

std::optional<FrameFormat> ultra_format() {
  return std::nullopt;
}

void decode_ultra(Bytes /*frame*/, Bytes /*next*/, std::int32_t /*start_q16*/,
                  std::int32_t /*turn_q16*/, Readings& /*out*/) {
  LIFELINE_CHECK(false);  // nobody finds such a frame
}

}  // namespace lifeline::rplidar
