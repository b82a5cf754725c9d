// How a coordinator goes on after a restart, leads, follows and takes over (docs/decisions/0602).
#include <algorithm>

#include "common/base/log.hpp"
#include "common/sharing/accept.hpp"
#include "common/sharing/groups.hpp"
#include "coordinator/coordinator.hpp"

namespace lifeline {
namespace {

// So long helmets keep an answer that nobody knows any more, while all of it is worked out anew.
constexpr Duration kHoldBackAtLeast = std::chrono::seconds(2);
constexpr Duration kHoldBackAtMost = std::chrono::seconds(6);
constexpr Duration kAssertInterval = std::chrono::milliseconds(500);
constexpr Duration kRepeatDirectiveAfter = std::chrono::seconds(1);
// Not by one status alone: what outranks costs everybody a new common map.
constexpr Duration kContradictedFor = std::chrono::seconds(3);

}  // namespace

Result<void> Coordinator::resume(const CoordinatorMemory& memory) {
  for (const auto& [layer, tiles] : memory.layers) {
    for (const auto& [tile, kept] : tiles) {
      if (auto held = store_.restore(layer, tile, {kept.revision, kept.cells}); !held) return held;
    }
  }
  keeper_.adopt(memory.edges, memory.parted_by_hand);
  if (auto taken = alerts_.resume(memory.alerts); !taken) return taken;
  if (!memory.directive) return {};
  if (auto sound = sharing::check_directive(*memory.directive); !sound) return sound;
  (void)writer_.adopt(*memory.directive);
  keeper_.adopt(*memory.directive);
  place_common_map();
  return {};
}

void Coordinator::hear_directives() {
  if (channels_.directives == nullptr) return;
  for (const auto& directive : channels_.directives->take()) {
    auto accepted = sharing::check_envelope(directive.envelope, settings_.speaker.mission_id);
    if (accepted) accepted = sharing::check_directive(directive);
    if (!accepted || !writer_.is_believable(Epoch{directive.epoch})) {
      notes_.refusals.note("merge_directive",
                           accepted
                               ? Error{ErrorCode::bad_data, "a directive's epoch is too far ahead"}
                               : accepted.error());
      continue;
    }
    heard_epoch_ = std::max(heard_epoch_, Epoch{directive.epoch});
    if (!leads()) {
      take_over(directive);
    } else if (!heard_while_leading_ || sharing::outranks(directive, *heard_while_leading_)) {
      heard_while_leading_ = directive;
    }
  }
}

void Coordinator::take_over(const wire::MergeDirective& directive) {
  if (!writer_.adopt(directive)) return;
  spdlog::info("takes over directive {} of {}", directive.epoch, directive.envelope.sender_id);
  place_common_map();
}

void Coordinator::give_way() {
  channels_.directive.reset();
  contradicted_since_.clear();
  // Who leads now may have said it once, before we listened.
  if (heard_while_leading_) take_over(*heard_while_leading_);
  heard_while_leading_.reset();
}

void Coordinator::keep_followed(const wire::AgentStatus& status, SteadyTime now) {
  if (!leads() || led_since_ || !writer_.has_spoken()) return;
  // Whom the directive did not reach is told again, whatever the middleware thinks: it may have
  // heard a stronger coordinator when it was sent.
  const bool follows =
      status.role == wire::Role::helmet || status.state == wire::AgentState::starting;
  if (follows && status.epoch_applied < writer_.directive().epoch &&
      now - directive_sent_at_ >= kRepeatDirectiveAfter) {
    send_directive(now);
  }
  if (!follows || !follows_another(status)) {
    contradicted_since_.erase(status.agent_id);
    return;
  }
  const SteadyTime since = contradicted_since_.try_emplace(status.agent_id, now).first->second;
  if (now - since < kContradictedFor || !writer_.renew(heard_epoch_)) return;
  spdlog::warn("{} follows another directive {}: ours is {} now", status.agent_id,
               status.epoch_applied, writer_.directive().epoch);
  contradicted_since_.clear();
  send_directive(now);
}

bool Coordinator::follows_another(const wire::AgentStatus& theirs) const {
  if (!sharing::holds_another_map(theirs, said_)) return false;
  if (theirs.role == wire::Role::coordinator) return true;  // it tells the largest group's, too
  const auto layer = sharing::to_layer_key({theirs.agent_id, theirs.map_id, theirs.floor});
  return layer && !common_map_.placements().empty() &&
         sharing::group_of(writer_.directive(), *layer) == common_map_.placements();
}

void Coordinator::note_epoch(const wire::AgentStatus& status, SteadyTime now) {
  const Epoch heard{status.epoch_applied};
  if (!writer_.is_believable(heard)) return;
  heard_epoch_ = std::max(heard_epoch_, heard);
  if (!leads() || heard.value <= writer_.directive().epoch) return;
  if (channels_.open_directive) {
    // Somebody led meanwhile. Theirs is the newer answer: hear it, which takes that ours is closed.
    spdlog::warn("gives way: directive {} is of somebody else; listens to it", heard.value);
    give_way();
    leadership_.yield(now);
  } else if (writer_.outrank(heard)) {
    // A coordinator that starts anew must outrank what the helmets still follow from before.
    send_directive(now);
  }
}

void Coordinator::take_part(SteadyTime now) {
  if (channels_.open_directive) {
    const bool leads_now = leadership_.step(now);
    if (leads_now && !leads()) begin_to_lead(now);
    if (!leads_now && leads()) {
      spdlog::info("gives way to {}", leadership_.leader());
      give_way();
    }
  }
  if (leads()) stay_heard(now);
}

void Coordinator::begin_to_lead(SteadyTime now) {
  auto opened = channels_.open_directive();
  if (!opened) {
    spdlog::error("{}", opened.error().text);
    leadership_.yield(now);
    return;
  }
  channels_.directive = *std::move(opened);
  const bool knows_the_answer = writer_.directive().epoch >= heard_epoch_.value;
  keeper_.adopt(writer_.directive());
  (void)writer_.outrank(heard_epoch_);
  const bool speaks = writer_.renew(heard_epoch_);
  if (!knows_the_answer) {
    led_since_ = now;
  } else if (speaks) {
    send_directive(now);
  }
  spdlog::info("leads: directive {} with {} members", writer_.directive().epoch,
               writer_.directive().members.size());
}

bool Coordinator::holds_back(SteadyTime now) {
  if (!leads()) return true;
  if (!led_since_) return false;
  const Duration held = now - *led_since_;
  if (held < kHoldBackAtLeast || (held < kHoldBackAtMost && !idle())) return true;
  led_since_.reset();
  return false;
}

void Coordinator::stay_heard(SteadyTime now) {
  if (now < assert_due_) return;
  assert_due_ = now + kAssertInterval;
  channels_.directive->assert_alive();
  const bool held_back = led_since_.has_value();
  if (holds_back(now)) return;
  if (held_back && follow_plan(now).empty() && writer_.has_spoken()) {
    send_directive(now);
  }
}

}  // namespace lifeline
