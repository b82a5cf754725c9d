#include "coordinator/matching/wall_points.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace lifeline::matching {
namespace {

/// Points of one square that look roughly the same way.
struct Cluster {
  Eigen::Vector2f p = Eigen::Vector2f::Zero();
  Eigen::Vector2f normal = Eigen::Vector2f::Zero();
  float count = 0.0F;
};

/// Adds the point to the cluster that looks the same way, or opens a new one.
void add_to_clusters(const WallPoint& point, std::vector<Cluster>& clusters) {
  const auto same_way = [&](const Cluster& c) {
    return c.normal.dot(point.normal) > 0.6F * c.normal.norm();
  };
  auto cluster = std::find_if(clusters.begin(), clusters.end(), same_way);
  if (cluster == clusters.end()) cluster = clusters.insert(clusters.end(), Cluster{});
  cluster->p += point.p;
  cluster->normal += point.normal;
  cluster->count += 1.0F;
}

struct Keyed {
  std::uint64_t square;
  std::uint32_t index;
  auto operator<=>(const Keyed&) const = default;
};

/// The points' indices, ordered by the square they lie in.
std::vector<Keyed> order_by_square(const std::vector<WallPoint>& points, float spacing_m) {
  std::vector<Keyed> keyed;
  keyed.reserve(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    constexpr std::int64_t kBias = 1LL << 30;  // keeps negative squares in order
    const auto x = static_cast<std::int64_t>(std::floor(points[i].p.x() / spacing_m)) + kBias;
    const auto y = static_cast<std::int64_t>(std::floor(points[i].p.y() / spacing_m)) + kBias;
    keyed.push_back({(static_cast<std::uint64_t>(y) << 32U) | static_cast<std::uint64_t>(x),
                     static_cast<std::uint32_t>(i)});
  }
  std::sort(keyed.begin(), keyed.end());
  return keyed;
}

}  // namespace

std::vector<WallPoint> thin_out(const std::vector<WallPoint>& points, float spacing_m) {
  const std::vector<Keyed> keyed = order_by_square(points, spacing_m);
  std::vector<WallPoint> thinned;
  std::vector<Cluster> clusters;
  for (std::size_t i = 0; i < keyed.size(); ++i) {
    add_to_clusters(points[keyed[i].index], clusters);
    if (i + 1 < keyed.size() && keyed[i + 1].square == keyed[i].square) continue;
    for (const Cluster& cluster : clusters) {
      const Eigen::Vector2f normal = cluster.normal.normalized();
      // A line crosses (|nx| + |ny|) / spacing squares per metre.
      const float length_m = spacing_m / (std::abs(normal.x()) + std::abs(normal.y()));
      thinned.push_back({cluster.p / cluster.count, normal, length_m});
    }
    clusters.clear();
  }
  return thinned;
}

}  // namespace lifeline::matching
