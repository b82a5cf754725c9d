#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "common/bag/message_source.hpp"
#include "common/recording/heard.hpp"
#include "coordinator/coordinator.hpp"
#include "coordinator/recording/digest.hpp"
#include "coordinator/recording/replay_channels.hpp"

namespace lifeline {

/// What a recording of ours says of itself.
struct RecordingFacts {
  std::string recorder;
  std::optional<LayerKey>
      helmet;  ///< that recorded it, by the map that it drew; else a coordinator
  std::string mission_id;
  GridGeometry geometry;
  std::optional<std::string> common_map_sha256;  ///< at its end; empty where it was cut off
};

/// A message of our own topics, out of a recording; nothing for one of another topic. bad_data
/// where its octets are no such message.
[[nodiscard]] Result<std::optional<Heard>> to_heard(const bag::Message& message);

/// Plays a recording into a coordinator: the same code that led the mission, which follows the
/// directives of then, or such a coordinator beside the helmet that recorded. Its clock is that of
/// the recording. One owner, not thread-safe.
class Replay {
 public:
  /// bad_data where it is a recording, but none of ours; else as bag::BagReader::open().
  [[nodiscard]] static Result<std::unique_ptr<Replay>> open(const std::string& target);
  /// The same of what comes from elsewhere.
  [[nodiscard]] static Result<std::unique_ptr<Replay>> open(
      std::unique_ptr<bag::MessageSource> source);

  /// Plays on, up to and with the next time at which something was recorded. False at the end; of
  /// a mission that goes on there may be more at the next call.
  [[nodiscard]] Result<bool> step();

  /// Plays on towards `to`, a short while at a time, leaving out what something before `to` has
  /// replaced: the same state much sooner, and nothing in between. False once it is there, or at
  /// the end. Until then neither step() nor an earlier `to`.
  [[nodiscard]] Result<bool> take_shortcut(Timestamp to);
  /// A shortcut was begun and is not at its end.
  [[nodiscard]] bool is_on_shortcut() const { return shortcut_.has_value(); }

  /// Hears each sample before the coordinator does, but on shortcuts.
  using Listener = std::function<void(const Heard&, Timestamp)>;
  void set_listener(Listener listener) { listener_ = std::move(listener); }

  [[nodiscard]] const Coordinator& coordinator() const { return *coordinator_; }
  [[nodiscard]] Coordinator& coordinator() { return *coordinator_; }
  [[nodiscard]] const RecordingFacts& facts() const { return facts_; }
  /// When it began and ended. Errors as of its source's span().
  [[nodiscard]] Result<bag::MessageSource::Span> span() const;
  /// How far into the recording.
  [[nodiscard]] Duration elapsed() const { return clock_.wall - first_; }
  /// How far it has read, which on a shortcut is further: from here it only goes on.
  [[nodiscard]] Duration read_so_far() const;
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

  explicit Replay(std::unique_ptr<bag::MessageSource> source) : source_(std::move(source)) {}
  [[nodiscard]] Result<void> begin();
  void take_note(const bag::Message& message);
  /// The sample of a message of ours; nothing where it is none, or cannot be decoded.
  [[nodiscard]] std::optional<Heard> decode(const bag::Message& message);
  /// True: all before `to` is in the shortcut's digest.
  [[nodiscard]] Result<bool> read_ahead(Timestamp to);
  /// False: the digest has been played.
  bool play_digest();
  void feed(const bag::Message& message);
  void advance(Timestamp to);

  std::unique_ptr<bag::MessageSource> source_;
  RecordingFacts facts_;
  RecordedClock clock_;
  Timestamp first_{};
  ReplayChannels channels_;
  IdleMatchWorker worker_;
  std::unique_ptr<Coordinator> coordinator_;
  Listener listener_;
  std::optional<bag::Message> next_;
  struct Shortcut {
    Digest digest;
    std::size_t played = 0;  ///< of its entries
    Timestamp wall{};        ///< of what was read last ...
    SteadyTime steady{};     ///< ... by both clocks
    bool is_read = false;
  };
  std::optional<Shortcut> shortcut_;
  std::size_t messages_ = 0, refused_ = 0;
};

}  // namespace lifeline
