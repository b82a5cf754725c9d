#include "common/store/alert_records.hpp"

#include <algorithm>
#include <utility>

#include "common/sharing/alert_list.hpp"
#include "idl/state.pb.h"

namespace lifeline::store {
namespace {

tl::unexpected<Error> broken() {
  return fail(ErrorCode::bad_data, "record {} does not hold what it should", kAlertsKey);
}

/// An alert only grows, so that its size tells.
bool is_same(const std::vector<wire::Alert>& a, const std::vector<wire::Alert>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](const wire::Alert& one, const wire::Alert& other) {
                      return one.alert_id == other.alert_id && one.state == other.state &&
                             one.acknowledged_by.size() == other.acknowledged_by.size();
                    });
}

}  // namespace

std::string alerts_record(const std::vector<wire::Alert>& own) {
  proto::KeptAlerts kept;
  for (const wire::Alert& alert : own) {
    auto& record = *kept.add_alerts();
    record.set_alert_id(alert.alert_id);
    record.set_kind(static_cast<std::uint32_t>(alert.kind));
    record.set_state(static_cast<std::uint32_t>(alert.state));
    record.set_subject_id(alert.subject_id);
    record.set_text(alert.text);
    for (const auto& name : alert.acknowledged_by) record.add_acknowledged_by(name);
  }
  return kept.SerializeAsString();
}

Result<std::vector<wire::Alert>> read_alerts(const Records& records, const std::string& issuer_id) {
  std::vector<wire::Alert> alerts;
  const auto record = records.find(kAlertsKey);
  if (record == records.end()) return alerts;
  proto::KeptAlerts kept;
  if (!kept.ParseFromString(record->second)) return broken();
  sharing::AlertList list;
  for (const auto& each : kept.alerts()) {
    wire::Alert alert;
    alert.envelope.sender_id = alert.issuer_id = issuer_id;
    alert.alert_id = each.alert_id();
    alert.kind = static_cast<wire::AlertKind>(std::min(each.kind(), 255U));
    alert.state = static_cast<wire::AlertState>(std::min(each.state(), 255U));
    alert.subject_id = each.subject_id();
    alert.text = each.text();
    alert.acknowledged_by = {each.acknowledged_by().begin(), each.acknowledged_by().end()};
    if (!list.apply(alert, false, {})) return broken();
    alerts.push_back(std::move(alert));
  }
  return alerts;
}

void AlertKeeper::keep(std::vector<wire::Alert> own, RecordStore& records) {
  if (is_same(own, kept_)) return;
  kept_ = std::move(own);
  records.put(kAlertsKey, alerts_record(kept_));
}

}  // namespace lifeline::store
