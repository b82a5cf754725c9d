// A ROS 2 driver as far as DDS can tell: plays a rosbag2 recording's LaserScan and Imu messages,
// with Cyclone DDS. lifeline-ros2-driver walk.db3, and, in another window,
// lifeline-agent slam --source 'ros2:/scan,/imu/data?qos=config/qos/ros2-loopback.xml'.

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <optional>
#include <stdexcept>
#include <string>
#include <thread>

#include <CLI/CLI.hpp>
#include <dds/dds.h>

#include "tests/support/ros2/recording.hpp"

namespace lifeline::test {
namespace {

struct Options {
  std::string file;
  std::uint32_t domain = 0;
  std::string scan = "/scan", imu = "/imu/data";
  std::string publish_scan, publish_imu;
  double rate = 1.0;
  std::string steps;
  bool best_effort = false;
};

// Unicast on 127.0.0.1, unless CYCLONEDDS_URI says otherwise; all else as Cyclone DDS has it.
constexpr const char* kLoopbackOnly =
    "<CycloneDDS><Domain id=\"any\"><General>"
    "<Interfaces><NetworkInterface address=\"127.0.0.1\"/></Interfaces>"
    "<AllowMulticast>false</AllowMulticast></General>"
    "<Discovery><ParticipantIndex>auto</ParticipantIndex>"
    "<MaxAutoParticipantIndex>47</MaxAutoParticipantIndex>"
    "<Peers><Peer address=\"127.0.0.1\"/></Peers></Discovery></Domain></CycloneDDS>";

dds_entity_t check(dds_entity_t result, const char* what) {
  if (result < 0) throw std::runtime_error(std::string(what) + ": " + dds_strretcode(-result));
  return result;
}

class Driver {
 public:
  explicit Driver(const Options& options)
      : participant_(check(dds_create_participant(options.domain, nullptr, nullptr), "domain")) {
    scans_ = writer(sensor_msgs_msg_dds__LaserScan__desc,
                    options.publish_scan.empty() ? options.scan : options.publish_scan, options);
    attitudes_ = writer(sensor_msgs_msg_dds__Imu__desc,
                        options.publish_imu.empty() ? options.imu : options.publish_imu, options);
  }
  ~Driver() { dds_delete(participant_); }
  Driver(const Driver&) = delete;
  Driver& operator=(const Driver&) = delete;

  [[nodiscard]] bool is_heard(bool with_attitude) const {
    return has_reader(scans_) && (!with_attitude || has_reader(attitudes_));
  }
  void write(ScanMessage& scan) const {
    const auto lend = [](std::vector<float>& values, auto& sequence) {
      sequence._buffer = values.data();
      sequence._length = sequence._maximum = static_cast<std::uint32_t>(values.size());
    };
    lend(scan.ranges, scan.fields.ranges);
    lend(scan.intensities, scan.fields.intensities);
    check(dds_write(scans_, &scan.fields), "scan");
  }
  void write(const ImuMessage& imu) const { check(dds_write(attitudes_, &imu), "imu"); }

 private:
  [[nodiscard]] dds_entity_t writer(const dds_topic_descriptor_t& type, const std::string& topic,
                                    const Options& options) const {
    const std::string name = "rt" + topic;
    dds_qos_t* qos = dds_create_qos();
    dds_qset_reliability(
        qos, options.best_effort ? DDS_RELIABILITY_BEST_EFFORT : DDS_RELIABILITY_RELIABLE,
        DDS_SECS(1));
    dds_qset_history(qos, DDS_HISTORY_KEEP_LAST, 10);
    const dds_entity_t made =
        check(dds_create_topic(participant_, &type, name.c_str(), nullptr, nullptr), "topic");
    const dds_entity_t result =
        check(dds_create_writer(participant_, made, qos, nullptr), "writer");
    dds_delete_qos(qos);
    return result;
  }
  [[nodiscard]] static bool has_reader(dds_entity_t writer) {
    dds_publication_matched_status_t status{};
    check(dds_get_publication_matched_status(writer, &status), "matched");
    return status.current_count > 0;
  }

  dds_entity_t participant_;
  dds_entity_t scans_ = 0;
  dds_entity_t attitudes_ = 0;
};

/// Plays everything, at its pace and no faster than it is told; how many scans that were.
int play(const Options& options, std::vector<RecordedMessage>& messages) {
  Driver driver(options);
  bool with_attitude = false;
  for (const RecordedMessage& each : messages) {
    with_attitude = with_attitude || std::holds_alternative<ImuMessage>(each.message);
  }
  while (!driver.is_heard(with_attitude)) dds_sleepfor(DDS_MSECS(10));
  std::puts("heard");
  std::fflush(stdout);
  std::ifstream steps;
  if (!options.steps.empty()) steps.open(options.steps);  // waits for its other end
  std::optional<std::chrono::steady_clock::time_point> start;
  bool may_go_on = options.steps.empty();
  int scans = 0;
  for (RecordedMessage& next : messages) {
    if (!may_go_on && steps.get() == std::char_traits<char>::eof()) break;
    if (!start) start = std::chrono::steady_clock::now();
    if (options.rate > 0.0) {
      const double due_ns = static_cast<double>(next.time_ns - messages[0].time_ns) / options.rate;
      std::this_thread::sleep_until(*start +
                                    std::chrono::nanoseconds(static_cast<std::int64_t>(due_ns)));
    }
    std::visit([&](auto& message) { driver.write(message); }, next.message);
    const bool is_scan = std::holds_alternative<ScanMessage>(next.message);
    scans += is_scan ? 1 : 0;
    may_go_on = options.steps.empty() || !is_scan;
  }
  return scans;
}

}  // namespace
}  // namespace lifeline::test

int main(int argc, char** argv) {
  using namespace lifeline::test;
  CLI::App app("Plays a rosbag2 recording as a ROS 2 driver would publish it, once it is heard",
               "lifeline-ros2-driver");
  Options options;
  app.add_option("file", options.file, "A .db3 file")->required();
  app.add_option("--domain", options.domain, "DDS domain (default 0)");
  app.add_option("--scan", options.scan, "The recording's LaserScan topic (default /scan)");
  app.add_option("--imu", options.imu, "The recording's Imu topic (default /imu/data)");
  app.add_option("--publish-scan", options.publish_scan, "Another name to publish the scans by");
  app.add_option("--publish-imu", options.publish_imu, "Another name to publish the attitude by");
  app.add_option("--rate", options.rate, "Times as fast as recorded; 0: at once (default 1)");
  app.add_option("--steps", options.steps, "A FIFO: each octet in it lets one more scan go");
  app.add_flag("--best-effort", options.best_effort, "Offer best effort, not reliable");
  CLI11_PARSE(app, argc, argv);
  setenv("CYCLONEDDS_URI", kLoopbackOnly, 0);
  try {
    auto messages = read_recording(options.file, options.scan, options.imu);
    std::printf("played %d scans\n", play(options, messages));
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "lifeline-ros2-driver: %s\n", error.what());
    return 1;
  }
}
