#pragma once

#include <limits>
#include <optional>
#include <span>

#include "agents/slam/global_search.hpp"

namespace lifeline::support {

/// Goes on with `advance(work)` until it is done, `at_once` steps at a time; how often it had to.
template <typename Advance>
int advance_all(Advance&& advance,
                slam::SearchWork at_once = std::numeric_limits<slam::SearchWork>::max()) {
  for (int times = 1;; ++times) {
    slam::SearchWork work = at_once;
    if (advance(work)) return times;
  }
}

inline void take_map(slam::FitField& field, const slam::WorkingMap& map,
                     const slam::FitFieldConfig& config = {}) {
  field.begin(map, config);
  advance_all([&](slam::SearchWork& work) { return field.advance(map, work); });
}
inline void take_map(slam::GlobalSearch& search, const slam::WorkingMap& map) {
  search.begin_map(map);
  advance_all([&](slam::SearchWork& work) { return search.advance_map(map, work); });
}

/// A whole search at once.
inline slam::GlobalSearchResult search_all(slam::GlobalSearch& search,
                                           std::span<const Eigen::Vector2d> points, double yaw_rad,
                                           double window_rad,
                                           const std::optional<slam::SearchCircle>& circle = {}) {
  search.begin(points, yaw_rad, window_rad, circle);
  advance_all([&](slam::SearchWork& work) { return search.advance(work); });
  return search.result();
}

}  // namespace lifeline::support
