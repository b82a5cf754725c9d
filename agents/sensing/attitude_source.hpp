#pragma once

#include <optional>

#include <Eigen/Geometry>

#include "agents/sensing/raw_scan.hpp"
#include "common/base/result.hpp"
#include "common/base/time.hpp"

namespace lifeline::sensing {

/// An orientation at a time. Body x forward, y left, z up; world with z up and any heading.
struct OrientationSample {
  Timestamp stamp{};
  Eigen::Quaterniond R_world_body = Eigen::Quaterniond::Identity();
};

/// What an attitude source has to give at the moment.
struct AttitudeRead {
  std::optional<OrientationSample> sample;  ///< empty: none came in time, or none will come
  bool ended = false;
};

/// Where attitudes come from: a recording's messages, or a sensor. One owner.
class AttitudeSource {
 public:
  virtual ~AttitudeSource() = default;
  /// The next sample, in the order in which they were taken. A recording answers at once; a sensor
  /// is waited for until `deadline` at the latest, and not at all while it is known to be silent.
  [[nodiscard]] virtual Result<AttitudeRead> next(SteadyTime deadline) = 0;
  /// How the sensor is now; recordings are always good.
  [[nodiscard]] virtual AttitudeHealth health() const { return AttitudeHealth::good; }
};

}  // namespace lifeline::sensing
