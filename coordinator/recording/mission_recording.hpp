#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "common/sharing/envelope_stamper.hpp"
#include "coordinator/recording/recorder.hpp"
#include "coordinator/recording/ros2_view.hpp"

namespace lifeline {

struct RecordingOptions {
  std::filesystem::path folder;  ///< takes a new bag of its own
  sharing::Speaker speaker;      ///< whose recording it is
  GridGeometry geometry;
  Duration map_interval = std::chrono::seconds(5);
};

/// Records a mission as its coordinator hears it (docs/recording.md): enough to come to the same
/// common map again. After a gap, or where the coordinator knew something before the recording
/// began, everything that it holds is recorded once more.
class MissionRecording {
 public:
  /// Makes FOLDER/MISSION-YYYYMMDD-HHMMSS (UTC). unavailable where that cannot be written.
  [[nodiscard]] static Result<std::unique_ptr<MissionRecording>> start(RecordingOptions options,
                                                                       const Clock& clock);

  /// Takes what was heard in a step of the coordinator, and how that stands then. Never waits.
  void step(const std::vector<Heard>& heard, const Coordinator& coordinator);
  /// Records how the mission ended, and closes the bag; waits for the disk.
  [[nodiscard]] Result<void> finish(const Coordinator& coordinator);

  [[nodiscard]] RecordingStatus status() const { return recorder_.status(); }
  [[nodiscard]] const std::filesystem::path& bag() const { return recorder_.folder(); }

 private:
  MissionRecording(RecordingOptions options, bag::BagWriter writer, const Clock& clock);
  /// The recorder's clock: the wall's at the start, and steady from there.
  [[nodiscard]] Timestamp stamp() const;
  void put_directive(const Coordinator& coordinator);
  /// Lists all that is held, to be recorded bit by bit.
  void begin_snapshot(const Coordinator& coordinator);
  void put_snapshot(const Coordinator& coordinator);
  void remember(const Heard& heard);

  RecordingOptions options_;
  const Clock& clock_;
  Timestamp started_wall_;
  SteadyTime started_;
  Ros2View view_;
  sharing::EnvelopeStamper stamper_;
  bool begun_ = false;
  std::uint64_t epoch_ = 0;                                  ///< of the directive recorded last
  std::vector<sharing::ReplicaStore::ChangedTile> missing_;  ///< of a snapshot under way
  std::map<sharing::DetectionKey, wire::Detection> detections_;
  std::map<sharing::DetectionKey, wire::Alert> alerts_;
  Recorder recorder_;
};

}  // namespace lifeline
