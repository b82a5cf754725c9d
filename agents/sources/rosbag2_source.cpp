#include "agents/sources/rosbag2_source.hpp"

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/ranges.h>

#include "agents/sources/attitude_track.hpp"
#include "agents/sources/bag_stream.hpp"
#include "agents/sources/laser_messages.hpp"
#include "agents/sources/ros1_bag.hpp"
#include "agents/sources/scan_range.hpp"
#include "agents/sources/sqlite_bag.hpp"

namespace lifeline::sources {
namespace {

namespace fs = std::filesystem;

/// The files of one recording: several .db3, or one .bag.
struct Bag {
  RosVersion version = RosVersion::ros2;
  std::vector<std::string> files;
};

Result<Bag> find_in_folder(const std::string& folder) {
  if (auto files = bag::files_ending(folder, ".db3"); !files.empty()) {
    return Bag{RosVersion::ros2, std::move(files)};
  }
  auto bags = bag::files_ending(folder, ".bag");
  if (bags.size() == 1) return Bag{RosVersion::ros1, std::move(bags)};
  if (!bags.empty()) {
    return fail(ErrorCode::wrong_use, "{}: holds {} .bag files: name one of them", folder,
                bags.size());
  }
  for (const std::string_view ending : {".mcap", ".zstd"}) {
    if (bag::files_ending(folder, ending).empty()) continue;
    return fail(ErrorCode::unsupported,
                "{}: holds only {} files: convert them to uncompressed sqlite3 with ros2 bag "
                "convert",
                folder, ending);
  }
  return fail(ErrorCode::not_found, "{}: holds no bag: neither a .db3 nor a .bag file", folder);
}

Result<Bag> find_bag(const std::string& target) {
  std::error_code ignored;
  if (fs::is_directory(target, ignored)) return find_in_folder(target);
  if (!fs::exists(target, ignored)) {
    return fail(ErrorCode::not_found, "{}: no such file or folder", target);
  }
  std::array<char, 7> start{};
  std::ifstream(target, std::ios::binary).read(start.data(), start.size());
  const bool ros1 = std::string_view(start.data(), start.size()) == "#ROSBAG";
  return Bag{ros1 ? RosVersion::ros1 : RosVersion::ros2, {target}};
}

Result<std::vector<BagTopic>> topics_of(const Bag& bag) {
  return bag.version == RosVersion::ros1 ? ros1_topics(bag.files[0]) : sqlite_topics(bag.files[0]);
}

Result<BagStream> open_topic(const Bag& bag, const std::string& topic) {
  return bag.version == RosVersion::ros1 ? open_ros1_topic(bag.files[0], topic)
                                         : open_sqlite_topic(bag.files, topic);
}

std::string listed(const std::vector<BagTopic>& topics) {
  constexpr std::size_t kMost = 10;
  std::vector<std::string> texts;
  for (const BagTopic& topic : topics) {
    if (texts.size() < kMost) texts.push_back(topic.name + " (" + topic.type + ")");
  }
  if (topics.size() > kMost) texts.push_back(fmt::format("{} more", topics.size() - kMost));
  return texts.empty() ? "no topic" : fmt::format("{}", fmt::join(texts, ", "));
}

bool has_type(const BagTopic& topic, std::string_view type) {
  return topic.type == fmt::format("sensor_msgs/msg/{}", type) ||
         topic.type == fmt::format("sensor_msgs/{}", type);
}

/// The topic called `name`, or the first of the type where `name` is empty; empty where there is
/// none of the type.
Result<std::optional<std::string>> choose_topic(const std::string& target,
                                                const std::vector<BagTopic>& topics,
                                                std::string_view type, const std::string& name) {
  for (const BagTopic& topic : topics) {
    if (name.empty() ? has_type(topic, type) : topic.name == name) {
      if (has_type(topic, type)) return topic.name;
      return fail(ErrorCode::wrong_use, "{}: topic {} is of type {}, not {}", target, name,
                  topic.type, type);
    }
  }
  if (name.empty()) return std::nullopt;
  return fail(ErrorCode::not_found, "{}: has no topic {}; it holds {}", target, name,
              listed(topics));
}

ImuStream imu_samples(BagStream messages, RosVersion version) {
  return [messages = std::move(messages), version]() -> Result<std::optional<ImuSample>> {
    const auto message = messages();
    if (!message) return forward_error(message);
    if (!*message) return std::nullopt;
    const auto sample = decode_imu((*message)->bytes, version);
    if (sample) return *sample;
    return fail(sample.error().code, "{}: {}", (*message)->place, sample.error().text);
  };
}

class BagSource final : public sensing::ScanSource {
 public:
  BagSource(std::string target, RosVersion version, ScanRange range, std::string topic,
            BagStream scans, std::optional<AttitudeTrack> attitudes)
      : target_(std::move(target)),
        version_(version),
        range_(range),
        topic_(std::move(topic)),
        scans_(std::move(scans)),
        attitudes_(std::move(attitudes)) {}

