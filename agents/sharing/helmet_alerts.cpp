// What a helmet's wearer does with alerts (docs/decisions/0911).
#include "agents/sharing/helmet_sharing.hpp"
#include "common/base/log.hpp"

namespace lifeline::sharing {

std::optional<AlertKey> HelmetSharing::own_mayday() const {
  const std::string& self = config_.speaker.id.text();
  std::optional<AlertKey> open;
  for (const auto& [key, entry] : alerts_.list().entries()) {
    if (key.first == self && entry.is_told && entry.alert.kind == wire::AlertKind::mayday &&
        entry.alert.state != wire::AlertState::cleared) {
      open = key;
    }
  }
  return open;
}

Result<void> HelmetSharing::raise_mayday(const std::string& text) {
  if (own_mayday()) return {};
  if (auto raised = alerts_.raise(wire::AlertKind::mayday, config_.speaker.id.text(), text);
      !raised)
    return forward_error(raised);
  spdlog::warn("mayday raised");
  return {};
}

Result<void> HelmetSharing::cancel_mayday() {
  const auto open = own_mayday();
  if (!open) return fail(ErrorCode::not_found, "no mayday of this helmet is open");
  spdlog::warn("mayday cancelled");
  return alerts_.answer(*open, wire::AlertState::cleared);
}

Result<void> HelmetSharing::answer(const AlertKey& alert) {
  return alerts_.answer(alert, wire::AlertState::raised);
}

}  // namespace lifeline::sharing
