#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <stop_token>
#include <string_view>

#include "agents/sensing/scan_source.hpp"
#include "common/base/result.hpp"
#include "common/base/time.hpp"

namespace lifeline::sources {

/// How fast a recording is played: recorded seconds per second of the clock.
struct SourcePace {
  double speed = 0.0;  ///< 0: as fast as scans are taken

  auto operator<=>(const SourcePace&) const = default;
};

constexpr SourcePace kUnpaced{0.0};
constexpr SourcePace kRealTime{1.0};

/// `real`, `max` (unpaced), or `xN`: N times as fast as recorded, N from 0.01 to 1000.
[[nodiscard]] Result<SourcePace> parse_source_pace(std::string_view text);

/// Waits that long; false where the wait was cut short because the program is to stop.
using Wait = std::function<bool(Duration)>;

/// A wait on the system's clock, which `stop` cuts short.
[[nodiscard]] Wait stoppable_wait(std::stop_token stop);

/// Hands the scans of another source on at the pace of their stamps, the first one at once. A scan
/// that is due already (the taker was slow, or its stamp goes back) comes at once; nothing is
/// dropped. Ends when a wait is cut short.
class PacedSource final : public sensing::ScanSource {
 public:
  /// `pace.speed` > 0. `clock` must outlive this; time passes on it while `wait` waits.
  PacedSource(std::unique_ptr<sensing::ScanSource> source, SourcePace pace, const Clock& clock,
              Wait wait);

  [[nodiscard]] Result<std::optional<sensing::RawScan>> next() override;

 private:
  [[nodiscard]] bool wait_until(double due_s);

  std::unique_ptr<sensing::ScanSource> source_;
  const SourcePace pace_;
  const Clock& clock_;
  const Wait wait_;
  std::optional<Timestamp> first_stamp_;
  SteadyTime start_{};  ///< when the first scan was handed on
};

}  // namespace lifeline::sources
