#include "tests/support/scripted_fleet.hpp"

#include <algorithm>

#include "common/base/check.hpp"
#include "common/base/sha256.hpp"
#include "common/sharing/fixed_transform.hpp"
#include "tests/support/fleet_channels.hpp"

namespace lifeline::test {
namespace {

const wire::DirectiveMember& member(const wire::MergeDirective& directive, const std::string& id) {
  const auto found =
      std::find_if(directive.members.begin(), directive.members.end(),
                   [&](const auto& candidate) { return candidate.layer.agent_id == id; });
  LIFELINE_CHECK(found != directive.members.end());
  return *found;
}

}  // namespace

ScriptedHelmet::ScriptedHelmet(const std::string& id, wire::LoopbackBus& bus, const Clock& clock)
    : sharing_(eager_sharing_config(id), helmet_channels(bus), clock) {}

void ScriptedHelmet::show(const TsdGrid& layer) {
  sharing::MapTiles changed;
  for (auto& [tile, cells] : shown_) {
    if (layer.find(tile) == nullptr && *cells != QuantisedTile{}) {
      cells = std::make_shared<const QuantisedTile>();
      changed.emplace_back(tile, cells);
    }
  }
  for (const TileIndex tile : layer.tiles()) {
    const auto cells = std::make_shared<const QuantisedTile>(quantise(*layer.find(tile)));
    auto& shown = shown_[tile];
    if (shown != nullptr && *shown == *cells) continue;
    shown = cells;
    changed.emplace_back(tile, cells);
  }
  sharing_.put(changed);
}

void ScriptedHelmet::step() {
  sharing::HelmetState state;
  state.state = finished_ ? wire::AgentState::finished : wire::AgentState::tracking;
  sharing_.put(std::move(state));
  sharing_.step();
  (void)sharing_.take_peer_update();
}

ScriptedFleet::ScriptedFleet(const std::vector<std::string>& ids, CoordinatorSettings settings,
                             std::unique_ptr<MatchWorker> worker)
    : worker_(std::move(worker)),
      directive_inbox_(bus_.reader<wire::MergeDirective>()),
      evidence_inbox_(bus_.reader<wire::MergeEvidence>()) {
  if (worker_ == nullptr) worker_ = std::make_unique<InlineMatchWorker>(matching::MatchConfig{});
  for (const std::string& id : ids)
    helmets_.emplace(id, std::make_unique<ScriptedHelmet>(id, bus_, clock_));
  coordinator_ = std::make_unique<Coordinator>(std::move(settings), coordinator_channels(bus_),
                                               *worker_, clock_);
}

void ScriptedFleet::run(Duration duration) {
  for (Duration passed{}; passed < duration; passed += kTick) {
    clock_.advance(kTick);
    for (auto& [id, helmet] : helmets_) helmet->step();
    coordinator_->step();
    for (auto& directive : directive_inbox_->take()) directives_.push_back(std::move(directive));
    for (auto& evidence : evidence_inbox_->take()) evidence_.push_back(std::move(evidence));
  }
}

std::string ScriptedFleet::reason(const std::string& a, const std::string& b) const {
  const auto found = std::find_if(evidence_.rbegin(), evidence_.rend(), [&](const auto& evidence) {
    return evidence.a.agent_id == a && evidence.b.agent_id == b;
  });
  return found == evidence_.rend() ? "" : found->reason;
}

std::vector<std::string> ScriptedFleet::group() const {
  std::vector<std::string> ids;
  for (const auto& member : coordinator_->directive().members) {
    if (member.group == 0) ids.push_back(member.layer.agent_id);
  }
  std::sort(ids.begin(), ids.end());
  return ids;
}

Pose2 ScriptedFleet::T_a_b(const std::string& a, const std::string& b) const {
  const auto& directive = coordinator_->directive();
  const auto &at_a = member(directive, a), &at_b = member(directive, b);
  LIFELINE_CHECK(at_a.group == at_b.group);
  return sharing::to_pose(at_a.T_common_map).inverse() * sharing::to_pose(at_b.T_common_map);
}

std::string ScriptedFleet::common_hash(const std::vector<std::string>& ids) const {
  const std::string own = to_hex(coordinator_->common_map().sha256());
  for (const std::string& id : ids) {
    if (to_hex(helmets_.at(id)->sharing().map().common_map_sha256()) != own) return "differ";
  }
  return own;
}

CoordinatorSettings ScriptedFleet::default_settings() {
  return {speaker("coordinator"), GridGeometry{}, {}, {}};
}

}  // namespace lifeline::test
