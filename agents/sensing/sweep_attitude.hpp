#pragma once

#include <cstddef>
#include <optional>

#include <Eigen/Geometry>

#include "agents/sensing/raw_scan.hpp"

namespace lifeline::sensing {

/// How the head was held at any time of one sweep: R_head_body, where head is level and keeps the
/// heading of the stamp. Interpolated between the sweep's attitudes, held before and after them.
class SweepAttitude {
 public:
  /// `raw` must outlive this. Steeper than max_tilt_rad at an attitude: unknown around it.
  SweepAttitude(const RawScan& raw, double max_tilt_rad);

  /// Whether it is the same at all times.
  [[nodiscard]] bool is_constant() const { return constant_; }

  /// Whether it also tells how the head turned. An attitude whose yaw is not finite tells of roll
  /// and pitch alone.
  [[nodiscard]] bool knows_turn() const { return !constant_ && knows_yaw_; }

  /// Ask in the order of time. Empty where the head was held too steeply, or an attitude is not
  /// finite.
  [[nodiscard]] std::optional<Eigen::Matrix3d> at(Duration after_stamp);

 private:
  struct Knot {
    Duration after_stamp{};
    std::optional<Eigen::Quaterniond> R_head_body;
  };
  [[nodiscard]] Knot knot(std::size_t index) const;

  const RawScan& raw_;
  double max_tilt_rad_;
  bool constant_;
  bool knows_yaw_;
  std::size_t next_ = 0;  ///< into later_attitudes: the knot behind after_
  Knot before_, after_;
};

}  // namespace lifeline::sensing
