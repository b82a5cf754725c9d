#include "coordinator/coordinator.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "common/base/log.hpp"
#include "common/grid/occupancy_grid.hpp"
#include "common/sharing/accept.hpp"
#include "common/wire/limits.hpp"
#include "coordinator/evidence.hpp"

namespace lifeline {
namespace {

constexpr Duration kStatusInterval = std::chrono::seconds(1);
constexpr Duration kCountInterval = std::chrono::milliseconds(500);
// A correction's tiles follow each other closer than this.
constexpr Duration kQuietAfter = std::chrono::seconds(3);
constexpr double kPathStepM = 0.05;
constexpr std::size_t kMaxPathPoints = 100'000;

// The members of the largest group: group 0, since plans list the largest first.
std::vector<sharing::Placement> largest_group(const wire::MergeDirective& directive) {
  std::vector<sharing::Placement> group;
  for (const auto& member : directive.members) {
    if (member.group != 0) continue;
    if (auto key = sharing::to_layer_key(member.layer))
      group.push_back({*std::move(key), member.T_common_map});
  }
  return group;
}

}  // namespace

Coordinator::Coordinator(CoordinatorSettings settings, CoordinatorChannels channels,
                         MatchWorker& worker, const Clock& clock)
    : settings_(std::move(settings)),
      channels_(std::move(channels)),
      worker_(worker),
      clock_(clock),
      started_(clock.steady_now()),
      store_(settings_.geometry),
      common_map_(settings_.geometry),
      schedule_(settings_.schedule, settings_.geometry.cell_size_m),
      writer_(settings_.directive, settings_.speaker.mission_id),
      directive_stamper_(settings_.speaker),
      evidence_stamper_(settings_.speaker),
      status_stamper_(settings_.speaker) {}

void Coordinator::step() {
  const SteadyTime now = clock_.steady_now();
  hear_statuses(now);
  hear_poses();
  hear_tiles();
  note_changes(now);
  count_known_cells(now);
  take_outcome(now);
  match_next();
  common_map_.update(store_);
  if (now >= status_due_) {
    status_due_ = now + kStatusInterval;
    wire::AgentStatus own = status();
    own.envelope = status_stamper_.next(clock_.wall_now());
    if (auto sent = channels_.status->put(own); !sent) spdlog::warn("{}", sent.error().text);
  }
}

void Coordinator::hear_tiles() {
  for (const auto& sample : channels_.tiles->take()) {
    if (auto accepted = sharing::check_envelope(sample.envelope, settings_.speaker.mission_id);
        !accepted) {
      refuse("tsd_tile", accepted.error());
    } else if (auto applied = store_.apply(sample); !applied) {
      refuse("tsd_tile", applied.error());
    }
  }
}

void Coordinator::note_changes(SteadyTime now) {
  for (const auto& changed : store_.take_changed()) {
    common_map_.mark(changed);
    auto& progress =
        progress_.try_emplace(changed.layer, merging::LayerProgress{changed.layer}).first->second;
    Watched& watched = watched_[changed.layer];
    ++progress.changes;
    watched.walls.note(changed.tile, store_.find(changed.layer)->at(changed.tile).cells);
    watched.changed_at = now;
    progress.wall_cells = watched.walls.wall_cells();
    progress.revised_cells = watched.walls.revised_cells();
  }
}

void Coordinator::hear_poses() {
  for (const auto& pose : channels_.poses->take()) {
    auto accepted = sharing::check_envelope(pose.envelope, settings_.speaker.mission_id);
    const auto key = sharing::to_layer_key({pose.agent_id, pose.map_id, pose.floor});
    if (!accepted || !key || !pose.T_map_head.is_finite()) {
      refuse("pose", accepted ? Error{ErrorCode::bad_data, "pose is not finite or names no helmet"}
                              : accepted.error());
      continue;
    }
    if (!paths_.contains(*key) && paths_.size() >= sharing::ReplicaStore::kMaxLayers) continue;
    Path& path = paths_[*key];
    if (path.size() >= kMaxPathPoints) continue;
    const Eigen::Vector2d here = pose.T_map_head.translation();
    if (path.empty() || (here - path.back()).norm() >= kPathStepM) path.push_back(here);
  }
}

void Coordinator::hear_statuses(SteadyTime now) {
  for (const auto& status : channels_.statuses->take()) {
    if (auto accepted = sharing::check_envelope(status.envelope, settings_.speaker.mission_id);
        !accepted) {
      refuse("agent_status", accepted.error());
      continue;
    }
    if (status.agent_id == settings_.speaker.id.text()) continue;
    if (!roster_.hear(status, now)) continue;
    // A coordinator that starts anew must outrank what the helmets still follow from before.
    if (writer_.outrank(Epoch{status.epoch_applied})) send_directive(clock_.wall_now());
  }
}

void Coordinator::count_known_cells(SteadyTime now) {
  if (now < count_due_) return;
  count_due_ = now + kCountInterval;
  for (auto& [layer, progress] : progress_) {
    const auto* entry = roster_.find(layer.agent_id.text());
    progress.finished = entry != nullptr && entry->status.state == wire::AgentState::finished;
    Watched& watched = watched_.at(layer);
    progress.quiet = now - watched.changed_at >= kQuietAfter;
    if (watched.counted == progress.changes) continue;
    watched.counted = progress.changes;
    progress.known_cells = known_cells(to_grid(*store_.find(layer), settings_.geometry));
  }
}

std::vector<merging::LayerProgress> Coordinator::progress() const {
  std::vector<merging::LayerProgress> all;
  for (const auto& [layer, progress] : progress_) all.push_back(progress);
  return all;
}

void Coordinator::match_next() {
  if (worker_.busy()) return;
  const auto pair = schedule_.due(progress(), clock_.steady_now(), keeper_.unchecked());
  if (!pair) return;
  const auto &a = progress_.at(pair->a), &b = progress_.at(pair->b);
  worker_.submit({a, b, *store_.find(pair->a), *store_.find(pair->b), settings_.geometry,
                  keeper_.place_to_check(*pair)});
}

void Coordinator::take_outcome(SteadyTime now) {
  auto outcome = worker_.take();
  if (!outcome) return;
  const auto &a = outcome->a, &b = outcome->b;
  const merging::LayerPair pair{a.layer, b.layer};
  const bool was_merged = keeper_.graph().edge(pair) != nullptr;
  // Standing still does not make a young map an old one: only who is merged already is judged by
  // it.
  const bool last_chance =
      (a.finished || (was_merged && a.quiet)) && (b.finished || (was_merged && b.quiet));
  auto news = keeper_.take(pair, {outcome->result, outcome->check, last_chance});
  schedule_.matched(a, b, now,
                    keeper_.in_doubt(pair)  ? merging::Standing::doubted
                    : keeper_.follows(pair) ? merging::Standing::merged
                                            : merging::Standing::apart);
  const std::string change = follow_plan(clock_.wall_now());
  if (!change.empty()) news.front().reason += " [" + change + "]";
  newest_.insert_or_assign(pair, MergeRecord{pair, std::move(outcome->result), {}, false});
  for (const merging::PairNews& of : news) tell(of, now);
  if (newest_.at(pair).result.accepted()) accepted_.push_back(newest_.at(pair));
  for (MergeRecord& record : accepted_) record.in_directive = keeper_.follows(record.pair);
}

void Coordinator::tell(const merging::PairNews& news, SteadyTime now) {
  MergeRecord& record = newest_.at(news.pair);
  record.at = now - started_;
  record.in_directive = keeper_.follows(news.pair);
  record.result.verdict = news.verdict;
  record.result.reason = news.reason.substr(0, wire::kMaxReason);
  wire::MergeEvidence evidence = to_evidence(news.pair, record.result);
  evidence.envelope = evidence_stamper_.next(clock_.wall_now());
  if (auto sent = channels_.evidence->put(evidence); !sent) spdlog::warn("{}", sent.error().text);
}

std::string Coordinator::follow_plan(Timestamp wall_now) {
  merging::Extents extents;
  for (const auto& [layer, watched] : watched_)
    extents.emplace(layer, watched.walls.extent(settings_.geometry.cell_size_m));
  const auto change = writer_.update(keeper_.plan(), extents);
  if (!change) return {};
  const std::string text = change->describe();
  spdlog::info("directive {}: {}", change->epoch.value, text);
  send_directive(wall_now);
  return fmt::format("directive {}: {}", change->epoch.value, text);
}

void Coordinator::send_directive(Timestamp wall_now) {
  wire::MergeDirective directive = writer_.directive();
  directive.envelope = directive_stamper_.next(wall_now);
  if (auto sent = channels_.directive->put(directive); !sent)
    spdlog::error("{}", sent.error().text);
  common_map_.place(largest_group(directive), store_);
}

bool Coordinator::idle() const {
  return !worker_.busy() && !schedule_.pending(progress(), keeper_.unchecked());
}

wire::AgentStatus Coordinator::status() const {
  wire::AgentStatus status;
  status.agent_id = settings_.speaker.id.text();
  status.role = wire::Role::coordinator;
  status.state = wire::AgentState::tracking;
  status.samples_refused = refused_ + channels_.tiles->refused() + channels_.poses->refused() +
                           channels_.statuses->refused();
  status.bytes_sent = channels_.bytes_sent ? channels_.bytes_sent() : 0;
  status.epoch_applied = writer_.directive().epoch;
  if (!common_map_.placements().empty()) {
    std::vector<LayerKey> members;
    for (const auto& placement : common_map_.placements()) members.push_back(placement.layer);
    status.fingerprint = sharing::fingerprint(Epoch{status.epoch_applied}, members, store_);
    status.common_map_sha256 = common_map_.sha256();
  }
  for (const auto& [layer, tiles] : store_.layers()) {
    status.layers.push_back({sharing::to_layer_name(layer),
                             static_cast<std::uint32_t>(tiles.size()), store_.digest(layer)});
  }
  status.peers_heard = roster_.present(clock_.steady_now());
  return status;
}

void Coordinator::refuse(const std::string& topic, const Error& error) {
  ++refused_;
  if (refused_ % 1000 == 1)
    spdlog::warn("{}: refused a sample ({} so far): {}", topic, refused_, error.text);
}

}  // namespace lifeline