  Result<std::optional<sensing::RawScan>> next() override {
    if (ended_) return std::nullopt;
    auto scan = next_wanted();
    ended_ = !scan || !*scan;
    return scan;
  }

 private:
  Result<std::optional<sensing::RawScan>> next_wanted() {
    while (index_ < range_.to) {
      const auto message = scans_();
      if (!message) return forward_error(message);
      if (!*message) return end_of_bag();
      if (index_++ >= range_.from) return read(**message);
    }
    return std::nullopt;
  }

  Result<std::optional<sensing::RawScan>> read(const BagMessage& message) {
    auto scan = decode_laser_scan(message.bytes, version_);
    if (!scan) return fail(scan.error().code, "{}: {}", message.place, scan.error().text);
    if (attitudes_) {
      if (auto filled = attitudes_->fill(*scan); !filled) return forward_error(filled);
    }
    return *std::move(scan);
  }

  Result<std::optional<sensing::RawScan>> end_of_bag() const {
    const auto checked =
        check_scan_count(target_, index_, range_, fmt::format("topic {} is empty", topic_));
    if (!checked) return forward_error(checked);
    return std::nullopt;
  }

  const std::string target_;
  const RosVersion version_;
  const ScanRange range_;
  const std::string topic_;
  BagStream scans_;
  std::optional<AttitudeTrack> attitudes_;
  std::int64_t index_ = 0;  ///< of the next scan of the topic
  bool ended_ = false;
};

/// The attitude sensor's track; empty where the bag has none or none is wanted.
Result<std::optional<AttitudeTrack>> open_attitudes(const SourceSpec& spec, const Bag& bag,
                                                    const std::vector<BagTopic>& topics) {
  const std::string wanted = spec.text("imu", "");
  if (wanted == "none") return std::nullopt;
  const auto topic = choose_topic(spec.target, topics, "Imu", wanted);
  if (!topic) return forward_error(topic);
  if (!*topic) return std::nullopt;
  auto messages = open_topic(bag, **topic);
  if (!messages) return forward_error(messages);
  return AttitudeTrack(imu_samples(*std::move(messages), bag.version));
}

}  // namespace

Result<std::unique_ptr<sensing::ScanSource>> open_rosbag2_source(const SourceSpec& spec) {
  if (auto known = spec.allow_options({"scan", "imu", "from", "to"}); !known) {
    return forward_error(known);
  }
  const auto range = read_scan_range(spec);
  if (!range) return forward_error(range);
  const auto bag = find_bag(spec.target);
  if (!bag) return forward_error(bag);
  const auto topics = topics_of(*bag);
  if (!topics) return forward_error(topics);
  const auto topic = choose_topic(spec.target, *topics, "LaserScan", spec.text("scan", ""));
  if (!topic) return forward_error(topic);
  if (!*topic) {
    return fail(ErrorCode::not_found, "{}: has no LaserScan topic; it holds {}", spec.target,
                listed(*topics));
  }
  auto attitudes = open_attitudes(spec, *bag, *topics);
  if (!attitudes) return forward_error(attitudes);
  auto scans = open_topic(*bag, **topic);
  if (!scans) return forward_error(scans);
  return std::make_unique<BagSource>(spec.target, bag->version, *range, **topic, *std::move(scans),
                                     *std::move(attitudes));
}

}  // namespace lifeline::sources
