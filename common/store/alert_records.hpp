#pragma once

#include <string>
#include <vector>

#include "common/base/result.hpp"
#include "common/store/record_file.hpp"
#include "common/store/record_store.hpp"
#include "common/wire/messages.hpp"

namespace lifeline::store {

inline constexpr const char* kAlertsKey = "alerts";

/// What a participant raised, open or over, as a record of its state.
[[nodiscard]] std::string alerts_record(const std::vector<wire::Alert>& own);
/// The alerts of `issuer_id` among the records, as its list would take them from itself; none where
/// there is no record. bad_data where one of them is no alert, or they are too many.
[[nodiscard]] Result<std::vector<wire::Alert>> read_alerts(const Records& records,
                                                           const std::string& issuer_id);

/// Keeps a participant's own alerts in its state. One owner, not thread-safe.
class AlertKeeper {
 public:
  /// `own`: what the state holds.
  void begin(std::vector<wire::Alert> own) { kept_ = std::move(own); }
  /// Writes `own` where they are others than before.
  void keep(std::vector<wire::Alert> own, RecordStore& records);

 private:
  std::vector<wire::Alert> kept_;
};

}  // namespace lifeline::store
