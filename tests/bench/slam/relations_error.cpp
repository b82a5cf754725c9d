#include "tests/bench/slam/relations_error.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "agents/sources/line_reader.hpp"
#include "common/base/check.hpp"

namespace lifeline::bench {
namespace {

/// Seconds as double, as the relations are used everywhere: 0.2 us at today's times.
struct TimedPose {
  double t_s;
  Pose2 pose;
};

void sort_by_time(std::vector<TimedPose>& poses) {
  std::ranges::stable_sort(poses, {}, &TimedPose::t_s);
}

/// The double nearest to the stamp's decimal seconds, as reading them from text gives it: relations
/// begin at the very times of scans, so one last bit decides which scan carries a pose there.
double nearest_seconds(Timestamp stamp) {
  const std::int64_t nanoseconds = stamp.time_since_epoch().count();
  LIFELINE_CHECK(nanoseconds >= 0);
  const std::string text =
      fmt::format("{}.{:09}", nanoseconds / 1'000'000'000, nanoseconds % 1'000'000'000);
  double seconds = 0.0;
  std::from_chars(text.data(), text.data() + text.size(), seconds);
  return seconds;
}

std::vector<std::string_view> split(std::string_view line) {
  constexpr std::string_view kBlank = " \t\r";
  std::vector<std::string_view> fields;
  while (true) {
    const auto begin = line.find_first_not_of(kBlank);
    if (begin == std::string_view::npos) return fields;
    const auto end = std::min(line.find_first_of(kBlank, begin), line.size());
    fields.push_back(line.substr(begin, end - begin));
    line.remove_prefix(end);
  }
}

/// Empty where one of the fields is not a finite number.
std::optional<std::vector<double>> numbers(std::span<const std::string_view> fields) {
  std::vector<double> values;
  for (const std::string_view field : fields) {
    double value = 0.0;
    const auto [end, error] = std::from_chars(field.data(), field.data() + field.size(), value);
    if (error != std::errc{} || end != field.data() + field.size() || !std::isfinite(value)) {
      return std::nullopt;
    }
    values.push_back(value);
  }
  return values;
}

/// Calls visit(fields) for every line, which answers false for one that is malformed.
template <typename Visit>
Result<void> for_each_line(const std::filesystem::path& file, Visit visit) {
  auto reader = sources::LineReader::open(file.string());
  if (!reader) return forward_error(reader);
  while (true) {
    const auto line = reader->next();
    if (!line) return forward_error(line);
    if (!*line) return {};
    if (!visit(split((*line)->text))) {
      return fail(ErrorCode::bad_data, "{}:{}: not as many finite numbers as there should be",
                  file.string(), reader->line_number());
    }
  }
}

Result<std::vector<TimedPose>> read_odometry(const std::filesystem::path& log) {
  std::vector<TimedPose> poses;
  const auto add = [&](std::span<const std::string_view> fields, std::size_t pose, std::size_t t) {
    if (fields.size() <= std::max(pose + 2, t)) return false;
    const auto p = numbers(fields.subspan(pose, 3)), time = numbers(fields.subspan(t, 1));
    if (!p || !time) return false;
    poses.push_back({(*time)[0], {(*p)[0], (*p)[1], (*p)[2]}});
    return true;
  };
  const auto read = for_each_line(log, [&](const std::vector<std::string_view>& fields) {
    if (fields.empty()) return true;
    if (fields[0] == "ODOM") return add(fields, 1, 7);
    if (fields[0] != "FLASER" || fields.size() < 2) return true;
    std::size_t beams = 0;
    std::from_chars(fields[1].data(), fields[1].data() + fields[1].size(), beams);
    // Behind the ranges: the corrected pose, the odometry, the time.
    return beams < fields.size() && add(fields, beams + 5, beams + 8);
  });
  if (!read) return forward_error(read);
  if (poses.empty()) {
    return fail(ErrorCode::bad_data, "{}: holds no odometry", log.string());
  }
  sort_by_time(poses);
  return poses;
}

/// The place of the first pose later than t.
std::size_t after(const std::vector<TimedPose>& poses, double t_s) {
  return static_cast<std::size_t>(std::ranges::upper_bound(poses, t_s, {}, &TimedPose::t_s) -
                                  poses.begin());
}

/// Linear between neighbours, constant beyond the ends.
Pose2 at(const std::vector<TimedPose>& poses, double t_s) {
  const std::size_t i = after(poses, t_s);
  if (i == 0) return poses.front().pose;
  if (i == poses.size()) return poses.back().pose;
  const TimedPose &a = poses[i - 1], &b = poses[i];
  const double u = (t_s - a.t_s) / (b.t_s - a.t_s);
  return {a.pose.x_m + u * (b.pose.x_m - a.pose.x_m), a.pose.y_m + u * (b.pose.y_m - a.pose.y_m),
          normalise_angle(a.pose.yaw_rad + u * normalise_angle(b.pose.yaw_rad - a.pose.yaw_rad))};
}

/// The estimate carried by the wheels from the scan before to any time.
std::optional<Pose2> carried(const std::vector<TimedPose>& estimate,
                             const std::vector<TimedPose>& odometry, double t_s) {
  constexpr double kMaxGapS = 10.0;
  const std::size_t i = after(estimate, t_s);
  double gap_s = std::numeric_limits<double>::infinity();
  if (i > 0) gap_s = std::abs(estimate[i - 1].t_s - t_s);
  if (i < estimate.size()) gap_s = std::min(gap_s, std::abs(estimate[i].t_s - t_s));
  if (gap_s > kMaxGapS) return std::nullopt;
  const TimedPose& from = estimate[i > 0 ? i - 1 : 0];
  return from.pose * (at(odometry, from.t_s).inverse() * at(odometry, t_s));
}

void mean_and_std(const std::vector<double>& values, double& mean, double& deviation) {
  const auto count = static_cast<double>(values.size());
  double sum = 0.0, squares = 0.0;
  for (const double value : values) sum += value;
  mean = sum / count;
  for (const double value : values) squares += (value - mean) * (value - mean);
  deviation = std::sqrt(squares / count);
}

}  // namespace

Result<RelationsError> relations_error(std::span<const StampedPose> estimate,
                                       const std::filesystem::path& relations,
                                       const std::filesystem::path& odometry) {
  if (estimate.size() < 2) return fail(ErrorCode::bad_data, "fewer than two poses to judge");
  const auto wheels = read_odometry(odometry);
  if (!wheels) return forward_error(wheels);
  std::vector<TimedPose> poses;
  for (const StampedPose& pose : estimate) {
    poses.push_back({nearest_seconds(pose.stamp), pose.pose});
  }
  sort_by_time(poses);
  RelationsError error;
  std::vector<double> translations_m, rotations_deg;
  const auto read = for_each_line(relations, [&](const std::vector<std::string_view>& fields) {
    if (fields.empty() || fields[0].starts_with('#')) return true;
    if (fields.size() < 8) return false;
    const auto v = numbers(std::span(fields).first(8));
    if (!v) return false;
    const auto from = carried(poses, *wheels, (*v)[0]), to = carried(poses, *wheels, (*v)[1]);
    if (!from || !to) {
      ++error.lost;
      return true;
    }
    const Pose2 off = Pose2{(*v)[2], (*v)[3], (*v)[7]}.inverse() * (from->inverse() * *to);
    translations_m.push_back(off.translation().norm());
    rotations_deg.push_back(std::abs(off.yaw_rad) * 180.0 / std::numbers::pi);
    return true;
  });
  if (!read) return forward_error(read);
  error.judged = translations_m.size();
  mean_and_std(translations_m, error.translation_mean_m, error.translation_std_m);
  mean_and_std(rotations_deg, error.rotation_mean_deg, error.rotation_std_deg);
  return error;
}

}  // namespace lifeline::bench
