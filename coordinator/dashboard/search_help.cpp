#include "coordinator/dashboard/search_help.hpp"

#include <cmath>

#include "common/search/find_seekers.hpp"
#include "coordinator/dashboard/zstd_frame.hpp"
#include "idl/dashboard.pb.h"

namespace lifeline::dashboard {
namespace {

namespace pb = proto::dashboard;

constexpr Duration kPlanInterval = std::chrono::seconds(1);
// About two milliseconds.
constexpr std::size_t kTilesAtOnce = 64;

/// Points as the page takes them: the first, then differences.
template <typename Field>
void add_points(const std::vector<Eigen::Vector2d>& points_m, Field& points_cm) {
  Eigen::Vector2i before(0, 0);
  for (const Eigen::Vector2d& p : points_m) {
    const Eigen::Vector2i cm = (100.0 * p).array().round().cast<int>();
    points_cm.Add(cm.x() - before.x());
    points_cm.Add(cm.y() - before.y());
    before = cm;
  }
}

void add_coordinate(std::string& text, std::int32_t value) {
  const auto bits = static_cast<std::uint16_t>(value);
  text += static_cast<char>(bits & 0xffU);
  text += static_cast<char>(bits >> 8U);
}

std::string pack(const std::map<TileIndex, search::WhoSearched::Owners>& owners) {
  std::string plain;
  for (const auto& [tile, squares] : owners) {
    add_coordinate(plain, tile.x);
    add_coordinate(plain, tile.y);
    plain.append(squares.begin(), squares.end());
  }
  return plain.empty() ? plain : to_zstd(plain);
}

}  // namespace

SearchHelp::SearchHelp(const Coordinator& coordinator)
    : coordinator_(coordinator),
      planner_(coordinator.store().geometry().cell_size_m),
      who_(coordinator.store().geometry().cell_size_m) {}

void SearchHelp::note(const LayerKey& layer, TileIndex tile, const QuantisedTile& cells) {
  who_.note(layer, tile, cells);
  const double cell_m = coordinator_.store().geometry().cell_size_m;
  for (const auto& [placed, T_common_layer] : coordinator_.common_map().placements()) {
    if (placed != layer) continue;
    const auto touched = sharing::tiles_touched(tile, T_common_layer, std::llround(cell_m * 1e6));
    marked_.insert(touched.begin(), touched.end());
  }
}

void SearchHelp::follow_map() {
  const auto& map = coordinator_.common_map();
  if (who_.place(map.placements())) {
    for (const auto& [tile, cells] : map.tiles()) marked_.insert(tile);
  }
  for (std::size_t done = 0; done < kTilesAtOnce && !marked_.empty(); ++done) {
    const TileIndex tile = *marked_.begin();
    marked_.erase(marked_.begin());
    const auto held = map.tiles().find(tile);
    const auto* cells = held == map.tiles().end() ? nullptr : &held->second;
    planner_.put(tile, cells);
    who_.refresh(tile, cells);
  }
}

bool SearchHelp::step(SteadyTime now, bool is_watched) {
  follow_map();
  if (!is_watched) return false;
  if (planner_.is_at_work()) return planner_.work();
  if (now >= plan_due_) {
    plan_due_ = now + kPlanInterval;
    planner_.begin(search::find_seekers(coordinator_.poses(), coordinator_.roster(),
                                        coordinator_.common_map().placements(), now));
  }
  return false;
}

std::string SearchHelp::frame() const {
  pb::ServerFrame frame;
  auto& search = *frame.mutable_search();
  search.set_searched_m2(static_cast<float>(who_.searched_m2()));
  const search::SearchPlan& plan = planner_.plan();
  for (const search::Part& part : plan.parts.parts) {
    for (const auto& line : search::outline_m(part, planner_.cells()))
      add_points(line, *search.add_frontiers()->mutable_points_cm());
  }
  for (const search::Suggestion& suggestion : plan.suggestions) {
    auto& told = *search.add_suggestions();
    told.set_agent_id(suggestion.id);
    told.set_distance_m(static_cast<float>(suggestion.to.distance_m));
    add_points(suggestion.to.way_m, *told.mutable_way_cm());
  }
  for (const search::SearchShare& share : who_.shares()) {
    auto& told = *search.add_shares();
    told.set_agent_id(share.id);
    told.set_first_m2(static_cast<float>(share.first_m2));
    told.set_seen_m2(static_cast<float>(share.seen_m2));
  }
  search.set_owners(pack(who_.owners()));
  return frame.SerializeAsString();
}

}  // namespace lifeline::dashboard
