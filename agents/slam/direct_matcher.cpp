#include "agents/slam/direct_matcher.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <Eigen/Dense>

namespace lifeline::slam {
namespace {

/// From here on a cell counts as free: no surface within the truncation distance.
constexpr float kFree = 0.95F;
/// Below this a cell lies behind a surface, whatever the noise.
constexpr float kBehind = -0.3F;
/// Beams are followed in steps of so many cells: less than a surface's known thickness.
constexpr float kBeamStep = 2.0F;
/// A beam ends this much before its point, in cells: the surface it hit is its own.
constexpr float kBeamEnd = 8.0F;
/// Of a piece of surface: one this long has weight 1.
constexpr float kTypicalLength_m = 0.2F;

/// The prediction's information about (x, y, yaw).
Eigen::Matrix3d information_of(const Prediction& prior) {
  Eigen::Matrix3d information = Eigen::Matrix3d::Zero();
  information.topLeftCorner<2, 2>() = prior.covariance_xy().inverse();
  information(2, 2) = 1.0 / (prior.sigma_yaw_rad * prior.sigma_yaw_rad);
  return information;
}

/// Adds four quantities of four points each, point by point.
void add_each(std::array<FloatLanes, 4> quantities, FloatLanes& sums) {
  transpose(quantities);
  for (const FloatLanes& of_point : quantities) sums += of_point;
}

/// A pose as the loops over points want it: in cells of the view, as floats.
struct ViewPose {
  ViewPose(const TsdView& view, const Pose2& T_map_head) {
    const Pose2 pose = view.to_view(T_map_head);
    const double per_m = 1.0 / view.geometry().cell_size_m;
    x = static_cast<float>(pose.x_m);
    y = static_cast<float>(pose.y_m);
    c = static_cast<float>(std::cos(pose.yaw_rad) * per_m);
    s = static_cast<float>(std::sin(pose.yaw_rad) * per_m);
  }
  float x, y, c, s;
};

/// The map at four points (DirectMatcher::FourPoints).
template <typename Points>
TsdView::FourSamples sample_at(const TsdView& view, const ViewPose& pose, const Points& points) {
  return view.sample_four(pose.x + pose.c * points.x - pose.s * points.y,
                          pose.y + pose.s * points.x + pose.c * points.y);
}

}  // namespace

void DirectMatcher::set_scan(std::span<const SurfacePiece> pieces) {
  points_.clear();
  const auto most = static_cast<std::size_t>(config_.max_points);
  const std::size_t stride = std::max<std::size_t>(1, (pieces.size() + most - 1) / most);
  for (std::size_t i = stride / 2; i < pieces.size(); i += stride) {
    // Neighbouring points share their errors: a wall seen by many beams is not worth as many walls.
    const float length_m = std::clamp(pieces[i].left_m + pieces[i].right_m, 0.02F, 0.5F);
    points_.push_back(
        {pieces[i].point.x(), pieces[i].point.y(), std::sqrt(length_m / kTypicalLength_m)});
  }
  weight_sum_ = 0.0F;
  for (const Point& point : points_) weight_sum_ += point.weight;
  fours_.assign((points_.size() + kLanes - 1) / kLanes, FourPoints{});
  for (std::size_t i = 0; i < points_.size(); ++i) {
    FourPoints& four = fours_[i / kLanes];
    four.x[i % kLanes] = points_[i].x;
    four.y[i % kLanes] = points_[i].y;
    four.weight[i % kLanes] = points_[i].weight;
  }
}

// Four points are worked out at a time, but summed one after the other: the sums depend on the
// order. A point of weight 0 leaves them as they are.
DirectMatcher::Normal DirectMatcher::linearise(const TsdView& view, const Pose2& T_map_head,
                                               double kernel_m) const {
  const ViewPose pose(view, T_map_head);
  const auto truncation_m = static_cast<float>(view.geometry().truncation_m);
  const auto cell_m = static_cast<float>(view.geometry().cell_size_m);
  const float slope = truncation_m / cell_m;  // of metres of residual per metre of motion
  const auto k2 = static_cast<float>(kernel_m * kernel_m);
  FloatLanes of_x{}, of_y{}, of_turn{};
  for (const FourPoints& point : fours_) {
    const FloatLanes qx = pose.c * point.x - pose.s * point.y;  // from the head, in cells
    const FloatLanes qy = pose.s * point.x + pose.c * point.y;
    const auto sample = view.sample_four(pose.x + qx, pose.y + qy);
    const IntLanes counts = sample.known & (sample.value <= kFree);
    if (!any(counts)) continue;
    const FloatLanes r = sample.value * truncation_m;
    const FloatLanes fade = k2 / (k2 + r * r);
    const FloatLanes w = choose(counts, point.weight * fade * fade, FloatLanes{});
    const FloatLanes jx = slope * sample.gradient_x, jy = slope * sample.gradient_y;
    const FloatLanes jt = (jy * qx - jx * qy) * cell_m;
    const FloatLanes wx = w * jx, wy = w * jy, wt = w * jt;
    add_each({wx * jx, wx * jy, wx * jt, wx * r}, of_x);
    add_each({wy * jy, wy * jt, wy * r, w}, of_y);
    add_each({wt * jt, wt * r, w, w}, of_turn);
  }
  Normal normal;
  const float hxx = of_x[0], hxy = of_x[1], hxt = of_x[2], hyy = of_y[0], hyt = of_y[1],
              htt = of_turn[0];
  normal.H << hxx, hxy, hxt, hxy, hyy, hyt, hxt, hyt, htt;
  normal.g << of_x[3], of_y[2], of_turn[1];
  normal.weight = static_cast<double>(of_y[3]);
  return normal;
}

double DirectMatcher::information_scale(const Normal& normal) const {
  if (normal.weight <= 0.0) return 0.0;
  const double independent = std::min(config_.independent_points, normal.weight);
  return independent / (normal.weight * config_.sigma_m * config_.sigma_m);
}

Pose2 DirectMatcher::align(const TsdView& view, const Pose2& start, const Prediction& prior,
                           int max_iterations) {
  Pose2 pose = start;
  const Eigen::Matrix3d held = information_of(prior);
  double kernel_m = config_.first_kernel_m;
  for (int i = 0; i < max_iterations; ++i) {
    const Normal normal = linearise(view, pose, kernel_m);
    const double scale = information_scale(normal);
    const Eigen::Vector3d off(pose.x_m - prior.T_map_head.x_m, pose.y_m - prior.T_map_head.y_m,
                              normalise_angle(pose.yaw_rad - prior.T_map_head.yaw_rad));
    const Eigen::Matrix3d H = scale * normal.H + held;
    const Eigen::Vector3d g = scale * normal.g + held * off;
    Eigen::Vector3d step = -H.llt().solve(g);
    const double longest = std::max(step.head<2>().norm() / 0.2, std::abs(step.z()) / 0.1);
    if (longest > 1.0) step /= longest;
    pose = {pose.x_m + step.x(), pose.y_m + step.y(), normalise_angle(pose.yaw_rad + step.z())};
    const bool tight = kernel_m <= config_.last_kernel_m;
    if (tight && step.head<2>().norm() < 2e-4 && std::abs(step.z()) < 5e-5) break;
    kernel_m = std::max(config_.last_kernel_m, 0.7 * kernel_m);
  }
  return pose;
}

MatchEvidence DirectMatcher::judge(const TsdView& view, const Pose2& T_map_head,
                                   const Prediction& prior) const {
  const ViewPose pose(view, T_map_head);
  MatchEvidence evidence;
  evidence.points = static_cast<int>(points_.size());
  IntLanes known{}, conflicts{};  // counted backwards: a true comparison is -1
  double error_sum_m = 0.0;
  for (const FourPoints& point : fours_) {
    const auto sample = sample_at(view, pose, point);
    const IntLanes is_known = sample.known & (point.weight > 0.0F);
    const IntLanes is_free = is_known & (sample.value > kFree);
    known += is_known;
    conflicts += is_free;
    const IntLanes compared = is_known & ~is_free;
    for (int i = 0; i < kLanes; ++i) {
      if (compared[i] == 0) continue;
      const double error_m =
          std::abs(static_cast<double>(sample.value[i])) * view.geometry().truncation_m;
      error_sum_m += error_m;
      ++evidence.model_points;
      if (error_m <= config_.inlier_m) ++evidence.inliers;
    }
  }
  evidence.known = -(known[0] + known[1] + known[2] + known[3]);
  evidence.conflicts = -(conflicts[0] + conflicts[1] + conflicts[2] + conflicts[3]);
  if (evidence.model_points > 0) evidence.mean_error_m = error_sum_m / evidence.model_points;
  const Normal normal = linearise(view, T_map_head, config_.last_kernel_m);
  evidence.covariance = (information_scale(normal) * normal.H + information_of(prior)).inverse();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> axes(
      evidence.covariance.topLeftCorner<2, 2>());
  evidence.weakest_sigma_m = std::sqrt(std::max(0.0, axes.eigenvalues().y()));
  return evidence;
}

double DirectMatcher::agreement(const TsdView& view, const Pose2& T_map_head) const {
  const ViewPose pose(view, T_map_head);
  float sum = 0.0F;
  for (const FourPoints& point : fours_) {
    const auto sample = sample_at(view, pose, point);
    const FloatLanes distance = choose(sample.value < 0.0F, -sample.value, sample.value);
    const FloatLanes fit = choose(sample.value > kFree, FloatLanes{} - 0.5F, 1.0F - distance);
    const FloatLanes fits = choose(sample.known, point.weight * fit, FloatLanes{});
    for (int i = 0; i < kLanes; ++i) sum += fits[i];
  }
  return weight_sum_ > 0.0F ? static_cast<double>(sum / weight_sum_) : 0.0;
}

double DirectMatcher::seen_through_walls(const TsdView& view, const Pose2& T_map_head,
                                         double enough) const {
  const ViewPose pose(view, T_map_head);
  const FloatLanes steps = __builtin_convertvector(count_from(0), FloatLanes) * kBeamStep;
  const auto passes = [&](float x, float y, float length) {
    const float end = length - kBeamEnd;
    for (float at = kBeamStep; at < end; at += kLanes * kBeamStep) {
      const FloatLanes along = at + steps, share = along / length;
      const auto column = __builtin_convertvector(pose.x + share * x, IntLanes);
      const auto row = __builtin_convertvector(pose.y + share * y, IntLanes);
      const IntLanes cells = view.four_cells(column, row);
      const FloatLanes value = values_of(cells);
      if (any((along < end) & (cells > kTsdBits) & (value < kBehind))) return true;
    }
    return false;
  };
  float sum = 0.0F;
  for (const Point& point : points_) {
    const float x = pose.c * point.x - pose.s * point.y, y = pose.s * point.x + pose.c * point.y;
    if (!passes(x, y, std::hypot(x, y))) continue;
    sum += point.weight;
    if (static_cast<double>(sum) > enough * static_cast<double>(weight_sum_)) break;
  }
  return weight_sum_ > 0.0F ? static_cast<double>(sum / weight_sum_) : 0.0;
}

}  // namespace lifeline::slam
