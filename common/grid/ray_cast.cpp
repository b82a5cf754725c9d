#include "common/grid/ray_cast.hpp"

#include <algorithm>
#include <cmath>

namespace lifeline {
namespace {

/// A walk along one ray, in cells from the view's corner.
class RayWalk {
 public:
  RayWalk(const TsdView& view, const Eigen::Vector2f& from, const Eigen::Vector2f& along)
      : view_(view), from_(from), along_(along) {}

  /// The distance at which the surface is met, or a negative number.
  [[nodiscard]] float walk(float max_range) {
    const auto truncation =
        static_cast<float>(view_.geometry().truncation_m / view_.geometry().cell_size_m);
    float before = -1.0F;  // value at the last step, if it was known and free
    float before_at = 0.0F;
    for (float at = 0.0F; at <= max_range;) {
      float step = 0.5F;
      if (sample(at)) {
        if (before > 0.0F && sample_.value <= 0.0F) {
          return refine(before_at, before, at, sample_.value);
        }
        before = sample_.value;
        before_at = at;
        // The nearest surface is this far away, or further: nothing is missed in between.
        step = std::max(0.25F, 0.8F * truncation * std::max(sample_.value, 0.0F));
      } else {
        before = -1.0F;
      }
      at += step;
    }
    return -1.0F;
  }

  [[nodiscard]] bool sample(float at) {
    return view_.sample(from_.x() + at * along_.x(), from_.y() + at * along_.y(), sample_);
  }
  [[nodiscard]] const TsdView::Sample& last() const { return sample_; }

 private:
  /// The zero between two samples of different sign; one more look makes up for the kink between
  /// cells.
  [[nodiscard]] float refine(float low, float low_value, float high, float high_value) {
    for (int i = 0; i < 2; ++i) {
      const float at = low + (high - low) * low_value / (low_value - high_value);
      if (!sample(at)) return at;
      if (sample_.value > 0.0F) {
        low = at;
        low_value = sample_.value;
      } else {
        high = at;
        high_value = sample_.value;
      }
    }
    return low + (high - low) * low_value / (low_value - high_value);
  }

  const TsdView& view_;
  Eigen::Vector2f from_;
  Eigen::Vector2f along_;
  TsdView::Sample sample_{0.0F, Eigen::Vector2f::Zero()};
};

}  // namespace

std::optional<RayHit> cast_ray(const TsdView& view, const Eigen::Vector2d& from_map,
                               double angle_rad, double max_range_m) {
  const Pose2 from = view.to_view({from_map.x(), from_map.y(), 0.0});
  const Eigen::Vector2f along(static_cast<float>(std::cos(angle_rad)),
                              static_cast<float>(std::sin(angle_rad)));
  const Eigen::Vector2f start = from.translation().cast<float>();
  const double cell_m = view.geometry().cell_size_m;
  RayWalk walk(view, start, along);
  const float at = walk.walk(static_cast<float>(max_range_m / cell_m));
  if (at < 0.0F) return std::nullopt;
  // The last sample of the walk lies within a fraction of a cell: its gradient will do where the
  // very place cannot be sampled.
  (void)walk.sample(at);
  const Eigen::Vector2f& gradient = walk.last().gradient;
  const float length = gradient.norm();
  const Eigen::Vector2f normal =
      length > 1e-6F ? Eigen::Vector2f(gradient / length) : Eigen::Vector2f(-along);
  return RayHit{view.to_map(start + at * along), normal.cast<double>(),
                static_cast<double>(at) * cell_m};
}

std::vector<RayHit> ray_cast(const TsdView& view, const Pose2& T_map_head, const Scan2& scan,
                             double max_range_m) {
  std::vector<RayHit> model;
  model.reserve(scan.beams.size());
  for (const Beam2& beam : scan.beams) {
    const auto hit =
        cast_ray(view, T_map_head.translation(),
                 T_map_head.yaw_rad + static_cast<double>(beam.angle_rad), max_range_m);
    if (hit) model.push_back(*hit);
  }
  return model;
}

}  // namespace lifeline
