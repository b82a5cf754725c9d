#include "coordinator/coordinator.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "common/base/log.hpp"
#include "common/grid/occupancy_grid.hpp"
#include "common/sharing/accept.hpp"
#include "common/sharing/groups.hpp"
#include "common/sharing/hear.hpp"
#include "common/wire/limits.hpp"
#include "coordinator/evidence.hpp"

namespace lifeline {
namespace {

constexpr Duration kStatusInterval = std::chrono::seconds(1);
constexpr Duration kCountInterval = std::chrono::milliseconds(500);
// A correction's tiles follow each other closer than this.
constexpr Duration kQuietAfter = std::chrono::seconds(3);
// Who is silent for so long maps no more, as far as anybody can tell: its map is matched as it is.
constexpr Duration kGoneAfter = std::chrono::seconds(30);
constexpr std::size_t kMaxPathPoints = 100'000;

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
      one_way_(settings_.speaker.id),
      link_(settings_.budget_bit_s, channels_.octets_on_air),
      exchange_({settings_.speaker, std::nullopt, 0.5 * settings_.budget_bit_s},
                std::move(channels_.exchange)),
      schedule_(settings_.schedule, settings_.geometry.cell_size_m),
      writer_(settings_.directive, settings_.speaker.mission_id),
      leadership_(settings_.leadership, settings_.speaker.id.text(),
                  settings_.speaker.incarnation.value, started_),
      alerts_(settings_.speaker, wire::Role::coordinator, std::move(channels_.alerts),
              std::move(channels_.alert), clock),
      directive_stamper_(settings_.speaker),
      evidence_stamper_(settings_.speaker),
      status_stamper_(settings_.speaker),
      ruling_stamper_(settings_.speaker) {}

void Coordinator::step() {
  const SteadyTime now = clock_.steady_now();
  hear_directives();
  hear_statuses(now);
  if (!settings_.only_listens) one_way_.step(now, roster_);
  take_part(now);
  alerts_.step(roster_, notes_);
  hear_poses();
  const std::string& mission_id = settings_.speaker.mission_id;
  sharing::hear(channels_.tiles->take(), "tsd_tile", mission_id, now, notes_,
                [&](const wire::TsdTile& sample) { return store_.apply(sample); });
  hear_detections(now);
  link_.measure(now, [this] { return sharing::audience(roster_, settings_.speaker.id, clock_); });
  exchange_.step(now, clock_.wall_now(), roster_, store_, link_);
  note_changes(now);
  if (!settings_.only_listens) {  // who decides nothing needs nothing to decide by
    count_known_cells(now);
    take_outcome(now);
    match_next();
  }
  if (fusing_.is_due(now)) update_common_map();
  if (!settings_.only_listens && now >= status_due_) {
    status_due_ = now + kStatusInterval;
    wire::AgentStatus own = status();
    own.envelope = status_stamper_.next(clock_.wall_now());
    if (auto sent = channels_.status->put(own); !sent) spdlog::warn("{}", sent.error().text);
    said_ = std::move(own);
  }
}

void Coordinator::finish() {
  update_common_map();
}

void Coordinator::update_common_map() {
  const SteadyTime begun = clock_.steady_now();
  for (const TileIndex tile : common_map_.update(store_)) {
    if (map_listener_) map_listener_(tile);
  }
  fusing_.took(begun, clock_.steady_now());
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
    const auto key = sharing::check_pose(pose, settings_.speaker.mission_id);
    if (!key) {
      notes_.refusals.note("pose", key.error());
      continue;
    }
    poses_.hear(pose, clock_.steady_now());
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
      notes_.refusals.note("agent_status", accepted.error());
      continue;
    }
    leadership_.hear(status, now);
    if (status.agent_id == settings_.speaker.id.text()) continue;
    if (!roster_.hear(status, now)) continue;
    note_epoch(status, now);
    keep_followed(status, now);
  }
}

