#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "common/bag/bag_reader.hpp"
#include "coordinator/coordinator.hpp"
#include "coordinator/recording/replay_channels.hpp"

namespace lifeline {

/// What a recording of ours says of itself.
struct RecordingFacts {
  std::string recorder;
  std::string mission_id;
  GridGeometry geometry;
  std::optional<std::string> common_map_sha256;  ///< at its end; empty where it was cut off
};

/// A message of our own topics, out of a recording; nothing for one of another topic. bad_data
/// where its octets are no such message.
[[nodiscard]] Result<std::optional<Heard>> to_heard(const bag::Message& message);

/// Plays a recording into a coordinator: the same code that led the mission, which follows the
/// directives of then. Its clock is that of the recording. One owner, not thread-safe.
class Replay {
 public:
  /// bad_data where it is a recording, but none of ours; else as bag::BagReader::open().
  [[nodiscard]] static Result<std::unique_ptr<Replay>> open(const std::string& target);

  /// Plays on, up to and with the next time at which something was recorded. False at the end.
  [[nodiscard]] Result<bool> step();

  /// Hears each sample before the coordinator does.
  using Listener = std::function<void(const Heard&, Timestamp)>;
  void set_listener(Listener listener) { listener_ = std::move(listener); }

  [[nodiscard]] const Coordinator& coordinator() const { return *coordinator_; }
  [[nodiscard]] Coordinator& coordinator() { return *coordinator_; }
  [[nodiscard]] const RecordingFacts& facts() const { return facts_; }
  /// When it began and ended. Errors as of bag::BagReader::span().
  [[nodiscard]] Result<bag::BagReader::Span> span() const;
  /// How far into the recording.
  [[nodiscard]] Duration elapsed() const { return clock_.wall - first_; }
  [[nodiscard]] Timestamp first() const { return first_; }
  [[nodiscard]] Timestamp now() const { return clock_.wall; }
  [[nodiscard]] SteadyTime steady_now() const { return clock_.steady; }
  [[nodiscard]] std::size_t messages() const { return messages_; }
  /// Of our own topics, and nobody could decode them.
  [[nodiscard]] std::size_t refused() const { return refused_; }
  /// The common map as it is now; empty while there is none.
  [[nodiscard]] std::string common_map_sha256() const;

 private:
  struct RecordedClock final : Clock {
    [[nodiscard]] SteadyTime steady_now() const override { return steady; }
    [[nodiscard]] Timestamp wall_now() const override { return wall; }
    SteadyTime steady{std::chrono::hours(1)};
    Timestamp wall{};
  };

  explicit Replay(bag::BagReader reader) : reader_(std::move(reader)) {}
  [[nodiscard]] Result<void> begin();
  void take_note(const bag::Message& message);
  void feed(const bag::Message& message);
  void advance(Timestamp to);

  bag::BagReader reader_;
  RecordingFacts facts_;
  RecordedClock clock_;
  Timestamp first_{};
  ReplayChannels channels_;
  IdleMatchWorker worker_;
  std::unique_ptr<Coordinator> coordinator_;
  Listener listener_;
  std::optional<bag::Message> next_;
  std::size_t messages_ = 0, refused_ = 0;
};

}  // namespace lifeline
