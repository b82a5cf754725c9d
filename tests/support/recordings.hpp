#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "agents/sensing/scan_source.hpp"
#include "common/base/result.hpp"

/// Small recordings of every format, written by the tests themselves, without the readers' code.
namespace lifeline::test {

/// A folder of its own, gone with the object.
class RecordingFolder {
 public:
  RecordingFolder();
  ~RecordingFolder();
  RecordingFolder(const RecordingFolder&) = delete;
  RecordingFolder& operator=(const RecordingFolder&) = delete;

  [[nodiscard]] std::string path(std::string_view name) const;
  /// Writes a file as it is, or compressed by gzip; returns its path.
  std::string write(std::string_view name, std::string_view content) const;
  std::string write_gz(std::string_view name, std::string_view content) const;

 private:
  std::filesystem::path folder_;
};

/// What a source gave until it ended.
struct Played {
  std::vector<sensing::RawScan> scans;
  std::string error;  ///< of next(), or of opening; empty for an ordinary end
  ErrorCode code = ErrorCode::unavailable;
};
[[nodiscard]] Played play(std::string_view source);

/// FLASER line `k` of a log: every range 1 + k m, corrected pose (k, 2k, 0.1k), odometry
/// (10 + k, 20 + k, 0.2k), time `time` as written.
[[nodiscard]] std::string flaser_line(std::size_t beams, int k, std::string_view time);
/// `scans` such lines, one second apart from 100 s, each behind an ODOM line.
[[nodiscard]] std::string carmen_log(std::size_t beams, int scans);

enum class Encoding { cdr_little, cdr_big, ros1 };

/// Serializes ROS messages field by field.
class MessageWriter {
 public:
  explicit MessageWriter(Encoding encoding);
  template <typename Number>
  MessageWriter& add(Number value) {
    std::uint8_t bytes[sizeof(Number)];
    const auto* from = reinterpret_cast<const std::uint8_t*>(&value);
    for (std::size_t i = 0; i < sizeof(Number); ++i) {
      bytes[encoding_ == Encoding::cdr_big ? sizeof(Number) - 1 - i : i] = from[i];
    }
    align(sizeof(Number));
    bytes_.insert(bytes_.end(), bytes, bytes + sizeof(Number));
    return *this;
  }
  MessageWriter& add_text(std::string_view text);
  MessageWriter& add_floats(const std::vector<float>& values);
  MessageWriter& add_header(std::uint32_t seconds, std::uint32_t nanoseconds);
  [[nodiscard]] std::vector<std::uint8_t> bytes() const { return bytes_; }

 private:
  void align(std::size_t size);
  Encoding encoding_;
  std::vector<std::uint8_t> bytes_;
};

/// The fields of a LaserScan that tests vary.
struct LaserFields {
  std::uint32_t seconds = 100;
  std::uint32_t nanoseconds = 500;
  float angle_min = -1.5F;
  float angle_increment = 0.5F;
  float time_increment = 0.25F;
  float range_min = 0.125F;
  float range_max = 12.0F;
  std::vector<float> ranges{1.0F, 2.0F, 3.0F};
};
[[nodiscard]] std::vector<std::uint8_t> laser_message(const LaserFields& fields, Encoding encoding);

struct ImuFields {
  std::uint32_t seconds = 100;
  std::uint32_t nanoseconds = 500;
  double x = 0.0, y = 0.0, z = 0.0, w = 1.0;
  double first_covariance = 0.0;
};
[[nodiscard]] std::vector<std::uint8_t> imu_message(const ImuFields& fields, Encoding encoding);

struct TopicToWrite {
  std::string name;
  std::string type;
  std::string serialization = "cdr";
};
struct MessageToWrite {
  std::size_t topic = 0;  ///< index into the topics
  std::int64_t time_ns = 0;
  std::vector<std::uint8_t> bytes;
};
/// One .db3 file of a rosbag2 recording.
void write_db3(const std::string& path, const std::vector<TopicToWrite>& topics,
               const std::vector<MessageToWrite>& messages);

/// How a ROS 1 bag is written.
struct BagStyle {
  std::string compression = "none";
  std::uint32_t extra_index_length = 0;  ///< what the index records' lengths lie by
};
/// A ROS 1 bag with one chunk per message.
[[nodiscard]] std::string ros1_bag(const std::vector<TopicToWrite>& topics,
                                   const std::vector<MessageToWrite>& messages,
                                   const BagStyle& style = {});

}  // namespace lifeline::test
