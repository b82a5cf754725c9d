#include "agents/rplidar/sample_decoder.hpp"

#include <algorithm>
#include <utility>

#include "common/base/check.hpp"

namespace lifeline::rplidar {
namespace {

/// The share of a frame's lateness that moves the clock: it follows a pace that is not quite the
/// one stated, and hardly minds a late read.
constexpr int kClockGain = 100;
/// A frame that is later than this does not follow the one before, whatever its bytes say.
constexpr Duration kMostLate = std::chrono::milliseconds(100);
/// A byte on the line: start bit, eight bits, stop bit.
constexpr double kBitsPerByte = 10.0;
/// From the middle of a measurement until the device begins to send it, in measurements: half of
/// the measurement itself and one of work on it (the public SDK's figure).
constexpr double kSamplesOfDelay = 1.5;
/// A near reading's angle may lie this far behind a far one's.
constexpr double kMostBehind_deg = 8.0;

Duration microseconds(double us) {
  return from_seconds(1e-6 * us);
}

std::int32_t most_turn(AnswerType type, const FrameFormat& format, double us_per_sample) {
  const double seconds = 1e-6 * us_per_sample * static_cast<double>(format.readings);
  const double slack_deg = type == AnswerType::standard_nodes ? kMostBehind_deg : 0.0;
  const double degrees = 360.0 * SampleDecoder::kFastest_Hz * seconds + slack_deg;
  return static_cast<std::int32_t>(std::min(degrees, 180.0) * 65536.0);
}

}  // namespace

SteadyTime FrameClock::next(SteadyTime read, bool follows) {
  const SteadyTime expected = last_ + pace_;
  if (!follows || read < expected || read - expected > kMostLate) {
    last_ = read;
  } else {
    last_ = expected + (read - expected) / kClockGain;
  }
  return last_;
}

SampleDecoder::SampleDecoder(AnswerType type, double us_per_sample, int baud)
    : type_(type),
      format_(frame_format(type).value()),
      in_row_(type == AnswerType::standard_nodes ? kNodesInRow : 2),
      us_per_sample_(us_per_sample),
      byte_time_(from_seconds(kBitsPerByte / baud)),
      most_turn_q16_(most_turn(type, format_, us_per_sample)),
      clock_(microseconds(us_per_sample * static_cast<double>(format_.readings))) {
  LIFELINE_CHECK(us_per_sample > 0.0 && baud > 0);
}

void SampleDecoder::push(Bytes bytes, SteadyTime arrived, std::vector<Sample>& samples) {
  counts_.bytes += bytes.size();
  buffer_.insert(buffer_.end(), bytes.begin(), bytes.end());
  marks_.push_back({buffer_.size(), arrived});
  std::size_t at = 0;
  while (at + in_row_ * format_.bytes <= buffer_.size()) {
    const auto readings = frame_at(at);
    if (!readings || leaps(*readings)) {
      counts_.gaps += torn_ ? 0 : 1;
      torn_ = true;
      passed_first_ = false;
      ++counts_.skipped;
      ++at;
      continue;
    }
    if (torn_ && type_ == AnswerType::standard_nodes && !std::exchange(passed_first_, true)) {
      counts_.skipped += format_.bytes;
      at += format_.bytes;
      continue;
    }
    at += format_.bytes;
    ++counts_.frames;
    emit(*readings, clock_.next(read_time(at), !torn_), samples);
    torn_ = false;
    last_step_q16_ = readings->of[0].step_q16;
  }
  forget(at);
}

/// The readings of the frame that begins there, if it is to be believed.
std::optional<Readings> SampleDecoder::frame_at(std::size_t at) const {
  const Bytes here = Bytes(buffer_).subspan(at);
  const auto frame = [&](std::size_t i) { return here.subspan(i * format_.bytes, format_.bytes); };
  std::optional<Readings> first;
  for (std::size_t i = 0; i < in_row_; ++i) {
    if (!is_frame(type_, frame(i))) return std::nullopt;
    if (i == 0) continue;
    const auto readings = decode_frame(type_, frame(i - 1), frame(i), most_turn_q16_);
    if (!readings) return std::nullopt;
    if (i == 1) first = readings;
  }
  return first;
}

/// Whether the rotor seems to turn half as fast again as in the frame before: a frame is missing in
/// between, without leaving a trace in the bytes.
bool SampleDecoder::leaps(const Readings& readings) const {
  if (torn_ || type_ == AnswerType::standard_nodes) return false;
  constexpr std::int32_t kSlack_q16 = 1 << 10;  // start angles are rounded to 1/64 deg
  return readings.of[0].step_q16 > last_step_q16_ + last_step_q16_ / 2 + kSlack_q16;
}

/// When the byte before `end` came: what was read in one go came one byte after the other.
SteadyTime SampleDecoder::read_time(std::size_t end) const {
  const auto mark = std::find_if(marks_.begin(), marks_.end(),
                                 [end](const Mark& candidate) { return candidate.end >= end; });
  LIFELINE_CHECK(mark != marks_.end());
  return mark->read - byte_time_ * static_cast<std::int64_t>(mark->end - end);
}

void SampleDecoder::emit(const Readings& readings, SteadyTime complete,
                         std::vector<Sample>& samples) {
  const SteadyTime sent = complete - byte_time_ * static_cast<std::int64_t>(format_.bytes);
  bool after_gap = torn_;
  for (std::size_t i = 0; i < readings.count; ++i) {
    const double ago = static_cast<double>(readings.count - 1 - i) + kSamplesOfDelay;
    samples.push_back({readings.of[i], sent - microseconds(us_per_sample_ * ago), after_gap});
    after_gap = false;
  }
}

/// Drops the first `count` bytes, and the marks that no byte needs any more.
void SampleDecoder::forget(std::size_t count) {
  buffer_.erase(buffer_.begin(), buffer_.begin() + static_cast<std::ptrdiff_t>(count));
  const auto used =
      std::find_if(marks_.begin(), marks_.end(), [count](const Mark& m) { return m.end > count; });
  marks_.erase(marks_.begin(), used);
  for (Mark& mark : marks_) mark.end -= count;
}

}  // namespace lifeline::rplidar
