#include "agents/slam/lost_stretch.hpp"

#include <cmath>
#include <unordered_set>
#include <utility>

#include "agents/slam/submap_chain.hpp"

namespace lifeline::slam {
namespace {

/// A scan with fewer pieces of surface says nothing.
constexpr std::size_t kMinPieces = 30;
constexpr double kViewMargin_m = 4.0;

}  // namespace

LostStretch::LostStretch(StretchConfig config, GridGeometry geometry, PushConfig push,
                         MotionConfig motion, MapTracker tracker)
    : config_(config),
      motion_(motion),
      tracker_(std::move(tracker)),
      updater_(geometry, push),
      map_(geometry) {}

bool LostStretch::step(std::span<const SurfacePiece> pieces, const MotionPrior& prior) {
  if (!begun_) {
    begin(pieces);
    return false;
  }
  const Prediction prediction = motion_.predict(prior);
  MatchResult match;
  if (pieces.size() >= kMinPieces) {
    view_.assign(map_, prediction.T_map_head.translation(), reach_of(pieces) + kViewMargin_m);
    match = tracker_.match(map_, view_, pieces, prediction).front().match;
  }
  if (match.verdict == Verdict::rejected) {
    motion_.lost(prediction, prior);
    if (++rejected_ >= config_.max_rejected) begin(pieces);
    return false;
  }
  rejected_ = 0;
  motion_.matched(match.T_map_head, prior);
  if (map_.own().tile_count() > config_.max_tiles) {
    begin(pieces);
    return false;
  }
  if (match.verdict == Verdict::accepted) keep(pieces);
  return true;
}

void LostStretch::clear() {
  begin({});
}

void LostStretch::begin(std::span<const SurfacePiece> pieces) {
  begun_ = pieces.size() >= kMinPieces;
  ++number_;
  rejected_ = 0;
  motion_.reset({});
  map_.own().clear();
  tracker_.forget_all();
  views_.clear();
  if (begun_) keep(pieces);
}

void LostStretch::keep(std::span<const SurfacePiece> pieces) {
  const Pose2& here = motion_.pose();
  tracker_.forget(updater_.push(pieces, here, 1.0, map_.own()));
  if (!views_.empty()) {
    const Pose2 step = views_.front().T_stretch_head.inverse() * here;
    if (step.translation().norm() < config_.view_distance_m &&
        std::abs(step.yaw_rad) < config_.view_turn_rad) {
      return;
    }
  }
  views_.push_front({here, {pieces.begin(), pieces.end()}});
  if (views_.size() > config_.max_views) views_.pop_back();
}

std::vector<SurfacePiece> LostStretch::cloud() const {
  std::vector<SurfacePiece> cloud;
  std::unordered_set<TileIndex> taken;
  const auto longest_m = static_cast<float>(config_.max_range_m);
  for (const View& view : views_) {
    const PointTransform T_head_view(motion_.pose().inverse() * view.T_stretch_head);
    for (const SurfacePiece& seen : view.pieces) {
      const SurfacePiece piece = moved(seen, T_head_view);
      if (piece.point.norm() > longest_m) continue;
      const TileIndex bin{
          static_cast<std::int32_t>(std::floor(piece.point.x() / config_.cloud_spacing_m)),
          static_cast<std::int32_t>(std::floor(piece.point.y() / config_.cloud_spacing_m))};
      if (taken.insert(bin).second) cloud.push_back(piece);
    }
  }
  return cloud;
}

}  // namespace lifeline::slam
