#include "agents/ahrs/rate_check.hpp"

#include <cmath>
#include <numbers>

#include "common/base/angles.hpp"

namespace lifeline::ahrs {
namespace {

bool is_near(double ratio, double expected) {
  return ratio > 0.7 * expected && ratio < 1.4 * expected;
}

}  // namespace

void RateCheck::add(const AhrsReading& reading, SteadyTime stamp) {
  if (!reading.rate_rad_s) return;
  if (last_ && stamp > last_->stamp && stamp - last_->stamp <= kLongest) {
    const double dt_s = to_seconds(stamp - last_->stamp);
    const Eigen::AngleAxisd step(last_->reading.R_world_body.conjugate() * reading.R_world_body);
    const double angle_rad = std::remainder(step.angle(), 2.0 * std::numbers::pi);
    const Eigen::Vector3d turn = angle_rad * step.axis();
    const Eigen::Vector3d rate = 0.5 * dt_s * (*last_->reading.rate_rad_s + *reading.rate_rad_s);
    turned_rad_ += std::abs(angle_rad);
    both_ += turn.dot(rate);
    turn2_ += turn.squaredNorm();
    rate2_ += rate.squaredNorm();
    seconds_ += dt_s;
    ++steps_;
  }
  last_ = {reading, stamp};
  if (turned_rad_ >= kEnoughRad) judge();
}

void RateCheck::judge() {
  // turn = ratio * integrated rate, by least squares; and how well that explains the turns.
  const double ratio = rate2_ > 0.0 ? both_ / rate2_ : 0.0;
  const double agreement = rate2_ > 0.0 ? both_ / std::sqrt(turn2_ * rate2_) : 0.0;
  // Of a rate in deg per sample that is taken for deg/s.
  const double samples_per_s = seconds_ > 0.0 ? steps_ / seconds_ : 0.0;
  RateUnit found = RateUnit::disagree;
  if (agreement > 0.8) {
    if (is_near(ratio, 1.0)) found = RateUnit::as_stated;
    if (is_near(ratio, kDegree)) found = RateUnit::degrees;
    if (is_near(ratio, samples_per_s)) found = RateUnit::per_sample;
    if (is_near(ratio, 1.0 / kDegree)) found = RateUnit::radians;
  }
  if (found == newest_) unit_ = found;
  newest_ = found;
  turned_rad_ = both_ = turn2_ = rate2_ = seconds_ = 0.0;
  steps_ = 0;
}

}  // namespace lifeline::ahrs
