#include "agents/sources/carmen_source.hpp"

#include <limits>
#include <optional>
#include <utility>

#include "agents/sources/carmen_line.hpp"
#include "agents/sources/line_reader.hpp"
#include "agents/sources/portable_noise.hpp"
#include "agents/sources/scan_range.hpp"
#include "common/base/check.hpp"

namespace lifeline::sources {
namespace {

using sensing::RawScan;

/// SICK lasers report 50.0 m (8-bit mode with intensity bits), 51.1 m or 81.8 to 81.9 m where
/// nothing was hit; the farthest true reading in all logs at hand is 49.95 m.
constexpr double kDefaultMaxRange_m = 50.0;
constexpr const char* kTruncated = "the log ends in the middle of a line: it is truncated";
constexpr Duration kStepBetweenEqualTimes = std::chrono::milliseconds(1);

struct CarmenOptions {
  ScanRange range;
  std::string prior;
  std::uint64_t seed = 1;
  double max_range_m = kDefaultMaxRange_m;
};

Result<CarmenOptions> read_carmen_options(const SourceSpec& spec) {
  if (auto known = spec.allow_options({"from", "to", "prior", "seed", "max_range"}); !known) {
    return forward_error(known);
  }
  const auto range = read_scan_range(spec);
  if (!range) return forward_error(range);
  auto prior = spec.choice("prior", "none", {"none", "ahrs", "yaw", "odom"});
  if (!prior) return forward_error(prior);
  const auto seed = spec.integer("seed", 1, 0, std::numeric_limits<std::int64_t>::max());
  if (!seed) return forward_error(seed);
  const auto max_range_m = spec.number("max_range", kDefaultMaxRange_m, 0.1, 1000.0);
  if (!max_range_m) return forward_error(max_range_m);
  return CarmenOptions{*range, *std::move(prior), static_cast<std::uint64_t>(*seed), *max_range_m};
}

class CarmenSource final : public sensing::ScanSource {
 public:
  CarmenSource(LineReader reader, CarmenOptions options)
      : reader_(std::move(reader)), options_(std::move(options)), yaw_(options_.seed) {}

  Result<std::optional<RawScan>> next() override {
    if (ended_) return std::nullopt;
    auto scan = next_wanted();
    ended_ = !scan || !*scan;
    return scan;
  }

 private:
  /// The next scan of [from, to). Those before are read too: their times and noise count.
  Result<std::optional<RawScan>> next_wanted() {
    while (index_ < options_.range.to) {
      auto flaser = next_flaser();
      if (!flaser) return forward_error(flaser);
      if (!*flaser) return end_of_log();
      RawScan scan = convert(std::move(**flaser));
      if (index_++ >= options_.range.from) return scan;
    }
    return std::nullopt;
  }

  Result<std::optional<FlaserLine>> next_flaser() {
    for (;;) {
      const auto line = reader_.next();
      if (!line) return forward_error(line);
      if (!*line) return std::nullopt;
      if (is_flaser((*line)->text)) {
        auto flaser = parse_flaser((*line)->text);
        if (flaser) return *std::move(flaser);
        return fail_here((*line)->is_complete ? flaser.error().text : kTruncated);
      }
      if (!(*line)->is_complete && !is_whole_other_line((*line)->text)) {
        return fail_here(kTruncated);
      }
    }
  }

  tl::unexpected<Error> fail_here(std::string_view text) const {
    return fail(ErrorCode::bad_data, "{}:{}: {}", reader_.path(), reader_.line_number(), text);
  }

  Result<std::optional<RawScan>> end_of_log() const {
    const auto checked = check_scan_count(
        reader_.path(), index_, options_.range,
        fmt::format("none of its {} lines is a FLASER line", reader_.line_number()));
    if (!checked) return forward_error(checked);
    return std::nullopt;
  }

  RawScan convert(FlaserLine flaser) {
    const auto fan = beam_fan(flaser.ranges_m.size());
    LIFELINE_CHECK(fan.has_value());  // parse_flaser() refuses the rest
    RawScan scan;
    scan.stamp = stamp(flaser.time);
    scan.first_angle_rad = fan->first_angle_rad;
    scan.angle_step_rad = fan->angle_step_rad;
    scan.range_max_m = options_.max_range_m;
    scan.ranges_m = std::move(flaser.ranges_m);
    scan.T_world_head_truth = flaser.T_world_laser;
    if (options_.prior == "ahrs") {
      scan.attitude = sensing::Attitude{.yaw_rad = yaw_.measure(flaser.T_world_laser.yaw_rad)};
    } else if (options_.prior == "yaw") {
      scan.attitude = sensing::Attitude{.yaw_rad = flaser.T_odom_laser.yaw_rad};
    } else if (options_.prior == "odom") {
      scan.T_odom_head = flaser.T_odom_laser;
    }
    return scan;
  }

  Timestamp stamp(Duration time) {
    const bool repeats = last_time_ == time;
    last_time_ = time;
    last_stamp_ = repeats ? last_stamp_ + kStepBetweenEqualTimes : Timestamp(time);
    return last_stamp_;
  }

  LineReader reader_;
  const CarmenOptions options_;
  NoisyYaw yaw_;
  std::int64_t index_ = 0;  ///< of the next scan in the file
  std::optional<Duration> last_time_;
  Timestamp last_stamp_{};
  bool ended_ = false;
};

}  // namespace

Result<std::unique_ptr<sensing::ScanSource>> open_carmen_source(const SourceSpec& spec) {
  auto options = read_carmen_options(spec);
  if (!options) return forward_error(options);
  auto reader = LineReader::open(spec.target);
  if (!reader) return forward_error(reader);
  return std::make_unique<CarmenSource>(*std::move(reader), *std::move(options));
}

}  // namespace lifeline::sources
