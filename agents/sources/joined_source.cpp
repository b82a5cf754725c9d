#include "agents/sources/joined_source.hpp"

#include <algorithm>
#include <limits>

namespace lifeline::sources {

using sensing::AttitudeHealth;

Result<std::optional<sensing::RawScan>> JoinedSource::next() {
  auto scan = scans_->next();
  if (!scan || !*scan) return scan;
  sensing::RawScan& raw = **scan;
  if (auto followed = track_.follow_set_back(raw.stamp); !followed) return forward_error(followed);
  const SteadyTime deadline = std::chrono::steady_clock::now() + kPatience;
  if (auto filled = track_.fill(raw, deadline); !filled) return forward_error(filled);
  raw.attitude_health = track_.health();
  if (!raw.attitude) {
    raw.attitude_health = std::max(raw.attitude_health, AttitudeHealth::silent);
  } else if (track_.is_behind(raw.stamp + raw.sweep_time)) {
    raw.attitude_health = std::max(raw.attitude_health, AttitudeHealth::degraded);
  }
  if (raw.attitude && raw.attitude_health != AttitudeHealth::good) {
    raw.attitude->yaw_rad = std::numeric_limits<double>::quiet_NaN();
  }
  return scan;
}

}  // namespace lifeline::sources
