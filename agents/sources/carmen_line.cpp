#include "agents/sources/carmen_line.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <optional>

#include "common/base/decimal_seconds.hpp"

namespace lifeline::sources {
namespace {

constexpr std::string_view kBlanks = " \t\r";
constexpr std::size_t kOdomFields = 10;  // ODOM x y theta tv rv accel time host logger_time
/// Beyond this, metres or radians are garbage and would spoil what is computed from them.
constexpr double kLargestNumber = 1e9;

/// Takes the next field off the front of `line`; empty when nothing is left.
std::string_view take_field(std::string_view& line) {
  line.remove_prefix(std::min(line.find_first_not_of(kBlanks), line.size()));
  const std::string_view field = line.substr(0, line.find_first_of(kBlanks));
  line.remove_prefix(field.size());
  return field;
}

std::size_t count_fields(std::string_view line) {
  std::size_t count = 0;
  while (!take_field(line).empty()) ++count;
  return count;
}

/// Never a whole field in a message: it may be anything.
std::string_view shortened(std::string_view field) {
  return field.substr(0, 20);
}

Result<double> read_number(std::string_view field, std::string_view what) {
  double value = 0.0;
  const auto [rest, error] = std::from_chars(field.data(), field.data() + field.size(), value);
  if (error != std::errc{} || rest != field.data() + field.size()) {
    return fail(ErrorCode::bad_data, "{} '{}' is not a number", what, shortened(field));
  }
  if (!std::isfinite(value) || std::abs(value) > kLargestNumber) {
    return fail(ErrorCode::bad_data, "{} {} is not a usable number", what, shortened(field));
  }
  return value;
}

Result<void> read_ranges(std::string_view& line, std::size_t beams, std::vector<float>& ranges_m) {
  ranges_m.reserve(beams);
  for (std::size_t i = 0; i < beams; ++i) {
    const auto range_m = read_number(take_field(line), "range");
    if (!range_m || *range_m < 0.0) {
      return fail(ErrorCode::bad_data, "beam {}: {}", i,
                  range_m ? fmt::format("range {} is negative", *range_m) : range_m.error().text);
    }
    ranges_m.push_back(static_cast<float>(*range_m));
  }
  return {};
}

Result<Pose2> read_pose(std::string_view& line, std::array<std::string_view, 3> names) {
  std::array<double, 3> values{};
  for (std::size_t i = 0; i < 3; ++i) {
    const auto value = read_number(take_field(line), names[i]);
    if (!value) return forward_error(value);
    values[i] = *value;
  }
  return Pose2{values[0], values[1], normalise_angle(values[2])};
}

}  // namespace

Result<BeamFan> beam_fan(std::size_t beams) {
  constexpr double kRadPerDeg = std::numbers::pi / 180.0;
  if (beams == 180 || beams == 181) return BeamFan{-90.0 * kRadPerDeg, 1.0 * kRadPerDeg};
  if (beams == 360 || beams == 361) return BeamFan{-90.0 * kRadPerDeg, 0.5 * kRadPerDeg};
  return fail(ErrorCode::bad_data, "{} beams: only FLASER lines of 180, 181, 360 or 361 are known",
              beams);
}

bool is_flaser(std::string_view line) {
  return take_field(line) == "FLASER";
}

bool is_whole_other_line(std::string_view line) {
  const std::size_t fields = count_fields(line);
  const std::string_view kind = take_field(line);
  if (kind == "ODOM") return fields == kOdomFields;
  return kind.empty() || kind.starts_with('#');
}

Result<FlaserLine> parse_flaser(std::string_view line) {
  const std::size_t fields = count_fields(line);
  take_field(line);
  const std::string_view count = take_field(line);
  std::uint32_t beams = 0;
  const auto [rest, error] = std::from_chars(count.data(), count.data() + count.size(), beams);
  if (error != std::errc{} || rest != count.data() + count.size()) {
    return fail(ErrorCode::bad_data, "FLASER beam count '{}' is not a number", shortened(count));
  }
  if (const auto fan = beam_fan(beams); !fan) return forward_error(fan);
  if (fields != beams + 11) {
    return fail(ErrorCode::bad_data,
                "FLASER with {} beams needs {} fields and has {}: the line is {}", beams,
                beams + 11, fields, fields < beams + 11 ? "cut off" : "of some other format");
  }
  FlaserLine scan;
  if (const auto read = read_ranges(line, beams, scan.ranges_m); !read) return forward_error(read);
  const auto T_world_laser = read_pose(line, {"x", "y", "theta"});
  if (!T_world_laser) return forward_error(T_world_laser);
  const auto T_odom_laser = read_pose(line, {"odom_x", "odom_y", "odom_theta"});
  if (!T_odom_laser) return forward_error(T_odom_laser);
  const std::string_view time_text = take_field(line);
  const auto time = parse_decimal_seconds(time_text);
  if (!time) {
    return fail(ErrorCode::bad_data, "time '{}' is not a time in seconds", shortened(time_text));
  }
  scan.T_world_laser = *T_world_laser;
  scan.T_odom_laser = *T_odom_laser;
  scan.time = *time;
  return scan;
}

}  // namespace lifeline::sources
