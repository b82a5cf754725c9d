#pragma once

#include <optional>

#include "agents/sensing/raw_scan.hpp"
#include "common/base/result.hpp"

namespace lifeline::sensing {

/// Where scans come from: a recording, a simulator, a device, a topic.
class ScanSource {
 public:
  virtual ~ScanSource() = default;
  /// The next scan; empty at the end. Files and simulators answer at once, devices wait for their
  /// sensor. After an error the source is at its end.
  [[nodiscard]] virtual Result<std::optional<RawScan>> next() = 0;
};

}  // namespace lifeline::sensing
