#include <array>
#include <cmath>

#include "agents/ahrs/ahrs_decoder.hpp"
#include "agents/ahrs/fields.hpp"
#include "common/base/angles.hpp"

namespace lifeline::ahrs {
namespace {

constexpr std::size_t kMostGroups = 12;  // that NorthTek can print in one line, about

DecodedLine damaged(std::string_view why) {
  return {LineKind::damaged, {}, why};
}

bool is_tag(std::string_view field) {
  return !field.empty() && field.front() >= 'a' && field.front() <= 'z';
}

/// Reads numbers until the next tag; how many there were, or none where one cannot be read.
std::optional<std::size_t> read_group(Fields& fields, std::array<double, 4>& numbers) {
  std::size_t count = 0;
  for (auto field = fields.peek(); field && !is_tag(*field); field = fields.peek()) {
    const auto number = read_number(*fields.next());
    if (!number || count == numbers.size()) return std::nullopt;
    numbers[count++] = *number;
  }
  return count;
}

}  // namespace

DecodedLine Ahrs8Decoder::decode(std::string_view line) const {
  if (!line.starts_with("P:")) return {};
  Fields fields(line.substr(2));
  if (fields.peek() == std::string_view()) (void)fields.next();  // the comma behind "P:"
  DecodedLine decoded{LineKind::reading, {}, {}};
  AhrsReading& reading = decoded.reading;
  std::array<double, 4> numbers{};
  const auto times = read_group(fields, numbers);
  if (!times || *times > 1 || (*times == 1 && !(numbers[0] >= 0.0 && numbers[0] < 1e12))) {
    return damaged("no time where one belongs");
  }
  if (*times == 1) reading.device_time = from_seconds(1e-3 * numbers[0]);
  std::optional<Eigen::Quaterniond> R_ned_frd;
  for (std::size_t group = 0; fields.peek(); ++group) {
    const std::string_view tag = *fields.next();
    const auto count = read_group(fields, numbers);
    if (!count || *count == 0 || group == kMostGroups) return damaged("a number is unreadable");
    if (tag == "q") {
      if (*count != 4) return damaged("a quaternion without four numbers");
      R_ned_frd = Eigen::Quaterniond(numbers[0], numbers[1], numbers[2], numbers[3]);
    } else if (tag == "gp") {
      if (*count != 3) return damaged("rates without three numbers");
      reading.rate_rad_s = kDegree * from_frd({numbers[0], numbers[1], numbers[2]});
    }
  }
  if (!R_ned_frd) return damaged("no quaternion");
  // Two decimals, as some firmware prints them, leave the length off by up to a hundredth.
  if (!(std::abs(R_ned_frd->norm() - 1.0) <= 0.02)) return damaged("a quaternion of wrong length");
  reading.R_world_body = from_ned(R_ned_frd->normalized());
  const std::size_t first_tag = line.find_first_of("abcdefghijklmnopqrstuvwxyz");
  reading.content = hash_text(line.substr(first_tag));
  return decoded;
}

std::string Ahrs8Decoder::start_commands() const {
  // Silence first: a sensor that streams already would not hear the rest in one piece.
  return "\r\nprinttrigger 0 set drop\r\n"
         "printmask gyrop_trigger accelp_trigger or quat_trigger or time_trigger or set drop\r\n"
         "printmodulus 1 set drop\r\n"
         "printtrigger printmask set drop\r\n";
}

std::unique_ptr<AhrsDecoder> make_decoder(std::string_view kind) {
  if (kind == "vectornav") return std::make_unique<VectorNavDecoder>();
  if (kind == "ahrs8") return std::make_unique<Ahrs8Decoder>();
  return nullptr;
}

}  // namespace lifeline::ahrs
