#pragma once

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <variant>
#include <vector>

#include "common/bag/bag_writer.hpp"
#include "common/base/bounded_queue.hpp"
#include "common/recording/heard.hpp"
#include "common/ros2/messages.hpp"
#include "common/sharing/recording_status.hpp"
#include "common/sharing/replica_store.hpp"

namespace lifeline {

/// A tile as a store holds it, to be recorded as if it had been sent again.
struct KeptTileSample {
  LayerKey layer;
  TileIndex tile;
  sharing::ReplicaTile held;
  GridGeometry geometry;
  wire::Envelope envelope;
};

/// What a recording takes.
using Recordable = std::variant<Heard, ros2::Message, KeptTileSample>;

/// Writes a bag in a thread of its own: whoever has something to record never waits for the disk.
/// What was put is on the disk half a second later. Where the disk refuses (it is full, say), what
/// comes is counted and left out, and it is tried again every second.
class Recorder {
 public:
  /// `most_waiting`: messages that the memory has room for while the disk is slow.
  Recorder(bag::BagWriter writer, std::size_t most_waiting);
  ~Recorder();
  Recorder(const Recorder&) = delete;
  Recorder& operator=(const Recorder&) = delete;

  /// Never waits. Beyond `most_waiting` the oldest that waits is left out, and counted.
  void put(Timestamp stamp, Recordable what);
  /// Waits until all that was put is written, or refused, and closes the bag.
  [[nodiscard]] Result<void> finish();

  [[nodiscard]] std::size_t waiting() const { return queue_.size(); }
  [[nodiscard]] sharing::RecordingStatus status() const;
  /// Whether messages were left out, and there is room again, since the last call.
  [[nodiscard]] bool take_gap();
  [[nodiscard]] const std::filesystem::path& folder() const { return folder_; }

  // For who looks back, from any thread: waits while something is being written, and as long as the
  // disk takes. As of bag::BagWriter.
  [[nodiscard]] Result<std::vector<bag::Message>> read(std::uint64_t& after, std::uint64_t most,
                                                       const bag::BagWriter::Wanted& wanted);
  [[nodiscard]] std::optional<bag::MessageSource::Span> span() const;

 private:
  struct Item {
    Timestamp stamp;
    Recordable what;
  };

  void run();
  void write(const Item& item);
  void write(Timestamp stamp, const Heard& heard);
  void write(Timestamp stamp, const ros2::Message& message);
  void write(Timestamp stamp, const KeptTileSample& kept);
  void append(const bag::Topic& topic, bag::Durability durability, Timestamp stamp,
              const std::vector<std::uint8_t>& cdr);
  void commit_if_due(SteadyTime now);
  void note_failure(const Error& error, std::uint64_t lost);
  void note_success();

  const std::filesystem::path folder_;
  mutable std::mutex bag_mutex_;
  bag::BagWriter writer_;  // under bag_mutex_
  BoundedQueue<Item> queue_;
  std::atomic<bool> failing_{false};
  std::atomic<bool> gap_{false};
  std::atomic<std::uint64_t> missing_{0};
  std::size_t dropped_seen_ = 0;  // of the owner
  SteadyTime commit_due_{}, metadata_due_{}, retry_at_{};
  Result<void> closed_{};
  std::jthread thread_;  // last: joined before what it uses goes away
};

}  // namespace lifeline
