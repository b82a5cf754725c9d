#include "common/sharing/alert_exchange.hpp"

#include <algorithm>
#include <chrono>
#include <numeric>
#include <utility>

#include "common/base/log.hpp"

namespace lifeline::sharing {
namespace {

constexpr Duration kRepeatInterval = std::chrono::seconds(1);
// Whatever the middleware says: who missed an alert, or its end, hears it again.
constexpr Duration kReassureInterval = std::chrono::seconds(5);
constexpr std::size_t kReassured = 8;  // of its own, the newest
// Who reads keeps one sample of an alert, whoever sent it: answers of one moment replace each
// other.
constexpr Duration kSlot = std::chrono::milliseconds(40);
constexpr int kSlots = 16;

Duration reply_slot(const AgentId& id, wire::Role role) {
  if (role == wire::Role::coordinator) return {};
  return kSlot * (std::accumulate(id.text().begin(), id.text().end(), 0) % kSlots);
}

bool is_command(const Roster& roster, const std::string& sender) {
  const auto* entry = roster.find(sender);
  return entry != nullptr && entry->status.role == wire::Role::coordinator;
}

}  // namespace

AlertExchange::AlertExchange(Speaker speaker, wire::Role role,
                             std::unique_ptr<wire::Inbox<wire::Alert>> inbox,
                             std::unique_ptr<wire::Outbox<wire::Alert>> outbox, const Clock& clock)
    : speaker_(std::move(speaker)),
      role_(role),
      inbox_(std::move(inbox)),
      outbox_(std::move(outbox)),
      clock_(clock),
      stamper_(speaker_),
      reply_after_(reply_slot(speaker_.id, role)) {}

Result<void> AlertExchange::resume(const std::vector<wire::Alert>& own) {
  for (wire::Alert alert : own) {
    if (alert.issuer_id != speaker_.id.text())
      return fail(ErrorCode::bad_data, "alert {}/{} is not its own", alert.issuer_id,
                  alert.alert_id);
    last_id_ = std::max(last_id_, alert.alert_id);
    if (auto taken = put(std::move(alert)); !taken) return taken;
  }
  return {};
}

Result<void> AlertExchange::put(wire::Alert alert) {
  alert.envelope = stamper_.next(clock_.wall_now());
  const auto taken = list_.apply(alert, role_ == wire::Role::coordinator, clock_.steady_now());
  if (outbox_ != nullptr) {
    // What there is no room for here may still be heard by others.
    if (auto sent = outbox_->put(alert); !sent) spdlog::warn("{}", sent.error().text);
  }
  if (!taken) return forward_error(taken);
  return {};
}

void AlertExchange::say(wire::Alert alert) {
  if (auto held = put(std::move(alert)); !held) spdlog::warn("{}", held.error().text);
}

Result<AlertKey> AlertExchange::raise(wire::AlertKind kind, const std::string& subject_id,
                                      const std::string& text) {
  if (outbox_ == nullptr) return fail(ErrorCode::unavailable, "alerts are not sent here");
  // Never the same again, not even after a restart: the second it is raised in.
  const auto second =
      std::chrono::duration_cast<std::chrono::seconds>(clock_.wall_now().time_since_epoch());
  last_id_ = std::max(last_id_ + 1, static_cast<std::uint32_t>(second.count()));
  wire::Alert alert;
  alert.issuer_id = speaker_.id.text();
  alert.alert_id = last_id_;
  alert.kind = kind;
  alert.subject_id = subject_id;
  alert.text = text;
  AlertKey key{alert.issuer_id, alert.alert_id};
  say(std::move(alert));
  return key;
}

Result<void> AlertExchange::answer(const AlertKey& key, wire::AlertState state) {
  if (outbox_ == nullptr) return fail(ErrorCode::unavailable, "alerts are not sent here");
  const auto* entry = list_.find(key);
  if (entry == nullptr) return fail(ErrorCode::not_found, "no alert {}/{}", key.first, key.second);
  wire::Alert alert = entry->alert;
  if (!has_answered(alert, speaker_.id.text())) alert.acknowledged_by.push_back(speaker_.id.text());
  alert.state = std::max(alert.state, state);
  say(std::move(alert));
  return {};
}

std::vector<wire::Alert> AlertExchange::own() const {
  std::vector<wire::Alert> own;
  for (const auto& [key, entry] : list_.entries()) {
    if (key.first == speaker_.id.text() && entry.is_told) own.push_back(entry.alert);
  }
  return own;
}

void AlertExchange::step(const Roster& roster, HearingNotes& notes) {
  if (inbox_ == nullptr) return;
  const SteadyTime now = clock_.steady_now();
  for (const auto& sample : inbox_->take()) {
    const std::string& sender = sample.envelope.sender_id;
    if (sender == speaker_.id.text()) continue;  // our own, come back
    auto accepted = check_envelope(sample.envelope, speaker_.mission_id);
    Result<bool> taken = false;
    if (accepted) taken = list_.apply(sample, is_command(roster, sender), now);
    if (!accepted || !taken) {
      notes.refusals.note("alert", accepted ? taken.error() : accepted.error());
    } else if (*taken) {
      repeat_due_ = std::min(repeat_due_, now + reply_after_);
    }
  }
  if (outbox_ == nullptr) return;
  if (now >= repeat_due_) repeat(now);
  if (now >= reassure_due_) reassure(now);
}

// What its reader may have missed, since two senders share an alert: the issuer says all names, and
// who answers repeats it until the issuer does.
void AlertExchange::repeat(SteadyTime now) {
  repeat_due_ = now + kRepeatInterval + reply_after_;
  const std::string& self = speaker_.id.text();
  std::vector<wire::Alert> again;
  for (const auto& [key, entry] : list_.entries()) {
    if (!entry.is_told || entry.is_gathered) continue;
    if (key.first == self || has_answered(entry.alert, self)) again.push_back(entry.alert);
  }
  for (auto& alert : again) say(std::move(alert));
}

void AlertExchange::reassure(SteadyTime now) {
  reassure_due_ = now + kReassureInterval + reply_after_;
  auto alerts = own();  // in the order of their ids
  const std::size_t old = alerts.size() - std::min(alerts.size(), kReassured);
  for (std::size_t i = old; i < alerts.size(); ++i) say(std::move(alerts[i]));
}

}  // namespace lifeline::sharing
