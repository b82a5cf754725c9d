#include "coordinator/export/geojson_file.hpp"

#include <cmath>

#include <nlohmann/json.hpp>

#include "common/files/finds_json.hpp"

namespace lifeline {
namespace {

using Json = nlohmann::ordered_json;

constexpr double kPathStepM = 0.1;

/// Longitude first; a hundredth of a metre is enough.
Json position(const GeoAnchor& anchor, const Eigen::Vector2d& p_map) {
  const GeoPoint at = anchor.to_earth(p_map);
  const auto rounded = [](double degrees) { return std::round(degrees * 1e7) / 1e7; };
  return {rounded(at.longitude_deg), rounded(at.latitude_deg)};
}

Json feature(Json geometry, Json properties) {
  return {{"type", "Feature"},
          {"geometry", std::move(geometry)},
          {"properties", std::move(properties)}};
}

/// Walls as lines through their cells: each row's runs of several, and each column's of the rest.
class WallLines {
 public:
  WallLines(const OccupancyGrid& grid, const GeoAnchor& anchor) : grid_(grid), anchor_(anchor) {
    std::vector<bool> drawn(grid.cells.size(), false);
    for (int row = 0; row < grid.rows; ++row) {
      for (int column = 0; column < grid.columns; ++column) {
        const int first = column;
        while (is_wall(column, row)) ++column;
        if (column - first < 2) continue;
        for (int c = first; c < column; ++c) drawn[grid.index(c, row)] = true;
        add(first, row, column - 1, row);
      }
    }
    for (int column = 0; column < grid.columns; ++column) {
      for (int row = 0; row < grid.rows; ++row) {
        const int first = row;
        bool any_left = false;
        for (; is_wall(column, row); ++row) any_left = any_left || !drawn[grid.index(column, row)];
        if (any_left) add(column, first, column, row - 1);
      }
    }
  }
  [[nodiscard]] Json take() { return std::move(lines_); }

 private:
  [[nodiscard]] bool is_wall(int column, int row) const {
    return grid_.at(column, row) == Occupancy::occupied;
  }
  void add(int column_a, int row_a, int column_b, int row_b) {
    // A single cell becomes a line of its own length: two equal positions are no line.
    const double reach = column_a == column_b && row_a == row_b ? 0.5 : 0.0;
    lines_.push_back({corner(column_a - reach, row_a), corner(column_b + reach, row_b)});
  }
  [[nodiscard]] Json corner(double column, double row) const {
    const Eigen::Vector2d middle(column + 0.5, row + 0.5);
    return position(anchor_, grid_.origin_m + grid_.cell_size_m * middle);
  }

  const OccupancyGrid& grid_;
  const GeoAnchor& anchor_;
  Json lines_ = Json::array();
};

Json path_feature(const MissionStory& story, const HelmetTrack& track, const GeoAnchor& anchor) {
  Json line = Json::array();
  std::optional<Eigen::Vector2d> last;
  const std::vector<StampedPose> poses = track.placed();
  for (const StampedPose& at : poses) {
    const Eigen::Vector2d here = at.pose.translation();
    const bool is_end = &at == &poses.back() && last && here != *last;
    if (last && !is_end && (here - *last).norm() < kPathStepM) continue;
    line.push_back(position(anchor, here));
    last = here;
  }
  if (line.size() < 2) return {};
  return feature({{"type", "LineString"}, {"coordinates", std::move(line)}},
                 {{"what", "path"},
                  {"helmet", track.layer.agent_id.text()},
                  {"map_id", track.layer.map_id.value},
                  {"floor", track.layer.floor.value},
                  {"begin_s", to_seconds(track.poses.front().stamp - story.first)},
                  {"end_s", to_seconds(track.poses.back().stamp - story.first)}});
}

}  // namespace

std::string to_geojson(const MissionStory& story, const GeoAnchor& anchor) {
  Json features = Json::array();
  if (!story.maps.empty()) {
    const StoryMap& map = story.maps.front();
    features.push_back(
        feature({{"type", "MultiLineString"}, {"coordinates", WallLines(map.grid, anchor).take()}},
                {{"what", "wall"}, {"title", map.title}}));
    for (const std::size_t track : map.tracks) {
      if (Json path = path_feature(story, story.tracks[track], anchor); !path.is_null())
        features.push_back(std::move(path));
    }
  }
  for (auto& find : files::to_json(story.finds)) {
    if (find.at("frame") != "common") continue;
    Json properties = find;
    properties["what"] = "detection";
    features.push_back(feature({{"type", "Point"},
                                {"coordinates", position(anchor, {find.at("x_m").get<double>(),
                                                                  find.at("y_m").get<double>()})}},
                               std::move(properties)));
  }
  const Json collection{{"type", "FeatureCollection"}, {"features", std::move(features)}};
  return collection.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace lifeline
