#include "agents/sources/ros2_options.hpp"

#include <limits>

#include "common/base/config_folder.hpp"

namespace lifeline::sources {
namespace {

constexpr std::size_t kLongestName = 200;  // DDS ends at 256 characters

bool is_letter(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
}

/// A name as ROS 2 has them: parts of letters, digits and '_' between '/', none begins with a
/// digit. A relative name counts from the root.
Result<std::string> read_topic(std::string_view text) {
  const std::string name = text.starts_with('/') ? std::string(text) : "/" + std::string(text);
  bool good = name.size() > 1 && name.size() <= kLongestName;
  for (std::size_t i = 1; i < name.size(); ++i) {
    const bool begins = name[i - 1] == '/';
    const bool digit = name[i] >= '0' && name[i] <= '9';
    good = good && (is_letter(name[i]) || (!begins && (digit || name[i] == '/')));
  }
  if (good && name.back() != '/') return name;
  return fail(ErrorCode::wrong_use,
              "ros2: '{}' is no name of a ROS 2 topic; write ros2:/scan,/imu/data", text);
}

Result<std::filesystem::path> qos_file(const SourceSpec& spec) {
  if (const std::string given = spec.text("qos", ""); !given.empty()) return given;
  const auto folder = config_folder();
  if (!folder) return forward_error(folder);
  return *folder / "qos" / "ros2.xml";
}

}  // namespace

Result<Ros2Options> read_ros2_options(const SourceSpec& spec) {
  if (auto known = spec.allow_options({"domain", "qos", "scans"}); !known) {
    return forward_error(known);
  }
  const std::string_view target = spec.target;
  const std::size_t comma = target.find(',');
  const auto scan = read_topic(target.substr(0, comma));
  if (!scan) return forward_error(scan);
  Ros2Options options{.scan = *scan, .imu = {}, .domain = 0, .qos = {}, .scans = 0};
  if (comma != std::string_view::npos) {
    const auto imu = read_topic(target.substr(comma + 1));
    if (!imu) return forward_error(imu);
    if (*imu == *scan) {
      return fail(ErrorCode::wrong_use,
                  "ros2: {} is named twice; scans and attitudes come by two topics", *imu);
    }
    options.imu = *imu;
  }
  const auto domain = spec.integer("domain", 0, 0, 232);
  if (!domain) return forward_error(domain);
  options.domain = static_cast<std::uint32_t>(*domain);
  const auto scans = spec.integer("scans", 0, 1, std::numeric_limits<std::int64_t>::max());
  if (!scans) return forward_error(scans);
  options.scans = *scans;
  auto qos = qos_file(spec);
  if (!qos) return forward_error(qos);
  options.qos = *std::move(qos);
  return options;
}

}  // namespace lifeline::sources
