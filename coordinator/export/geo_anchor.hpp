#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "common/base/result.hpp"

namespace lifeline {

/// WGS 84, degrees.
struct GeoPoint {
  double latitude_deg = 0.0;
  double longitude_deg = 0.0;
};

/// Where a map lies on the earth, from two of its points whose coordinates are known. Flat: right
/// to a centimetre within a kilometre of them.
class GeoAnchor {
 public:
  /// Two texts `X,Y=LATITUDE,LONGITUDE`. wrong_use, with what to do, where there are not two, one
  /// makes no sense, the points lie closer than 2 m, or their distance on the map is not the one on
  /// the earth (by more than 5 % and half a metre): then one of them is mistaken.
  [[nodiscard]] static Result<GeoAnchor> parse(const std::vector<std::string>& texts);

  [[nodiscard]] GeoPoint to_earth(const Eigen::Vector2d& p_map) const;

 private:
  GeoPoint at_;                           ///< of map_
  Eigen::Vector2d map_{0.0, 0.0};         ///< the middle of both points
  Eigen::Vector2d east_north_{1.0, 0.0};  ///< of the map's x axis, of length 1
  double m_per_deg_latitude_ = 0.0, m_per_deg_longitude_ = 0.0;
};

}  // namespace lifeline
