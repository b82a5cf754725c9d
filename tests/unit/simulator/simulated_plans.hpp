#pragma once

#include <algorithm>
#include <filesystem>
#include <initializer_list>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "agents/sensing/scan_source.hpp"
#include "agents/sources/simulator/plan.hpp"
#include "agents/sources/simulator/simulated_source.hpp"

namespace lifeline::support {

/// Closes the corners into a loop of walls.
inline void add_loop(sources::FloorPlan& plan, const std::vector<Eigen::Vector2d>& corners) {
  for (std::size_t i = 0; i < corners.size(); ++i) {
    plan.walls.push_back({corners[i], corners[(i + 1) % corners.size()]});
  }
}

/// A bare room from the origin to (width_m, depth_m).
inline sources::FloorPlan room(double width_m, double depth_m) {
  sources::FloorPlan plan;
  plan.name = "room";
  add_loop(plan, {{0.0, 0.0}, {width_m, 0.0}, {width_m, depth_m}, {0.0, depth_m}});
  return plan;
}

/// Two rooms of 4 m x 4 m beside each other, x = 0 ... 4 and 4.1 ... 8.1, joined by a doorway of
/// the given width in the middle of the wall between them (y = 2).
inline sources::FloorPlan two_rooms(double doorway_m) {
  sources::FloorPlan plan;
  plan.name = "two rooms";
  const double low = 2.0 - 0.5 * doorway_m, high = 2.0 + 0.5 * doorway_m;
  add_loop(plan, {{0.0, 0.0},
                  {4.0, 0.0},
                  {4.0, low},
                  {4.1, low},
                  {4.1, 0.0},
                  {8.1, 0.0},
                  {8.1, 4.0},
                  {4.1, 4.0},
                  {4.1, high},
                  {4.0, high},
                  {4.0, 4.0},
                  {0.0, 4.0}});
  return plan;
}

/// The HouseExpo plans beside the project, sorted by name; empty where there are none.
inline std::vector<std::filesystem::path> houseexpo_files() {
  std::vector<std::filesystem::path> files;
  std::error_code none;
  const std::filesystem::path folder = LIFELINE_SOURCE_DIR "/../shared/data/floorplans/houseexpo";
  for (const auto& entry : std::filesystem::directory_iterator(folder, none)) {
    if (entry.path().extension() == ".json") files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

/// What a source that has to open gives, to its end or for at most `most` scans.
inline std::vector<sensing::RawScan> scans_of(const std::string& source,
                                              std::size_t most = 100'000) {
  auto opened = sources::open_simulated_source(sources::parse_source_spec(source).value()).value();
  std::vector<sensing::RawScan> scans;
  while (scans.size() < most) {
    auto scan = opened->next().value();
    if (!scan) break;
    scans.push_back(*std::move(scan));
  }
  return scans;
}

}  // namespace lifeline::support
