#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "common/recording/recorder.hpp"
#include "common/recording/ros2_view.hpp"
#include "common/sharing/detection_list.hpp"
#include "common/sharing/envelope_stamper.hpp"

namespace lifeline {

struct RecordingOptions {
  std::filesystem::path folder;  ///< takes a new bag of its own
  sharing::Speaker speaker;      ///< whose recording it is
  GridGeometry geometry;
  Duration map_interval = std::chrono::seconds(5);
  /// Of a helmet: its layer, whose group's map it shows. A coordinator shows the largest group's.
  std::optional<LayerKey> helmet{};
  /// As many messages wait for the disk at most; a helmet has less memory.
  std::size_t most_waiting = 50'000;
};

/// Records a mission as a coordinator or a helmet hears it (docs/recording.md): enough to come to
/// the same common map again. After a gap, or where it knew something before the recording began,
/// everything that it holds is recorded once more.
class MissionRecording {
 public:
  /// Makes FOLDER/MISSION-YYYYMMDD-HHMMSS (UTC). unavailable where that cannot be written.
  [[nodiscard]] static Result<std::unique_ptr<MissionRecording>> start(RecordingOptions options,
                                                                       const Clock& clock);

  /// Takes what was heard in a step, and what is held then. Never waits.
  void step(const std::vector<Heard>& heard, const MissionState& state);
  /// Records how the mission ended, and closes the bag; waits for the disk.
  [[nodiscard]] Result<void> finish(const MissionState& state);

  /// What was recorded so far, from its beginning, and what comes later; from any thread, which
  /// must let go of it before this ends. Half a second behind at most.
  [[nodiscard]] std::unique_ptr<bag::MessageSource> so_far();

  [[nodiscard]] sharing::RecordingStatus status() const { return recorder_.status(); }
  [[nodiscard]] const std::filesystem::path& bag() const { return recorder_.folder(); }

 private:
  MissionRecording(RecordingOptions options, bag::BagWriter writer, const Clock& clock);
  /// The recorder's clock: the wall's at the start, and steady from there.
  [[nodiscard]] Timestamp stamp() const;
  void put_directive(const MissionState& state);
  /// Lists all that is held, to be recorded bit by bit.
  void begin_snapshot(const MissionState& state);
  void put_snapshot(const MissionState& state);
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
