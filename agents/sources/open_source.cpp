#include "agents/sources/open_source.hpp"

#include <utility>

#include "agents/ahrs/ahrs_source.hpp"
#include "agents/rplidar/rplidar_source.hpp"
#include "agents/sources/carmen_source.hpp"
#include "agents/sources/columns_source.hpp"
#include "agents/sources/joined_source.hpp"
#include "agents/sources/ros2_source.hpp"
#include "agents/sources/rosbag2_source.hpp"
#include "agents/sources/simulator/simulated_source.hpp"
#include "agents/sources/source_spec.hpp"

namespace lifeline::sources {
namespace {

/// A device gives its scans at its own pace.
bool is_live(const SourceSpec& spec) {
  return spec.kind == "rplidar" || spec.kind == "ros2";
}

Result<std::unique_ptr<sensing::ScanSource>> open_kind(const SourceSpec& spec,
                                                       const std::stop_token& stop) {
  if (spec.kind == "carmen") return open_carmen_source(spec);
  if (spec.kind == "columns") return open_columns_source(spec);
  if (spec.kind == "ros2") return open_ros2_source(spec, stop);
  if (spec.kind == "rosbag2") return open_rosbag2_source(spec);
  if (spec.kind == "rplidar") return rplidar::open_rplidar_source(spec, stop);
  if (spec.kind == "sim") return open_simulated_source(spec);
  return fail(
      ErrorCode::wrong_use,
      "source '{}:{}': unknown kind '{}'; there are: carmen, columns, ros2, rosbag2, rplidar, sim",
      spec.kind, spec.target, spec.kind);
}

}  // namespace

Result<std::unique_ptr<sensing::ScanSource>> open_source(std::string_view source,
                                                         SourcePace default_pace,
                                                         std::stop_token stop) {
  static const SystemClock clock;
  auto spec = parse_source_spec(source);
  if (!spec) return forward_error(spec);
  SourcePace pace = default_pace;
  if (const auto rate = spec->options.extract("rate"); !rate.empty()) {
    const auto parsed = parse_source_pace(rate.mapped());
    if (!parsed) return forward_error(parsed);
    if (is_live(*spec) && *parsed != kRealTime) {
      return fail(ErrorCode::wrong_use, "source '{}': a live lidar has no rate but real", source);
    }
    pace = *parsed;
  }
  auto opened = open_kind(*spec, stop);
  if (!opened || pace == kUnpaced || is_live(*spec)) return opened;
  return std::make_unique<PacedSource>(*std::move(opened), pace, clock,
                                       stoppable_wait(std::move(stop)));
}

Result<std::unique_ptr<sensing::ScanSource>> open_source_with_attitude(
    std::string_view source, std::string_view attitude, SourcePace default_pace,
    const std::stop_token& stop) {
  if (attitude.empty()) return open_source(source, default_pace, stop);
  const auto spec = parse_source_spec(attitude);
  if (!spec) return forward_error(spec);
  const auto options = ahrs::read_ahrs_options(*spec);
  if (!options) return forward_error(options);
  const auto scan_spec = parse_source_spec(source);
  if (!scan_spec) return forward_error(scan_spec);
  if (scan_spec->kind == "ros2") {
    return fail(ErrorCode::wrong_use,
                "attitude '{}': source '{}' takes its attitude by a topic: write "
                "ros2:/scan,/imu/data, and leave --attitude out",
                attitude, source);
  }
  if (!is_live(*scan_spec)) {
    return fail(ErrorCode::wrong_use,
                "attitude '{}': source '{}' is no live lidar, it brings its own attitude; leave "
                "--attitude out",
                attitude, source);
  }
  auto attitudes = ahrs::open_ahrs_source(*options, stop);
  if (!attitudes) return forward_error(attitudes);
  auto scans = open_source(source, default_pace, stop);
  if (!scans) return scans;
  return std::make_unique<JoinedSource>(*std::move(scans), *std::move(attitudes));
}

}  // namespace lifeline::sources
