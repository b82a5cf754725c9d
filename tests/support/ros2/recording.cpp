#include "tests/support/ros2/recording.hpp"

#include <memory>
#include <span>
#include <stdexcept>

#include <sqlite3.h>

#include "common/ros2/cdr_reader.hpp"

namespace lifeline::test {
namespace {

constexpr std::size_t kMostFloats = 1'000'000;
char frame_id[] = "laser";

void read(ros2::CdrReader& reader, std_msgs_msg_dds__Header_& header) {
  header.stamp.sec = reader.read<std::int32_t>();
  header.stamp.nanosec = reader.read<std::uint32_t>();
  reader.skip_text();
  header.frame_id = frame_id;
}

ScanMessage read_scan(ros2::CdrReader& reader) {
  ScanMessage scan;
  read(reader, scan.fields.header);
  for (float* value : {&scan.fields.angle_min, &scan.fields.angle_max, &scan.fields.angle_increment,
                       &scan.fields.time_increment, &scan.fields.scan_time, &scan.fields.range_min,
                       &scan.fields.range_max}) {
    *value = reader.read<float>();
  }
  scan.ranges = reader.read_floats(kMostFloats);
  scan.intensities = reader.read_floats(kMostFloats);
  return scan;
}

void read(ros2::CdrReader& reader, std::span<double> values) {
  for (double& value : values) value = reader.read<double>();
}

void read(ros2::CdrReader& reader, geometry_msgs_msg_dds__Vector3_& vector) {
  for (double* value : {&vector.x, &vector.y, &vector.z}) *value = reader.read<double>();
}

ImuMessage read_imu(ros2::CdrReader& reader) {
  ImuMessage imu{};
  read(reader, imu.header);
  for (double* value :
       {&imu.orientation.x, &imu.orientation.y, &imu.orientation.z, &imu.orientation.w}) {
    *value = reader.read<double>();
  }
  read(reader, imu.orientation_covariance);
  read(reader, imu.angular_velocity);
  read(reader, imu.angular_velocity_covariance);
  read(reader, imu.linear_acceleration);
  read(reader, imu.linear_acceleration_covariance);
  return imu;
}

void require(bool condition, const std::string& what) {
  if (!condition) throw std::runtime_error(what);
}

}  // namespace

std::vector<RecordedMessage> read_recording(const std::string& file, const std::string& scan_topic,
                                            const std::string& imu_topic) {
  sqlite3* opened = nullptr;
  const int status = sqlite3_open_v2(("file:" + file + "?immutable=1").c_str(), &opened,
                                     SQLITE_OPEN_READONLY | SQLITE_OPEN_URI, nullptr);
  const std::unique_ptr<sqlite3, decltype(&sqlite3_close)> database(opened, sqlite3_close);
  require(status == SQLITE_OK, file + ": cannot be opened");
  sqlite3_stmt* prepared = nullptr;
  sqlite3_prepare_v2(
      database.get(),
      "SELECT topics.name, messages.timestamp, messages.data FROM messages JOIN topics ON "
      "topics.id = messages.topic_id ORDER BY messages.timestamp, messages.id",
      -1, &prepared, nullptr);
  const std::unique_ptr<sqlite3_stmt, decltype(&sqlite3_finalize)> rows(prepared, sqlite3_finalize);
  require(rows != nullptr, file + ": is no rosbag2 recording");
  std::vector<RecordedMessage> messages;
  while (sqlite3_step(rows.get()) == SQLITE_ROW) {
    const std::string topic = reinterpret_cast<const char*>(sqlite3_column_text(rows.get(), 0));
    if (topic != scan_topic && topic != imu_topic) continue;
    const std::span bytes(static_cast<const std::uint8_t*>(sqlite3_column_blob(rows.get(), 2)),
                          static_cast<std::size_t>(sqlite3_column_bytes(rows.get(), 2)));
    auto reader = ros2::CdrReader::open_cdr(bytes);
    require(reader.has_value(), file + ": a message is not plain CDR");
    RecordedMessage next{sqlite3_column_int64(rows.get(), 1), {}};
    if (topic == scan_topic) {
      next.message = read_scan(*reader);
    } else {
      next.message = read_imu(*reader);
    }
    require(reader->ok(), file + ": a message of " + topic + " is cut off");
    messages.push_back(std::move(next));
  }
  require(!messages.empty(), file + ": has no message of " + scan_topic + " or " + imu_topic);
  return messages;
}

}  // namespace lifeline::test
