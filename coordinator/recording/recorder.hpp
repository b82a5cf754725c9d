#pragma once

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <stop_token>
#include <string>
#include <thread>
#include <variant>

#include "common/bag/bag_writer.hpp"
#include "common/base/bounded_queue.hpp"
#include "common/ros2/messages.hpp"
#include "coordinator/recording/message_tap.hpp"

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
  static constexpr std::size_t kMostWaiting = 50'000;

  explicit Recorder(bag::BagWriter writer);
  ~Recorder();
  Recorder(const Recorder&) = delete;
  Recorder& operator=(const Recorder&) = delete;

  /// Never waits. Beyond kMostWaiting the oldest that waits is left out, and counted.
  void put(Timestamp stamp, Recordable what);
  /// Waits until all that was put is written, or refused, and closes the bag.
  [[nodiscard]] Result<void> finish();

  [[nodiscard]] std::size_t waiting() const { return queue_.size(); }
  [[nodiscard]] RecordingStatus status() const;
  /// Whether messages were left out, and there is room again, since the last call.
  [[nodiscard]] bool take_gap();
  [[nodiscard]] const std::filesystem::path& folder() const { return folder_; }

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
  bag::BagWriter writer_;  // the thread's alone, until it has ended
  BoundedQueue<Item> queue_{kMostWaiting, Overflow::drop_oldest};
  std::atomic<bool> failing_{false};
  std::atomic<bool> gap_{false};
  std::atomic<std::uint64_t> missing_{0};
  std::size_t dropped_seen_ = 0;  // of the owner
  SteadyTime commit_due_{}, metadata_due_{}, retry_at_{};
  Result<void> closed_{};
  std::jthread thread_;  // last: joined before what it uses goes away
};

}  // namespace lifeline
