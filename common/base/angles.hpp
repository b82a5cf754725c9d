#pragma once

#include <numbers>

namespace lifeline {

inline constexpr double kDegree = std::numbers::pi / 180.0;  ///< radians

}  // namespace lifeline
