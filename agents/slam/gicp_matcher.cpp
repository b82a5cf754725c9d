#include "agents/slam/gicp_matcher.hpp"

#include <cmath>

#include <pcl/point_cloud.h>
#include <pcl/point_types.h>
#include <pcl/registration/gicp.h>

namespace lifeline::slam {
namespace {

using Cloud = pcl::PointCloud<pcl::PointXYZ>;
using Gicp = pcl::GeneralizedIterativeClosestPoint<pcl::PointXYZ, pcl::PointXYZ>;

/// GICP builds on this many neighbours and refuses smaller clouds.
constexpr std::size_t kFewestPoints = 20;

Cloud::Ptr to_cloud(const PointSet& set) {
  auto cloud = std::make_shared<Cloud>();
  cloud->reserve(set.size());
  for (const Eigen::Vector2d& p : set.points) {
    cloud->push_back({static_cast<float>(p.x()), static_cast<float>(p.y()), 0.0F});
  }
  return cloud;
}

Gicp::MatricesVectorPtr planar_covariances(const PointSet& set, double thin) {
  auto covariances = std::make_shared<Gicp::MatricesVector>();
  covariances->reserve(set.size());
  for (const Eigen::Vector2d& n : set.normals) {
    Eigen::Matrix3d covariance = Eigen::Matrix3d::Identity();
    covariance.topLeftCorner<2, 2>() -= (1.0 - thin) * n * n.transpose();
    covariances->push_back(covariance);
  }
  return covariances;
}

}  // namespace

Pose2 GicpMatcher::match(const PointSet& model, const PointSet& scan, const Pose2& start) const {
  if (model.size() < kFewestPoints || scan.size() < kFewestPoints) return start;
  Gicp gicp;
  gicp.setMaximumIterations(config_.max_iterations);
  gicp.setMaxCorrespondenceDistance(config_.max_pair_m);
  gicp.setInputTarget(to_cloud(model));
  gicp.setTargetCovariances(planar_covariances(model, config_.thin));
  gicp.setInputSource(to_cloud(scan));
  gicp.setSourceCovariances(planar_covariances(scan, config_.thin));

  Eigen::Matrix4f guess = Eigen::Matrix4f::Identity();
  guess.topLeftCorner<2, 2>() =
      Eigen::Rotation2Df(static_cast<float>(start.yaw_rad)).toRotationMatrix();
  guess.topRightCorner<2, 1>() = start.translation().cast<float>();
  Cloud aligned;
  gicp.align(aligned, guess);
  const Eigen::Matrix4d T = gicp.getFinalTransformation().cast<double>();
  const Pose2 found{T(0, 3), T(1, 3), std::atan2(T(1, 0), T(0, 0))};
  return gicp.hasConverged() && found.is_finite() ? found : start;
}

}  // namespace lifeline::slam
