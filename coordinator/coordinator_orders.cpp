// What the commander decides: finds, merges by hand, alerts (docs/decisions/0802).
#include <algorithm>

#include "common/base/log.hpp"
#include "common/sharing/accept.hpp"
#include "common/sharing/hear.hpp"
#include "coordinator/coordinator.hpp"

namespace lifeline {
void Coordinator::hear_detections(SteadyTime now) {
  for (const auto& sample : channels_.detections->take()) {
    if (sample.envelope.sender_id == settings_.speaker.id.text()) continue;  // our own, come back
    sharing::hear(std::vector{sample}, "detection", settings_.speaker.mission_id, now, notes_,
                  [&](const wire::Detection& heard) { return detections_.apply(heard); });
    // The helmet's news stands now where our ruling stood for readers who join late.
    const auto ruled = detections_.rulings().find({sample.agent_id, sample.detection_id});
    if (channels_.ruling == nullptr || ruled == detections_.rulings().end() ||
        sample.envelope.sender_id != sample.agent_id || sample.state == ruled->second.state ||
        ruled->second.envelope.sender_id != settings_.speaker.id.text()) {
      continue;
    }
    wire::Detection again = ruled->second;
    again.envelope = ruling_stamper_.next(clock_.wall_now());
    if (auto sent = channels_.ruling->put(again); !sent) spdlog::warn("{}", sent.error().text);
  }
}

Result<void> Coordinator::rule(const sharing::DetectionKey& detection, wire::DetectionState state) {
  const auto held = detections_.held().find(detection);
  if (held == detections_.held().end()) {
    return fail(ErrorCode::not_found, "no find {}/{}", detection.first, detection.second);
  }
  if (channels_.ruling == nullptr) return fail(ErrorCode::unavailable, "finds are not sent here");
  wire::Detection ruling = held->second;
  const auto before = detections_.rulings().find(detection);
  ruling.revision = before == detections_.rulings().end() ? 1 : before->second.revision + 1;
  ruling.state = state;
  ruling.envelope = ruling_stamper_.next(clock_.wall_now());
  if (auto taken = detections_.apply(ruling); !taken) return forward_error(taken);
  return channels_.ruling->put(ruling);
}

Result<void> Coordinator::part(const merging::LayerPair& pair) {
  if (!leads()) return fail(ErrorCode::unavailable, "this coordinator does not lead");
  if (keeper_.graph().edge(pair) == nullptr && !newest_.contains(pair))
    return fail(ErrorCode::not_found, "{} were never matched", merging::describe(pair));
  spdlog::info("{}: withdrawn by hand", merging::describe(pair));
  follow_hand(keeper_.part_by_hand(pair));
  return {};
}

Result<void> Coordinator::merge(const merging::LayerPair& pair) {
  if (!leads()) return fail(ErrorCode::unavailable, "this coordinator does not lead");
  const auto record = newest_.find(pair);
  if (record == newest_.end() || record->second.result.candidates.empty()) {
    return fail(ErrorCode::not_found, "{}: no match found a place for them yet",
                merging::describe(pair));
  }
  const auto& result = record->second.result;
  merging::MergeEdge edge{result.candidates.front().T_a_b, result.covariance, 1.0,
                          result.overlap_centre_b_m};
  // A match that was not accepted may not have measured how sure it is: 0.3 m and 3 degrees.
  if (edge.covariance.isZero()) {
    edge.covariance.diagonal() << 0.09, 0.09, 0.0027;
  }
  spdlog::info("{}: accepted by hand", merging::describe(pair));
  follow_hand(keeper_.merge_by_hand(pair, edge));
  return {};
}

void Coordinator::follow_hand(const std::vector<merging::PairNews>& news) {
  const SteadyTime now = clock_.steady_now();
  const std::string change = holds_back(now) ? "" : follow_plan(now);
  bool is_first = true;
  for (merging::PairNews each : news) {
    newest_.try_emplace(each.pair, MergeRecord{each.pair, {}, {}, false});
    if (is_first && !change.empty()) each.reason += " [" + change + "]";
    is_first = false;
    tell(each, now);
  }
  for (MergeRecord& record : accepted_) record.in_directive = keeper_.follows(record.pair);
}

Result<void> Coordinator::raise(wire::AlertKind kind, const std::string& subject_id,
                                const std::string& text) {
  if (auto raised = alerts_.raise(kind, subject_id, text); !raised) return forward_error(raised);
  return {};
}

Result<void> Coordinator::answer(const sharing::AlertKey& key, wire::AlertState state) {
  return alerts_.answer(key, state);
}

}  // namespace lifeline
