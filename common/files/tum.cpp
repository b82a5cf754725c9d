#include "common/files/tum.hpp"

#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <optional>
#include <string>
#include <string_view>

#include <fmt/format.h>

#include "common/base/decimal_seconds.hpp"
#include "common/files/atomic_file.hpp"
#include "common/files/read_file.hpp"

namespace lifeline::files {
namespace {

constexpr std::int64_t kNanoseconds = 1'000'000'000;
constexpr std::string_view kBlanks = " \t\r";

/// Takes the next word off the front of `line`; empty at its end.
std::string_view next_word(std::string_view& line) {
  line.remove_prefix(std::min(line.find_first_not_of(kBlanks), line.size()));
  const std::string_view word = line.substr(0, line.find_first_of(kBlanks));
  line.remove_prefix(word.size());
  return word;
}

std::optional<double> to_number(std::string_view word) {
  double number = 0.0;
  const auto [stop, error] = std::from_chars(word.data(), word.data() + word.size(), number);
  if (error != std::errc{} || stop != word.data() + word.size() || !std::isfinite(number)) {
    return std::nullopt;
  }
  return number;
}

/// The heading of a quaternion that need not have length 1; empty for length 0.
std::optional<double> yaw_of(double x, double y, double z, double w) {
  const double sine = 2.0 * (w * z + x * y), cosine = w * w + x * x - y * y - z * z;
  if (w * w + x * x + y * y + z * z == 0.0) return std::nullopt;
  return std::atan2(sine, cosine);
}

std::optional<StampedPose> parse_line(std::string_view line) {
  const auto stamp = parse_decimal_seconds(next_word(line));
  std::array<double, 7> numbers{};
  for (double& number : numbers) {
    const auto parsed = to_number(next_word(line));
    if (!parsed) return std::nullopt;
    number = *parsed;
  }
  const auto [x, y, z, qx, qy, qz, qw] = numbers;
  const auto yaw = yaw_of(qx, qy, qz, qw);
  if (!stamp || !yaw || !next_word(line).empty()) return std::nullopt;
  return StampedPose{Timestamp(*stamp), {x, y, *yaw}};
}

}  // namespace

Result<void> write_tum(const std::filesystem::path& file, std::span<const StampedPose> trajectory) {
  std::string text;
  for (const auto& [stamp, pose] : trajectory) {
    const std::int64_t count = stamp.time_since_epoch().count();
    fmt::format_to(std::back_inserter(text), "{}{}.{:09} {:.9f} {:.9f} 0 0 0 {:.12f} {:.12f}\n",
                   count < 0 ? "-" : "", std::abs(count / kNanoseconds),
                   std::abs(count % kNanoseconds), pose.x_m, pose.y_m, std::sin(pose.yaw_rad / 2.0),
                   std::cos(pose.yaw_rad / 2.0));
  }
  return write_file_atomically(file, text);
}

Result<std::vector<StampedPose>> read_tum(const std::filesystem::path& file) {
  constexpr std::size_t kMaxOctets = std::size_t{1} << 30;
  const auto content = read_file(file, kMaxOctets);
  if (!content) return forward_error(content);
  std::vector<StampedPose> trajectory;
  std::size_t number = 0;
  for (std::string_view rest = *content; !rest.empty();) {
    std::string_view line = rest.substr(0, rest.find('\n'));
    rest.remove_prefix(std::min(line.size() + 1, rest.size()));
    ++number;
    const std::size_t first = line.find_first_not_of(kBlanks);
    if (first == std::string_view::npos || line[first] == '#') continue;
    const auto pose = parse_line(line);
    if (!pose) {
      return fail(ErrorCode::bad_data,
                  "{}:{}: not a pose of TUM text; a line holds t x y z qx qy qz qw", file.string(),
                  number);
    }
    trajectory.push_back(*pose);
  }
  return trajectory;
}

}  // namespace lifeline::files
