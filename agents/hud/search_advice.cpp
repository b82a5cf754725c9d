#include "agents/hud/search_advice.hpp"

#include <algorithm>
#include <memory>
#include <utility>

#include "agents/hud/hud_picture.hpp"
#include "common/search/find_seekers.hpp"
#include "common/sharing/fixed_transform.hpp"

namespace lifeline::hud {
namespace {

constexpr Duration kAdviceInterval = std::chrono::seconds(1);
// About two milliseconds.
constexpr std::size_t kTilesAtOnce = 64;

/// T_common_own; where nothing is shared the own map is planned on.
Pose2 place_of_own(const sharing::HelmetSharing& helmet) {
  const auto& members = helmet.map().common_map().placements();
  const auto own = std::ranges::find(members, helmet.layer(), &sharing::Placement::layer);
  return own == members.end() ? Pose2{} : sharing::to_pose(own->T_fused_layer);
}

/// All who could go and look, this helmet's wearer included.
std::vector<search::Seeker> seekers_of(const sharing::HelmetSharing& helmet, SteadyTime now) {
  auto seekers = search::find_seekers(helmet.poses(), helmet.roster(),
                                      helmet.map().common_map().placements(), now);
  if (is_position_known(helmet.state())) {
    const Pose2 T_planned_own = place_of_own(helmet);
    seekers.push_back(
        {helmet.speaker().id.text(), T_planned_own * helmet.state().T_map_head.translation()});
  }
  return seekers;
}

std::unique_ptr<sharing::FusedTile> as_fused(const QuantisedTile& cells) {
  auto tile = std::make_unique<sharing::FusedTile>();
  std::ranges::transform(cells, tile->begin(), [](const QuantisedCell& cell) {
    return sharing::FusedCell{cell.tsd, cell.weight};
  });
  return tile;
}

}  // namespace

void SearchAdvice::follow_map(const sharing::HelmetSharing& helmet) {
  const bool shares = helmet.map().shares();
  if (shares != std::exchange(is_common_, shares)) {
    // Another map, in another frame.
    planner_ = search::SearchPlanner(cell_size_m_);
    own_.clear();
    marked_.clear();
    for (const auto& [tile, cells] : helmet.map().common_map().tiles()) marked_.insert(tile);
  }
  if (!shares) return;
  const auto& tiles = helmet.map().common_map().tiles();
  for (std::size_t done = 0; done < kTilesAtOnce && !marked_.empty(); ++done) {
    const TileIndex tile = *marked_.begin();
    marked_.erase(marked_.begin());
    const auto held = tiles.find(tile);
    planner_.put(tile, held == tiles.end() ? nullptr : &held->second);
  }
}

void SearchAdvice::follow_own_layer(const sharing::HelmetSharing& helmet) {
  const auto* layer = helmet.map().store().find(helmet.layer());
  if (layer == nullptr) return;
  for (const auto& [tile, held] : *layer) {
    if (std::exchange(own_[tile], held.revision) == held.revision) continue;
    planner_.put(tile, as_fused(*held.cells).get());
  }
}

void SearchAdvice::take_plan(const sharing::HelmetSharing& helmet) {
  facts_.reset();
  for (const search::Suggestion& suggestion : planner_.plan().suggestions) {
    if (suggestion.id != helmet.speaker().id.text()) continue;
    facts_ = SearchFacts{T_own_planned_ * planner_.cells().centre_m(suggestion.to.cell),
                         suggestion.to.distance_m};
  }
}

void SearchAdvice::step(const sharing::HelmetSharing& helmet, SteadyTime now) {
  follow_map(helmet);
  if (planner_.is_at_work()) {
    if (planner_.work()) take_plan(helmet);
    return;
  }
  // Half of a map has edges that are none.
  if (now < plan_due_ || !marked_.empty()) return;
  plan_due_ = now + kAdviceInterval;
  if (!is_common_) follow_own_layer(helmet);
  T_own_planned_ = place_of_own(helmet).inverse();
  planner_.begin(seekers_of(helmet, now));
}

}  // namespace lifeline::hud
