#include "coordinator/matching/refine.hpp"

#include <cmath>

#include <Eigen/Cholesky>
#include <Eigen/LU>

#include "coordinator/matching/rigid2f.hpp"

namespace lifeline::matching {
namespace {

constexpr float kMinCosine = 0.8F;
constexpr float kMaxAlong_m = 0.3F;
constexpr double kMinAgreeing_m = 0.5;
/// Neighbouring wall points err together, about half a metre of wall at once.
constexpr double kCorrelation_m = 0.5;
constexpr double kNoise_m = 0.02;
constexpr float kFinalScale_m = 0.05F;

/// The normal equations of one Gauss-Newton step in x, y and yaw.
struct NormalEquations {
  Eigen::Matrix3d information = Eigen::Matrix3d::Zero();
  Eigen::Vector3d gradient = Eigen::Vector3d::Zero();
  double weight_m = 0.0;

  /// Wall `from` of b lies at p_a = T * from and should lie on `onto` of a.
  void add(const WallPoint& from, const WallPoint& onto, const Rigid2f& transform, float scale_m) {
    const Eigen::Vector2f arm = transform.turn(from.p);
    const Eigen::Vector2f off = arm + transform.t - onto.p;
    const Eigen::Vector2f normal_b = transform.turn(from.normal);
    if (onto.normal.dot(normal_b) < kMinCosine) return;
    const float along = off.x() * onto.normal.y() - off.y() * onto.normal.x();
    if (std::abs(along) > kMaxAlong_m) return;
    const Eigen::Vector2f normal = (onto.normal + normal_b).normalized();
    const float residual = normal.dot(off);
    const float ratio = residual / scale_m;
    const float robust = 1.0F / ((1.0F + ratio * ratio) * (1.0F + ratio * ratio));
    const double weight = static_cast<double>(robust * from.length_m);
    const Eigen::Vector3d jacobian(
        normal.x(), normal.y(),
        static_cast<double>(arm.x() * normal.y()) - static_cast<double>(arm.y() * normal.x()));
    information += weight * jacobian * jacobian.transpose();
    gradient += weight * static_cast<double>(residual) * jacobian;
    weight_m += weight;
  }
};

/// Pairs from both sides: b's walls looked up in a, and a's in b.
NormalEquations collect(const MapFeatures& a, const MapFeatures& b, const Pose2& T_a_b,
                        float scale_m, WallDetail detail) {
  NormalEquations equations;
  const Rigid2f transform(T_a_b), inverse(T_a_b.inverse());
  for (const WallPoint& wall : detail == WallDetail::all ? b.walls : b.skeleton) {
    const int i = a.field.nearest(transform * wall.p, transform.turn(wall.normal));
    if (i == WallField::kNone) continue;
    equations.add(wall, a.walls[static_cast<std::size_t>(i)], transform, scale_m);
  }
  for (const WallPoint& wall : detail == WallDetail::all ? a.walls : a.skeleton) {
    const int i = b.field.nearest(inverse * wall.p, inverse.turn(wall.normal));
    if (i == WallField::kNone) continue;
    equations.add(b.walls[static_cast<std::size_t>(i)], wall, transform, scale_m);
  }
  return equations;
}

}  // namespace

Pose2 refine(const MapFeatures& a, const MapFeatures& b, const Pose2& T_a_b,
             std::span<const float> scales_m, WallDetail detail) {
  Pose2 refined = T_a_b;
  for (const float scale_m : scales_m) {
    const NormalEquations equations = collect(a, b, refined, scale_m, detail);
    if (equations.weight_m < kMinAgreeing_m) return T_a_b;
    // A trace of damping, so that a bare corridor does not slide away.
    const double damping = 1e-3 * equations.weight_m;
    const Eigen::Matrix3d damped = equations.information + damping * Eigen::Matrix3d::Identity();
    const Eigen::Vector3d step = -damped.ldlt().solve(equations.gradient);
    refined.x_m += step.x();
    refined.y_m += step.y();
    refined.yaw_rad = normalise_angle(refined.yaw_rad + step.z());
  }
  return refined.is_finite() ? refined : T_a_b;
}

Eigen::Matrix3d covariance_in_map_frames(const MapFeatures& a, const MapFeatures& b,
                                         const Pose2& T_a_b) {
  const NormalEquations equations = collect(a, b, T_a_b, kFinalScale_m, WallDetail::all);
  // Both sides count the same wall; and of each correlated stretch only one piece is news.
  const Eigen::Matrix3d information =
      equations.information / (2 * kCorrelation_m * kNoise_m * kNoise_m);
  const Eigen::Matrix3d local = (information + Eigen::Matrix3d::Identity()).inverse();
  // The map frames lie elsewhere: a turn moves the translation too.
  const double c = std::cos(T_a_b.yaw_rad), s = std::sin(T_a_b.yaw_rad);
  const Eigen::Vector2d& origin = b.origin_map_m;
  Eigen::Matrix3d jacobian = Eigen::Matrix3d::Identity();
  jacobian(0, 2) = s * origin.x() + c * origin.y();
  jacobian(1, 2) = s * origin.y() - c * origin.x();
  return jacobian * local * jacobian.transpose();
}

}  // namespace lifeline::matching
