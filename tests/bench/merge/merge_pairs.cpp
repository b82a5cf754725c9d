#include "tests/bench/merge/merge_pairs.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

#include <fmt/format.h>

#include "agents/sources/simulator/draw.hpp"
#include "agents/sources/simulator/office.hpp"
#include "common/base/angles.hpp"
#include "common/files/occupancy_image.hpp"
#include "tests/bench/merge/csv_rows.hpp"
#include "tests/support/simulated_maps.hpp"

namespace lifeline::bench {
namespace {

Result<matching::MapFeatures> load_features(const std::filesystem::path& yaml) {
  auto grid = files::read_occupancy_image(yaml);
  if (!grid) return forward_error(grid);
  return matching::build_features(*grid);
}

/// Known squares of half a metre, in the world.
std::vector<std::pair<int, int>> squares_of(const matching::MapFeatures& map,
                                            const Pose2& T_world_map) {
  std::vector<std::pair<int, int>> squares;
  const OccupancyGrid& grid = map.filtered;
  for (int row = 0; row < grid.rows; ++row) {
    for (int column = 0; column < grid.columns; ++column) {
      if (grid.at(column, row) == Occupancy::unknown) continue;
      const Eigen::Vector2d p_map =
          map.origin_map_m + Eigen::Vector2d(column + 0.5, row + 0.5) * grid.cell_size_m;
      const Eigen::Vector2d p = 2.0 * (T_world_map * p_map);
      squares.emplace_back(static_cast<int>(std::floor(p.x())),
                           static_cast<int>(std::floor(p.y())));
    }
  }
  std::sort(squares.begin(), squares.end());
  squares.erase(std::unique(squares.begin(), squares.end()), squares.end());
  return squares;
}

/// Fills in what the two maps share.
void measure_overlap(MergePair& pair, const Pose2& T_world_a, const Pose2& T_world_b) {
  const auto a = squares_of(pair.a, T_world_a), b = squares_of(pair.b, T_world_b);
  std::vector<std::pair<int, int>> both;
  std::set_intersection(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(both));
  if (both.empty()) return;
  pair.overlap =
      static_cast<double>(both.size()) / static_cast<double>(std::min(a.size(), b.size()));
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  for (const auto& [x, y] : both) sum += Eigen::Vector2d(x + 0.5, y + 0.5) / 2.0;
  pair.centre_b_m = T_world_b.inverse() * (sum / static_cast<double>(both.size()));
}

}  // namespace

Result<std::vector<MergePair>> load_pairs(const std::filesystem::path& folder) {
  std::vector<MergePair> pairs;
  for (const CsvRow& row : read_csv(folder / "index.csv")) {
    MergePair pair;
    pair.name = row.at("pair");
    pair.kind = row.at("kind");
    pair.building_a = row.at("building_a");
    pair.building_b = row.at("building_b");
    pair.overlap = number(row, "true_overlap");
    if (!row.at("T_a_b_x_m").empty()) {
      pair.T_a_b =
          Pose2{number(row, "T_a_b_x_m"), number(row, "T_a_b_y_m"), number(row, "T_a_b_yaw_rad")};
      pair.centre_b_m = {number(row, "overlap_centre_b_x_m"), number(row, "overlap_centre_b_y_m")};
    }
    auto a = load_features(folder / (pair.name + "a.yaml"));
    if (!a) return forward_error(a);
    auto b = load_features(folder / (pair.name + "b.yaml"));
    if (!b) return forward_error(b);
    pair.a = *std::move(a);
    pair.b = *std::move(b);
    pairs.push_back(std::move(pair));
  }
  if (pairs.empty()) {
    return fail(ErrorCode::not_found, "{}: no pairs", (folder / "index.csv").string());
  }
  return pairs;
}

std::vector<MergePair> simulate_pairs(int buildings) {
  std::vector<MergePair> pairs;
  sources::Draw draw(31);
  for (int building = 0; building < buildings; ++building) {
    auto plan = sources::generate_office({.seed = static_cast<std::uint64_t>(500 + building),
                                          .width_m = std::round(draw.between(18.0, 36.0)),
                                          .depth_m = std::round(draw.between(14.0, 24.0))});
    if (!plan) continue;
    const auto floor = test::SimulatedFloor::make(*std::move(plan));
    if (!floor) continue;
    for (const double until_s : {20.0, 35.0, 50.0, 80.0}) {
      test::SimulatedView a, b;
      a.walker = {.seed = 3, .walker = 0, .walkers = 2};
      b.walker = {.seed = 3, .walker = 1, .walkers = 2};
      a.until_s = b.until_s = until_s;
      a.T_world_map = {draw.between(-9, 9), draw.between(-9, 9), draw.between(-3, 3)};
      b.T_world_map = {draw.between(-9, 9), draw.between(-9, 9), draw.between(-3, 3)};
      b.noise_seed = 2;
      auto features_a = matching::build_features(floor->map(a));
      auto features_b = matching::build_features(floor->map(b));
      if (!features_a || !features_b) continue;
      MergePair pair{fmt::format("office{}_{:.0f}s", building, until_s),
                     "same",
                     fmt::format("office{}", building),
                     fmt::format("office{}", building),
                     0.0,
                     a.T_world_map.inverse() * b.T_world_map,
                     {0.0, 0.0},
                     *std::move(features_a),
                     *std::move(features_b)};
      measure_overlap(pair, a.T_world_map, b.T_world_map);
      if (pair.overlap < 0.05) pair.kind = "disjoint";
      pairs.push_back(std::move(pair));
    }
  }
  return pairs;
}

JudgedPair judge_pair(const MergePair& pair, const matching::MatchConfig& config) {
  JudgedPair judged{&pair, matching::match_maps(pair.a, pair.b, config), 0.0, 0.0};
  if (!pair.T_a_b || judged.result.candidates.empty()) return judged;
  const Pose2& found = judged.result.candidates.front().T_a_b;
  judged.error_m = (found * pair.centre_b_m - *pair.T_a_b * pair.centre_b_m).norm();
  judged.error_deg = std::abs(normalise_angle(found.yaw_rad - pair.T_a_b->yaw_rad)) / kDegree;
  return judged;
}

}  // namespace lifeline::bench
