#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "agents/rplidar/frames.hpp"
#include "common/base/time.hpp"

namespace lifeline::rplidar {

/// One reading with its time.
struct Sample {
  Reading reading;
  SteadyTime taken{};
  bool after_gap = false;  ///< readings are missing between the one before and this
};

/// When the frames of an undisturbed stream were complete at our end, from when their bytes were
/// read. A read may come late, never early, and frames are complete at an even pace: so a frame
/// counts as complete when its predecessor was plus the pace, or earlier if it was read earlier.
class FrameClock {
 public:
  explicit FrameClock(Duration pace) : pace_(pace) {}

  /// The next frame was read at `read`; `follows`: nothing is missing since the one before.
  [[nodiscard]] SteadyTime next(SteadyTime read, bool follows);

 private:
  Duration pace_;
  SteadyTime last_{};
};

/// What became of the bytes.
struct DecoderCounts {
  std::uint64_t bytes = 0;
  std::uint64_t frames = 0;   ///< decoded
  std::uint64_t skipped = 0;  ///< bytes that belong to no decoded frame
  std::uint64_t gaps = 0;     ///< places where the stream was torn
};

/// Turns the stream of one scan mode into samples. Bytes in, samples out: knows no port.
///
/// A frame is believed only where the next one follows it at once and is whole, too: its angles
/// need the next one anyway, and a frame that a lost or added byte has shifted does not pass by
/// chance of its checksum. So a damaged byte costs the frame that it is in and the one before, and
/// the stream is found again at the first whole pair. Standard nodes, which have no checksum, need
/// kNodesInRow whole ones in a row, the first of which may be put together from two; a flipped bit
/// in their distance cannot be seen by anybody.
class SampleDecoder {
 public:
  /// `type` is one that frame_format() knows; `us_per_sample` > 0 as the mode says; `baud` of the
  /// line, for the time that a frame is under way.
  SampleDecoder(AnswerType type, double us_per_sample, int baud);

  /// Takes bytes that were read at `arrived`, and appends the samples that they complete. Times are
  /// of the middle of each measurement, on the clock of `arrived`.
  void push(Bytes bytes, SteadyTime arrived, std::vector<Sample>& samples);

  [[nodiscard]] const DecoderCounts& counts() const { return counts_; }

  /// Standard nodes in a row that are believed.
  static constexpr std::size_t kNodesInRow = 5;
  /// No RPLIDAR turns faster; angles that would need it are damaged.
  static constexpr double kFastest_Hz = 25.0;

 private:
  /// Where a read ended in the buffer, and when it was.
  struct Mark {
    std::size_t end;
    SteadyTime read;
  };

  [[nodiscard]] std::optional<Readings> frame_at(std::size_t at) const;
  [[nodiscard]] bool leaps(const Readings& readings) const;
  [[nodiscard]] SteadyTime read_time(std::size_t end) const;
  void emit(const Readings& readings, SteadyTime complete, std::vector<Sample>& samples);
  void forget(std::size_t count);

  AnswerType type_;
  FrameFormat format_;
  std::size_t in_row_;  ///< frames that have to be whole, one behind the other
  double us_per_sample_;
  Duration byte_time_;
  std::int32_t most_turn_q16_;
  FrameClock clock_;
  std::vector<std::uint8_t> buffer_;
  std::vector<Mark> marks_;
  std::int32_t last_step_q16_ = 0;  ///< of the frame before
  bool passed_first_ = false;       ///< since the stream was torn
  bool torn_ = true;                ///< the next frame does not follow the last decoded one
  DecoderCounts counts_;
};

}  // namespace lifeline::rplidar
