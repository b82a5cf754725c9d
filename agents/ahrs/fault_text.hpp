#pragma once

#include <string>

#include "agents/ahrs/attitude_watch.hpp"
#include "agents/sensing/raw_scan.hpp"

namespace lifeline::ahrs {

/// What is wrong, in one line, and what to do about it; the device's name goes in front.
[[nodiscard]] std::string fault_text(AttitudeFault fault, RateUnit unit, int baud);

/// What a fault makes of the attitude. Rates in another unit are named, but nothing uses them.
[[nodiscard]] sensing::AttitudeHealth health_of(AttitudeFault fault, RateUnit unit);

}  // namespace lifeline::ahrs
