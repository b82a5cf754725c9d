#include "agents/sources/simulator/smooth_path.hpp"

#include <algorithm>
#include <cmath>

#include "common/base/check.hpp"

namespace lifeline::sources {
namespace {

constexpr double kPointSpacingM = 0.05;
constexpr double kSidewaysMs2 = 1.0;
constexpr double kBrakingMs2 = 0.8;
constexpr double kCreepMs = 0.1;  ///< never slower than this before the end

double angle_between(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return std::abs(std::atan2(a.x() * b.y() - a.y() * b.x(), a.dot(b)));
}

bool is_free(const FreeSpace& space, std::span<const Eigen::Vector2d> line) {
  for (std::size_t i = 1; i < line.size(); ++i) {
    if (!space.can_go(line[i - 1], line[i])) return false;
  }
  return true;
}

/// A quadratic Bezier curve in place of a corner, as wide as the neighbours and the floor allow;
/// the corner itself where that is not at all, or where the way turns back.
std::vector<Eigen::Vector2d> rounded(const FreeSpace& space, const Eigen::Vector2d& before,
                                     const Eigen::Vector2d& corner, const Eigen::Vector2d& after) {
  constexpr double kWidestM = 0.8, kSharpestTurn = 2.4;
  const Eigen::Vector2d in = corner - before, out = after - corner;
  if (angle_between(in, out) > kSharpestTurn) return {corner};
  double cut_m = std::min({kWidestM, 0.5 * in.norm(), 0.5 * out.norm()});
  for (int attempt = 0; attempt < 4 && cut_m > kPointSpacingM; ++attempt, cut_m *= 0.6) {
    const Eigen::Vector2d first = corner - cut_m * in.normalized();
    const Eigen::Vector2d last = corner + cut_m * out.normalized();
    std::vector<Eigen::Vector2d> curve;
    constexpr int kPieces = 12;
    for (int i = 0; i <= kPieces; ++i) {
      const double u = static_cast<double>(i) / kPieces, w = 1.0 - u;
      curve.push_back(w * w * first + 2.0 * u * w * corner + u * u * last);
    }
    if (is_free(space, curve)) return curve;
  }
  return {corner};
}

}  // namespace

std::vector<Eigen::Vector2d> pull_straight(const FreeSpace& space,
                                           std::span<const std::size_t> way) {
  constexpr double kComfortableM = 0.55;
  constexpr std::size_t kLongest = 160;  // cells of one straight piece: bounds the work
  const auto centre = [&](std::size_t i) { return space.centre(space.cell(way[i])); };
  const auto distance = [&](std::size_t i) { return space.distance_m(space.cell(way[i])); };
  std::vector<Eigen::Vector2d> corners{centre(0)};
  for (std::size_t from = 0; from + 1 < way.size();) {
    std::size_t to = from + 1;
    double least = std::min({kComfortableM, distance(from), distance(to)});
    while (to + 1 < way.size() && to - from < kLongest) {
      least = std::min(least, distance(to + 1));
      if (!space.can_go(centre(from), centre(to + 1), least)) break;
      ++to;
    }
    corners.push_back(centre(to));
    from = to;
  }
  return corners;
}

SmoothPath::SmoothPath(const FreeSpace& space, std::span<const Eigen::Vector2d> corners) {
  LIFELINE_CHECK(corners.size() >= 2);
  const auto add = [&](const Eigen::Vector2d& p) {
    while (!points_.empty() && (p - points_.back().p_world).norm() > 1.5 * kPointSpacingM) {
      const Eigen::Vector2d from = points_.back().p_world;
      points_.push_back({from + kPointSpacingM * (p - from).normalized(), 0.0, 0.0});
    }
    const bool same = !points_.empty() && (p - points_.back().p_world).norm() < 1e-6;
    if (!same) points_.push_back({p, 0.0, 0.0});
  };
  add(corners.front());
  for (std::size_t i = 1; i + 1 < corners.size(); ++i) {
    for (const auto& p : rounded(space, corners[i - 1], corners[i], corners[i + 1])) add(p);
  }
  add(corners.back());
  for (std::size_t i = 1; i < points_.size(); ++i) {
    points_[i].along_m =
        points_[i - 1].along_m + (points_[i].p_world - points_[i - 1].p_world).norm();
  }
  limit_speeds();
}

void SmoothPath::limit_speeds() {
  constexpr double kNoLimit = 10.0;
  for (Point& point : points_) point.speed_limit_m_s = kNoLimit;
  points_.back().speed_limit_m_s = 0.0;
  for (std::size_t i = 1; i + 1 < points_.size(); ++i) {
    const Eigen::Vector2d in = points_[i].p_world - points_[i - 1].p_world;
    const Eigen::Vector2d out = points_[i + 1].p_world - points_[i].p_world;
    const double turn = angle_between(in, out);
    if (turn < 1e-3) continue;
    const double radius_m = 0.5 * (in.norm() + out.norm()) / turn;
    points_[i].speed_limit_m_s = std::max(kCreepMs, std::sqrt(kSidewaysMs2 * radius_m));
  }
  for (std::size_t i = points_.size() - 1; i > 0; --i) {
    const double step_m = points_[i].along_m - points_[i - 1].along_m;
    const double next = points_[i].speed_limit_m_s;
    points_[i - 1].speed_limit_m_s = std::min(points_[i - 1].speed_limit_m_s,
                                              std::sqrt(next * next + 2.0 * kBrakingMs2 * step_m));
  }
}

SmoothPath::Place SmoothPath::find(double along_m) const {
  if (points_.size() == 1) return {0, 0.0};
  const auto after =
      std::lower_bound(points_.begin() + 1, points_.end() - 1, along_m,
                       [](const Point& point, double value) { return point.along_m < value; });
  const double low = (after - 1)->along_m, high = after->along_m;
  return {static_cast<std::size_t>(after - points_.begin()),
          std::clamp((along_m - low) / (high - low), 0.0, 1.0)};
}

Eigen::Vector2d SmoothPath::at(double along_m) const {
  const auto [after, share] = find(along_m);
  if (after == 0) return points_.front().p_world;
  return points_[after - 1].p_world + share * (points_[after].p_world - points_[after - 1].p_world);
}

double SmoothPath::speed_limit_m_s(double along_m) const {
  const auto [after, share] = find(along_m);
  if (after == 0) return 0.0;
  const double low = points_[after - 1].speed_limit_m_s, high = points_[after].speed_limit_m_s;
  return low + share * (high - low);
}

}  // namespace lifeline::sources
