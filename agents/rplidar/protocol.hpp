#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace lifeline::rplidar {

/// The serial protocol of Slamtec's RPLIDAR A series, after the "Interface Protocol and Application
/// Notes" and the constants of the public SDK. All numbers are little-endian.

using Bytes = std::span<const std::uint8_t>;

/// Requests. Those with the top bit set carry a payload.
enum class Command : std::uint8_t {
  stop = 0x25,
  reset = 0x40,
  scan = 0x20,
  get_info = 0x50,
  get_health = 0x52,
  express_scan = 0x82,
  get_lidar_conf = 0x84,
  set_motor_pwm = 0xF0,
  get_accessory_flag = 0xFF,
};

/// What an answer holds, as its descriptor says.
enum class AnswerType : std::uint8_t {
  info = 0x04,
  health = 0x06,
  lidar_conf = 0x20,
  standard_nodes = 0x81,
  express_capsules = 0x82,
  ultra_capsules = 0x84,
  dense_capsules = 0x85,
  accessory_flag = 0xFF,
};

/// Entries that get_lidar_conf asks for; all but the first two take a mode's id.
enum class ConfEntry : std::uint32_t {
  mode_count = 0x70,
  typical_mode = 0x7C,
  us_per_sample = 0x71,
  max_distance = 0x74,
  answer_type = 0x75,
  mode_name = 0x7F,
};

/// The 7 bytes before every answer.
struct Descriptor {
  std::uint32_t length = 0;  ///< of one answer, bytes; below 2^30
  bool repeating = false;    ///< answers follow until another request comes
  std::uint8_t type = 0;     ///< an AnswerType, or one that is not known here
};
constexpr std::size_t kDescriptorBytes = 7;

struct DeviceInfo {
  int model = 0;
  int firmware_major = 0, firmware_minor = 0;
  int hardware = 0;
  std::string serial_number;  ///< 32 hexadecimal digits
};

enum class HealthStatus { good, warning, error };
struct Health {
  HealthStatus status = HealthStatus::good;
  int error_code = 0;
};

/// One way of scanning that the device offers.
struct ScanMode {
  std::uint16_t id = 0;
  std::string name;
  double us_per_sample = 0.0;
  double max_distance_m = 0.0;
  std::uint8_t answer_type = 0;

  [[nodiscard]] double samples_per_s() const { return 1e6 / us_per_sample; }
};

/// A request as it goes over the line: start byte, command and, with a payload, length and checksum
/// (exclusive or of everything before). At most 255 bytes of payload.
[[nodiscard]] std::vector<std::uint8_t> encode_request(Command command, Bytes payload = {});

/// The payload that starts express scanning in a mode.
[[nodiscard]] std::vector<std::uint8_t> express_payload(std::uint16_t mode);
/// The payload that asks for an entry, of a mode where the entry is one of a mode.
[[nodiscard]] std::vector<std::uint8_t> conf_payload(ConfEntry entry,
                                                     std::optional<std::uint16_t> mode = {});
/// The payload that sets the motor's pulse width, 0 (stop) to 1023.
[[nodiscard]] std::vector<std::uint8_t> motor_payload(std::uint16_t pwm);

// What answers say; nothing where they are too short or make no sense. Bytes beyond what is known
// are passed over: newer firmware may tell more.
[[nodiscard]] std::optional<Descriptor> parse_descriptor(Bytes bytes);
[[nodiscard]] std::optional<DeviceInfo> parse_info(Bytes answer);
[[nodiscard]] std::optional<Health> parse_health(Bytes answer);
/// Whether the accessory board drives the motor.
[[nodiscard]] std::optional<bool> parse_accessory_flag(Bytes answer);
/// What an answer to get_lidar_conf says of `entry`; nothing where it is about another one.
[[nodiscard]] std::optional<Bytes> conf_value(Bytes answer, ConfEntry entry);
/// A value of 1 to 4 bytes; nothing where there are too few.
[[nodiscard]] std::optional<std::uint32_t> parse_number(Bytes value, std::size_t size);
/// A name up to its zero byte, at most 32 characters; what is not printable becomes '?'.
[[nodiscard]] std::string parse_name(Bytes value);

/// Finds the answer of one type in a stream that may begin with anything else (what was still on
/// its way when the request went out).
class AnswerFinder {
 public:
  explicit AnswerFinder(AnswerType type) : type_(type) {}

  /// Takes what came; true as soon as the answer is there. A repeating answer is there with its
  /// descriptor.
  [[nodiscard]] bool push(Bytes bytes);

  [[nodiscard]] Bytes answer() const;
  /// What came behind the answer.
  [[nodiscard]] Bytes rest() const;
  /// Whether anything at all came.
  [[nodiscard]] bool heard() const { return heard_; }

 private:
  [[nodiscard]] bool look();

  AnswerType type_;
  std::vector<std::uint8_t> buffer_;
  std::optional<Descriptor> found_;
  bool heard_ = false;
};

}  // namespace lifeline::rplidar
