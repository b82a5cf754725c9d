#include "agents/sources/simulator/walk.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "common/base/angles.hpp"
#include "common/base/check.hpp"

namespace lifeline::sources {
namespace {

constexpr double kStepS = 0.01;
constexpr double kSpeedUpMs2 = 0.8;
constexpr double kSlowDownMs2 = WalkLimits::kAccelerationMs2;
constexpr double kBodyTurnRadS = 72.0 * kDegree;
constexpr double kTurnUpRadS2 = 240.0 * kDegree;
constexpr double kLookAheadM = 0.5;

HeadMotion::Style style_of(Walk::Head head) {
  if (head == Walk::Head::crawling) return HeadMotion::Style::crawling;
  return head == Walk::Head::natural ? HeadMotion::Style::natural : HeadMotion::Style::nodding;
}

/// `value` moved towards `target` by at most `down` or `up`.
double approach(double value, double target, double down, double up) {
  return std::clamp(target, value - down, value + up);
}

}  // namespace

Walk::Walk(const FreeSpace& space, const WalkerNumber& number, Head head)
    : space_(space),
      tour_(space, number),
      draw_(stir(stir(number.seed, 4), static_cast<std::uint64_t>(number.walker))),
      sways_{{7.0 * kDegree, draw_.between(3.8, 4.6), draw_.between(0.0, 2.0 * std::numbers::pi)},
             {5.0 * kDegree, draw_.between(6.2, 7.4), draw_.between(0.0, 2.0 * std::numbers::pi)}},
      cruise_m_s_(draw_.between(1.0, WalkLimits::kSpeedMs)),
      heading_rad_(draw_.between(-std::numbers::pi, std::numbers::pi)) {
  if (head == Head::crawling) cruise_m_s_ *= kCrawlingPace;
  begin_round();
  if (head != Head::still) {
    motion_.emplace(stir(stir(number.seed, 5), static_cast<std::uint64_t>(number.walker)),
                    style_of(head));
  }
  before_ = now_ = this->head();
}

HeadPose Walk::head_at(double t_s) {
  while (static_cast<double>(steps_) * kStepS < t_s) {
    before_ = now_;
    step();
    ++steps_;
    now_ = head();
  }
  const double share = std::clamp(t_s / kStepS - static_cast<double>(steps_ - 1), 0.0, 1.0);
  const Pose2 &from = before_.T_world_head, &to = now_.T_world_head;
  return {{from.x_m + share * (to.x_m - from.x_m), from.y_m + share * (to.y_m - from.y_m),
           normalise_angle(from.yaw_rad + share * normalise_angle(to.yaw_rad - from.yaw_rad))},
          before_.roll_rad + share * (now_.roll_rad - before_.roll_rad),
          before_.pitch_rad + share * (now_.pitch_rad - before_.pitch_rad),
          before_.raised_m + share * (now_.raised_m - before_.raised_m)};
}

void Walk::begin_round() {
  constexpr double kPauseS = 1.0;
  const std::size_t from = tour_.start();
  std::vector<Eigen::Vector2d> corners{space_.centre(space_.cell(from))};
  for (const auto& way : tour_.next_round()) {
    const std::vector<Eigen::Vector2d> leg = pull_straight(space_, way);
    corners.insert(corners.end(), leg.begin() + 1, leg.end());
  }
  // A floor that is seen from one place: standing there is the whole round.
  if (corners.size() == 1) corners.push_back(corners.front());
  path_.emplace(space_, corners);
  along_m_ = 0.0;
  speed_m_s_ = 0.0;
  standing_s_ = kPauseS;
  ++rounds_;
}

double Walk::wanted_heading() const {
  // Where the path turns back, the point ahead is no help: then further along.
  for (double ahead_m = kLookAheadM; ahead_m < 4.0 * kLookAheadM; ahead_m += 0.25 * kLookAheadM) {
    const Eigen::Vector2d to = path_->at(along_m_ + ahead_m) - path_->at(along_m_);
    if (to.norm() > 0.4 * kLookAheadM) return std::atan2(to.y(), to.x());
  }
  return heading_rad_;
}

void Walk::step() {
  constexpr double kAtEndM = 0.01;
  if (path_->length_m() - along_m_ < kAtEndM && standing_s_ <= 0.0) begin_round();
  const double error = normalise_angle(wanted_heading() - heading_rad_);
  const double turn = std::clamp(2.5 * error, -kBodyTurnRadS, kBodyTurnRadS);
  const double most_change = kTurnUpRadS2 * kStepS;
  turn_rad_s_ = approach(turn_rad_s_, turn, most_change, most_change);
  heading_rad_ = normalise_angle(heading_rad_ + turn_rad_s_ * kStepS);

  // Nobody walks on at full speed looking elsewhere: slower from 40 deg, not at all from 100 deg.
  const double facing =
      std::clamp((100.0 * kDegree - std::abs(error)) / (60.0 * kDegree), 0.0, 1.0);
  double speed = std::min(cruise_m_s_, path_->speed_limit_m_s(along_m_)) * facing;
  if (standing_s_ > 0.0) {
    standing_s_ -= kStepS;
    speed = 0.0;
  }
  speed_m_s_ = approach(speed_m_s_, speed, kSlowDownMs2 * kStepS, kSpeedUpMs2 * kStepS);
  along_m_ = std::min(along_m_ + speed_m_s_ * kStepS, path_->length_m());
}

HeadPose Walk::head() const {
  const Eigen::Vector2d p = path_->at(along_m_);
  const double t_s = static_cast<double>(steps_) * kStepS;
  double yaw = heading_rad_;
  for (const Sway& sway : sways_) {
    yaw += sway.amplitude_rad *
           std::sin(2.0 * std::numbers::pi * t_s / sway.period_s + sway.phase_rad);
  }
  if (!motion_) return Pose2{p.x(), p.y(), normalise_angle(yaw)};
  const HeadMotion::Lean lean = motion_->at(t_s, speed_m_s_ / cruise_m_s_);
  return {{p.x(), p.y(), normalise_angle(yaw + lean.yaw_rad)},
          lean.roll_rad,
          lean.pitch_rad,
          lean.raised_m};
}

}  // namespace lifeline::sources
