#include "agents/sources/paced_source.hpp"

#include <algorithm>
#include <charconv>
#include <condition_variable>
#include <mutex>
#include <utility>

#include "common/base/check.hpp"

namespace lifeline::sources {
namespace {

constexpr double kSlowest = 0.01, kFastest = 1000.0;
/// A recording may hold gaps of years; no single wait needs to last that long.
constexpr double kLongestWait_s = 3600.0;

}  // namespace

Result<SourcePace> parse_source_pace(std::string_view text) {
  if (text == "real") return kRealTime;
  if (text == "max") return kUnpaced;
  SourcePace pace;
  const char* end = text.data() + text.size();
  if (text.starts_with('x')) {
    const auto [rest, error] = std::from_chars(text.data() + 1, end, pace.speed);
    if (error == std::errc{} && rest == end && pace.speed >= kSlowest && pace.speed <= kFastest) {
      return pace;
    }
  }
  return fail(ErrorCode::wrong_use,
              "rate={} is none of: real, max, xN (N times as fast as recorded, {} to {})", text,
              kSlowest, kFastest);
}

Wait stoppable_wait(std::stop_token stop) {
  return [stop = std::move(stop)](Duration duration) {
    std::mutex mutex;
    std::condition_variable_any never_notified;
    std::unique_lock lock(mutex);
    never_notified.wait_for(lock, stop, duration, [] { return false; });
    return !stop.stop_requested();
  };
}

PacedSource::PacedSource(std::unique_ptr<sensing::ScanSource> source, SourcePace pace,
                         const Clock& clock, Wait wait)
    : source_(std::move(source)), pace_(pace), clock_(clock), wait_(std::move(wait)) {
  LIFELINE_CHECK(pace_.speed > 0.0);
}

Result<std::optional<sensing::RawScan>> PacedSource::next() {
  auto scan = source_->next();
  if (!scan || !*scan) return scan;
  const Timestamp stamp = (*scan)->stamp;
  if (!first_stamp_) {
    first_stamp_ = stamp;
    start_ = clock_.steady_now();
  } else if (!wait_until(to_seconds(stamp - *first_stamp_) / pace_.speed)) {
    return std::nullopt;
  }
  return scan;
}

/// Waits until `due_s` after the first scan. Seconds as double: microseconds do not matter here,
/// and a slowed-down gap cannot overflow.
bool PacedSource::wait_until(double due_s) {
  for (;;) {
    const double left_s = due_s - to_seconds(clock_.steady_now() - start_);
    if (!(left_s > 0.0)) return true;
    if (!wait_(from_seconds(std::min(left_s, kLongestWait_s)) + Duration(1))) return false;
  }
}

}  // namespace lifeline::sources
