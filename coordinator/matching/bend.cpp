#include "coordinator/matching/bend.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>

#include <Eigen/Cholesky>
#include <Eigen/LU>

#include "coordinator/matching/refine.hpp"
#include "coordinator/matching/rigid2f.hpp"

namespace lifeline::matching {
namespace {

using Complex = std::complex<float>;
using Vector5 = Eigen::Matrix<double, 5, 1>;
using Matrix5 = Eigen::Matrix<double, 5, 5>;

/// Wide at first: the ends of bent maps lie up to half a metre apart.
constexpr std::array<float, 4> kSkeletonScales_m{0.35F, 0.25F, 0.18F, 0.12F};
constexpr std::array<float, 3> kWallScales_m{0.08F, 0.05F, 0.05F};
constexpr float kMinSkeletonCosine = 0.8F;
constexpr float kMaxAlongSkeleton_m = 0.3F;
constexpr double kMinWall_m = 1.0;
/// Neighbouring wall points err together, about half a metre of wall at once; both sides count it.
constexpr double kCorrelation_m = 0.5;
constexpr double kMinNoise_m = 0.01;

Complex to_complex(const Eigen::Vector2f& v) {
  return {v.x(), v.y()};
}
Eigen::Vector2f to_vector(const Complex& z) {
  return {z.real(), z.imag()};
}

/// The rigid transform and the bend that follows it; backwards to first order, which is exact
/// enough for rates of a few degrees over a building.
struct BentTransform {
  Pose2 T_a_b;
  Complex k{0.0F, 0.0F};
  Eigen::Vector2f centre = Eigen::Vector2f::Zero();

  [[nodiscard]] Eigen::Vector2f bend(const Eigen::Vector2f& p, float sign) const {
    const Complex z = to_complex(p - centre);
    return p + to_vector(sign * 0.5F * k * z * z);
  }
  [[nodiscard]] Eigen::Vector2f turn(const Eigen::Vector2f& p, const Eigen::Vector2f& normal,
                                     float sign) const {
    const Complex factor = 1.0F + sign * k * to_complex(p - centre);
    return to_vector(factor * to_complex(normal)) / std::sqrt(std::norm(factor));
  }
};

struct Sums {
  Matrix5 information = Matrix5::Zero();
  Vector5 gradient = Vector5::Zero();
  double weight_m = 0.0, squares = 0.0, moment = 0.0;

  /// Wall `from` of b, laid at `rigid` by the rigid part, should lie on `onto` of a.
  void add(const WallPoint& from, const WallPoint& onto, const BentTransform& bent,
           const Rigid2f& transform, float scale_m) {
    const Eigen::Vector2f rigid = transform * from.p;
    const Eigen::Vector2f off = bent.bend(rigid, 1.0F) - onto.p;
    const Eigen::Vector2f normal_b = bent.turn(rigid, transform.turn(from.normal), 1.0F);
    if (onto.normal.dot(normal_b) < kMinSkeletonCosine) return;
    if (std::abs(off.x() * onto.normal.y() - off.y() * onto.normal.x()) > kMaxAlongSkeleton_m)
      return;
    const Eigen::Vector2f normal = (onto.normal + normal_b).normalized();
    const float residual = normal.dot(off), ratio = residual / scale_m;
    const double weight =
        static_cast<double>(from.length_m) / std::pow(1.0 + static_cast<double>(ratio * ratio), 2);
    const Eigen::Vector2f arm = rigid - bent.centre;
    const Complex z = to_complex(arm), half_square = 0.5F * z * z;
    Vector5 jacobian;
    jacobian << normal.x(), normal.y(), arm.x() * normal.y() - arm.y() * normal.x(),
        normal.x() * half_square.real() + normal.y() * half_square.imag(),
        normal.y() * half_square.real() - normal.x() * half_square.imag();
    information += weight * jacobian * jacobian.transpose();
    gradient += weight * static_cast<double>(residual) * jacobian;
    weight_m += weight;
    squares += weight * static_cast<double>(residual * residual);
    moment += weight * static_cast<double>(arm.squaredNorm());
  }
};

Sums collect(const MapFeatures& a, const MapFeatures& b, const BentTransform& bent, float scale_m,
             WallDetail detail) {
  Sums sums;
  const Rigid2f transform(bent.T_a_b), inverse(bent.T_a_b.inverse());
  for (const WallPoint& wall : detail == WallDetail::all ? b.walls : b.skeleton) {
    const Eigen::Vector2f p = transform * wall.p;
    const int i =
        a.field.nearest(bent.bend(p, 1.0F), bent.turn(p, transform.turn(wall.normal), 1.0F));
    if (i == WallField::kNone) continue;
    sums.add(wall, a.walls[static_cast<std::size_t>(i)], bent, transform, scale_m);
  }
  for (const WallPoint& wall : detail == WallDetail::all ? a.walls : a.skeleton) {
    const Eigen::Vector2f p = bent.bend(wall.p, -1.0F);
    const int i = b.field.nearest(inverse * p, inverse.turn(bent.turn(wall.p, wall.normal, -1.0F)));
    if (i == WallField::kNone) continue;
    sums.add(b.walls[static_cast<std::size_t>(i)], wall, bent, transform, scale_m);
  }
  return sums;
}

/// One damped Gauss-Newton step; the turn is about the centre.
void move(const Sums& sums, BentTransform& bent) {
  Matrix5 damped = sums.information;
  Vector5 damping;
  damping << 1e-3, 1e-3, 1e-3, 0.1, 0.1;
  damped.diagonal() += sums.weight_m * damping;
  const Vector5 step = -damped.ldlt().solve(sums.gradient);
  const Eigen::Vector2d centre = bent.centre.cast<double>();
  const Eigen::Vector2d t = centre + step.head<2>() - Pose2{0.0, 0.0, step(2)} * centre;
  bent.T_a_b = Pose2{t.x(), t.y(), step(2)} * bent.T_a_b;
  bent.k += Complex(static_cast<float>(step(3)), static_cast<float>(step(4)));
}

}  // namespace

Bend estimate_bend(const MapFeatures& a, const MapFeatures& b, const Pose2& T_a_b_local,
                   const Eigen::Vector2d& centre_a) {
  constexpr Bend kNothingKnown{0.0, 1.0, 0.0};
  BentTransform bent{T_a_b_local, {}, centre_a.cast<float>()};
  for (const float scale_m : kSkeletonScales_m) {
    const Sums sums = collect(a, b, bent, scale_m, WallDetail::skeleton);
    if (sums.weight_m < kMinWall_m) return kNothingKnown;
    move(sums, bent);
  }
  Sums sums;
  for (const float scale_m : kWallScales_m) {
    sums = collect(a, b, bent, scale_m, WallDetail::all);
    if (sums.weight_m < kMinWall_m) return kNothingKnown;
    move(sums, bent);
  }
  if (!bent.T_a_b.is_finite()) return kNothingKnown;
  const double variance = std::max(kMinNoise_m * kMinNoise_m, sums.squares / sums.weight_m);
  const Matrix5 information = sums.information / (2 * kCorrelation_m * variance);
  const Matrix5 covariance = (information + Matrix5::Identity()).inverse();
  const double rate = static_cast<double>(std::abs(bent.k));
  const double extent_m = 2.0 * std::sqrt(sums.moment / sums.weight_m);
  return {rate, std::sqrt(covariance(3, 3) + covariance(4, 4)), rate * extent_m};
}

}  // namespace lifeline::matching