void Coordinator::count_known_cells(SteadyTime now) {
  if (now < count_due_) return;
  count_due_ = now + kCountInterval;
  for (auto& [layer, progress] : progress_) {
    const auto* entry = roster_.find(layer.agent_id.text());
    Watched& watched = watched_.at(layer);
    const SteadyTime heard_at =
        entry == nullptr ? watched.changed_at : std::max(watched.changed_at, entry->heard_at);
    progress.finished = now - heard_at >= kGoneAfter ||
                        (entry != nullptr && entry->status.state == wire::AgentState::finished);
    progress.quiet = now - watched.changed_at >= kQuietAfter;
    if (watched.counted == progress.changes) continue;
    watched.counted = progress.changes;
    progress.known_cells = known_cells(to_grid(*store_.find(layer), settings_.geometry));
  }
}

std::vector<merging::LayerProgress> Coordinator::progress() const {
  std::vector<merging::LayerProgress> all;
  for (const auto& [layer, progress] : progress_) {
    all.push_back(progress);
    all.back().group = keeper_.plan().group_of(layer);
  }
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
  const std::string change = holds_back(now) ? "" : follow_plan(now);
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
  if (!leads()) return;
  wire::MergeEvidence evidence = to_evidence(news.pair, record.result);
  evidence.envelope = evidence_stamper_.next(clock_.wall_now());
  if (auto sent = channels_.evidence->put(evidence); !sent) spdlog::warn("{}", sent.error().text);
}

std::string Coordinator::follow_plan(SteadyTime now) {
  merging::Extents extents;
  for (const auto& [layer, watched] : watched_)
    extents.emplace(layer, watched.walls.extent(settings_.geometry.cell_size_m));
  const auto change = writer_.update(keeper_.plan(), extents);
  if (!change) return {};
  const std::string text = change->describe();
  spdlog::info("directive {}: {}", change->epoch.value, text);
  send_directive(now);
  return fmt::format("directive {}: {}", change->epoch.value, text);
}

void Coordinator::send_directive(SteadyTime now) {
  directive_sent_at_ = now;
  wire::MergeDirective directive = writer_.directive();
  directive.envelope = directive_stamper_.next(clock_.wall_now());
  if (auto sent = channels_.directive->put(directive); !sent)
    spdlog::error("{}", sent.error().text);
  place_common_map();
}

void Coordinator::place_common_map() {
  const wire::MergeDirective& directive = writer_.directive();
  common_map_.place(settings_.seen_by ? sharing::group_of(directive, *settings_.seen_by)
                                      : sharing::largest_group(directive),
                    store_);
  detections_.follow(writer_.directive());
}

bool Coordinator::idle() const {
  return !worker_.busy() && !schedule_.pending(progress(), keeper_.unchecked());
}

wire::AgentStatus Coordinator::status() const {
  wire::AgentStatus status;
  status.agent_id = settings_.speaker.id.text();
  status.role = wire::Role::coordinator;
  status.state = channels_.open_directive ? leadership_.state() : wire::AgentState::tracking;
  status.samples_refused = notes_.refusals.count() + exchange_.refused() +
                           channels_.tiles->refused() + channels_.poses->refused() +
                           channels_.statuses->refused() + channels_.detections->refused() +
                           alerts_.refused();
  status.bytes_sent = channels_.bytes_sent ? channels_.bytes_sent() : 0;
  if (channels_.recording) {
    const sharing::RecordingStatus recording = channels_.recording();
    status.recording = recording.state;
    status.samples_unrecorded = recording.unrecorded;
  }
  status.epoch_applied = writer_.directive().epoch;
  if (!common_map_.placements().empty()) {
    std::vector<LayerKey> members;
    for (const auto& placement : common_map_.placements()) members.push_back(placement.layer);
    status.fingerprint = sharing::fingerprint(Epoch{status.epoch_applied}, members, store_);
    if (common_map_.is_up_to_date()) status.common_map_sha256 = common_map_.sha256();
  }
  for (const auto& [layer, tiles] : store_.layers()) {
    status.layers.push_back({sharing::to_layer_name(layer),
                             static_cast<std::uint32_t>(tiles.size()), store_.digest(layer)});
  }
  roster_.tell_peers(clock_.steady_now(), status);
  return status;
}

}  // namespace lifeline
