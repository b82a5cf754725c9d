#pragma once

#include <memory>
#include <optional>

#include "agents/sensing/attitude_source.hpp"
#include "agents/sensing/scan_source.hpp"
#include "agents/sources/attitude_track.hpp"

namespace lifeline::sources {

/// A live lidar's scans with a live attitude sensor's attitudes: at the stamp, and within the
/// sweep.
///
/// A scan waits for its attitudes, but never longer than kPatience: then it goes on with an old one
/// (within AttitudeTrack::kReach) or with none, and its attitude_health says so. While the sensor
/// is known to be silent nothing is waited for. A yaw is handed on only from a sensor that is well:
/// nobody is to take a leap, or an old heading, for a turn of the head. Both must stamp by
/// stamp_of() or by one recording.
class JoinedSource final : public sensing::ScanSource {
 public:
  /// Longer than a sensor of 40 Hz and its adapter take to tell of the end of a sweep.
  static constexpr Duration kPatience = std::chrono::milliseconds(60);

  JoinedSource(std::unique_ptr<sensing::ScanSource> scans,
               std::unique_ptr<sensing::AttitudeSource> attitudes)
      : scans_(std::move(scans)), track_(std::move(attitudes)) {}

  [[nodiscard]] Result<std::optional<sensing::RawScan>> next() override;

 private:
  std::unique_ptr<sensing::ScanSource> scans_;
  AttitudeTrack track_;
};

}  // namespace lifeline::sources
