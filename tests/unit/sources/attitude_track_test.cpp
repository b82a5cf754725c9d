#include "agents/sources/attitude_track.hpp"

#include <memory>
#include <numbers>

#include <gtest/gtest.h>

namespace lifeline::sources {
namespace {

constexpr double kPi = std::numbers::pi;

Timestamp at_ms(int milliseconds) {
  return Timestamp(std::chrono::milliseconds(milliseconds));
}

ImuSample yawed(int milliseconds, double yaw_rad) {
  return {at_ms(milliseconds),
          Eigen::Quaterniond(Eigen::AngleAxisd(yaw_rad, Eigen::Vector3d::UnitZ()))};
}

ImuStream stream(std::vector<ImuSample> samples) {
  auto next = std::make_shared<std::size_t>(0);
  return [samples = std::move(samples), next]() -> Result<std::optional<ImuSample>> {
    if (*next == samples.size()) return std::nullopt;
    return samples[(*next)++];
  };
}

double yaw_at(AttitudeTrack& track, int milliseconds) {
  const auto attitude = track.at(at_ms(milliseconds));
  return attitude && *attitude ? (*attitude)->yaw_rad : std::nan("");
}

bool empty_at(AttitudeTrack& track, int milliseconds) {
  const auto attitude = track.at(at_ms(milliseconds));
  return attitude && !*attitude;
}

TEST(ToAttitude, TakesRollPitchAndYawOutOfARotation) {
  const auto about = [](double angle, const Eigen::Vector3d& axis) {
    return Eigen::AngleAxisd(angle, axis);
  };
  const Eigen::Quaterniond R = about(0.7, Eigen::Vector3d::UnitZ()) *
                               about(-0.2, Eigen::Vector3d::UnitY()) *
                               about(0.3, Eigen::Vector3d::UnitX());
  const sensing::Attitude attitude = to_attitude(R);
  EXPECT_NEAR(attitude.roll_rad, 0.3, 1e-12);
  EXPECT_NEAR(attitude.pitch_rad, -0.2, 1e-12);
  EXPECT_NEAR(attitude.yaw_rad, 0.7, 1e-12);
}

TEST(ToAttitude, CountsPitchPositiveNoseDown) {
  const Eigen::Quaterniond R(Eigen::AngleAxisd(0.4, Eigen::Vector3d::UnitY()));
  EXPECT_LT((R * Eigen::Vector3d::UnitX()).z(), 0.0);
  EXPECT_NEAR(to_attitude(R).pitch_rad, 0.4, 1e-12);
}

TEST(AttitudeTrack, InterpolatesBetweenSamples) {
  AttitudeTrack track(stream({yawed(0, 0.0), yawed(40, 0.4), yawed(80, 0.0)}));
  EXPECT_NEAR(yaw_at(track, 10), 0.1, 1e-12);
  EXPECT_NEAR(yaw_at(track, 40), 0.4, 1e-12);
  EXPECT_NEAR(yaw_at(track, 60), 0.2, 1e-12);
}

TEST(AttitudeTrack, InterpolatesTheShortWayAcrossTheBack) {
  AttitudeTrack track(stream({yawed(0, kPi - 0.1), yawed(40, -kPi + 0.1)}));
  EXPECT_NEAR(std::abs(yaw_at(track, 20)), kPi, 1e-9);
}

TEST(AttitudeTrack, TakesTheOnlySampleWithinReach) {
  AttitudeTrack track(stream({yawed(1000, 0.5), yawed(2000, 0.9)}));
  EXPECT_NEAR(yaw_at(track, 950), 0.5, 1e-12);
  EXPECT_NEAR(yaw_at(track, 1050), 0.5, 1e-12);
  EXPECT_NEAR(yaw_at(track, 1950), 0.9, 1e-12);
  EXPECT_NEAR(yaw_at(track, 2080), 0.9, 1e-12);
}

TEST(AttitudeTrack, IsEmptyFarFromAnySample) {
  AttitudeTrack track(stream({yawed(1000, 0.5), yawed(2000, 0.9)}));
  EXPECT_TRUE(empty_at(track, 0));
  EXPECT_TRUE(empty_at(track, 1500));
  EXPECT_TRUE(empty_at(track, 2200));
  EXPECT_TRUE(empty_at(track, 5000));
}

TEST(AttitudeTrack, PassesOverSamplesWithoutOrientation) {
  AttitudeTrack track(stream({yawed(0, 0.2), {at_ms(10), std::nullopt}, yawed(20, 0.4)}));
  EXPECT_NEAR(yaw_at(track, 10), 0.3, 1e-12);
  AttitudeTrack none(stream({{at_ms(10), std::nullopt}}));
  EXPECT_TRUE(empty_at(none, 10));
}

TEST(AttitudeTrack, ToleratesSamplesOutOfOrder) {
  AttitudeTrack track(stream({yawed(50, 0.1), yawed(10, 0.3), yawed(90, 0.5)}));
  EXPECT_NEAR(yaw_at(track, 40), 0.1, 1e-12);
  EXPECT_FALSE(std::isnan(yaw_at(track, 60)));
  EXPECT_FALSE(std::isnan(yaw_at(track, 30)));
}

TEST(AttitudeTrack, HandsOnAnErrorOfItsStream) {
  AttitudeTrack track([]() -> Result<std::optional<ImuSample>> {
    return fail(ErrorCode::bad_data, "bag: message 3 of /imu: broken");
  });
  const auto attitude = track.at(at_ms(0));
  ASSERT_FALSE(attitude);
  EXPECT_EQ(attitude.error().text, "bag: message 3 of /imu: broken");
}

}  // namespace
}  // namespace lifeline::sources
