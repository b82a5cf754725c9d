#pragma once

#include <cstddef>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "agents/sensing/head_projection.hpp"
#include "agents/sharing/helmet_sharing.hpp"
#include "agents/sharing/own_detections.hpp"
#include "agents/slam/scan_check.hpp"
#include "agents/slam/tsd_slam.hpp"
#include "common/grid/stamped_pose.hpp"

namespace lifeline {

/// What a helmet had mapped before it was restarted.
struct MapperMemory {
  TsdGrid layer;
  std::vector<StampedPose> trajectory;
  std::optional<slam::LastPlace> last;  ///< where it was moments ago, if that is known
  sharing::HelmetState state;           ///< its counters
  std::size_t lost_scans = 0;
  std::size_t relocalisations = 0;
};

/// The mapping half of a helmet: scans in, own layer and pose out. Never waits for anybody.
/// A state machine: one step() a scan. One owner, not thread-safe.
class HelmetMapper {
 public:
  HelmetMapper(slam::SlamConfig slam, GridGeometry geometry, sensing::ProjectionConfig projection)
      : slam_(without_loops(std::move(slam)), geometry), projection_(projection) {}

  /// Goes on in the map of a process before this one: lost, until the first scans are found in it.
  /// Before the first step().
  void resume(MapperMemory memory);

  void step(const sensing::RawScan& raw);
  /// What changed in the peers' part of the working map.
  void apply(const sharing::PeerUpdate& peers);

  /// No more scans will come.
  void finish() { slam_.settle_all(); }

  /// Whether the lidar talks, as whoever reads it sees it.
  void set_lidar_health(wire::SensorHealth health) { state_.lidar = health; }

  /// The own layer's tiles changed since the last call, at the published precision.
  [[nodiscard]] sharing::MapTiles take_changed_tiles();
  /// Which tiles the next call of take_changed_tiles() would give.
  [[nodiscard]] const std::set<TileIndex>& changed_tiles() const { return changed_; }
  [[nodiscard]] sharing::HelmetState state() const;

  /// Scans taken while lost, and how often the place was found again.
  [[nodiscard]] std::size_t lost_scans() const { return lost_scans_; }
  [[nodiscard]] std::size_t relocalisations() const { return relocalisations_; }

  [[nodiscard]] const TsdGrid& layer() const { return slam_.layer(); }
  /// T_map_head of every scan, as last corrected; the last few come with finish().
  [[nodiscard]] std::vector<StampedPose> trajectory() const;
  /// Those of this process, from number `first` on.
  [[nodiscard]] std::vector<StampedPose> trajectory_from(std::size_t first) const {
    return slam_.trajectory(first);
  }
  /// T_world_head of every scan whose source knows it; for judging only.
  [[nodiscard]] const std::vector<StampedPose>& truth() const { return truth_; }
  /// Time of each whole step, in the order of scans.
  [[nodiscard]] const std::vector<double>& step_ms() const { return step_ms_; }

 private:
  /// Nobody closes loops in a running helmet yet (docs/decisions/0206), and stories need them
  /// (0205).
  [[nodiscard]] static slam::SlamConfig without_loops(slam::SlamConfig config) {
    config.stories.max_stories = 1;
    config.keyframes.hand_over = false;
    return config;
  }
  void note_sightings(const sensing::RawScan& raw, const slam::SlamStep& step);
  void note_step(const sensing::RawScan& raw, const Scan2& scan, const slam::SlamStep& step);
  void note_lost(const sensing::RawScan& raw, const slam::SlamStep& step);

  slam::TsdSlam slam_;
  sensing::ProjectionConfig projection_;
  sensing::MotionTracker motion_;
  slam::ScanCheck check_;
  std::optional<StampedPose> last_;
  std::vector<StampedPose> earlier_;  ///< the trajectory before a restart
  std::vector<StampedPose> truth_;
  std::vector<double> step_ms_;
  bool just_resumed_ = false;
  bool was_lost_ = false;
  std::optional<Timestamp> lost_since_;  ///< the place was not known, or not again yet
  std::size_t lost_scans_ = 0;
  std::size_t relocalisations_ = 0;
  std::set<TileIndex> changed_;
  sharing::OwnDetections detections_;
  sharing::HelmetState state_;
};

}  // namespace lifeline
