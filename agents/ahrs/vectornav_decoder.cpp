#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <span>

#include "agents/ahrs/ahrs_decoder.hpp"
#include "agents/ahrs/fields.hpp"
#include "agents/sensing/rotation.hpp"
#include "common/base/angles.hpp"

namespace lifeline::ahrs {
namespace {

constexpr std::size_t kMostNumbers = 13;

/// What the numbers of a sentence are; -1: it has none of that.
struct Sentence {
  std::string_view name;
  std::size_t numbers;
  bool is_quaternion;  ///< x, y, z, w; else yaw, pitch, roll in degrees. They come first.
  int first_rate;      ///< index of the rate about x, in rad/s
};

constexpr std::array<Sentence, 6> kSentences{{{"VNYPR", 3, false, -1},
                                              {"VNYMR", 12, false, 9},
                                              {"VNYBA", 9, false, 6},
                                              {"VNYIA", 9, false, 6},
                                              {"VNQTN", 4, true, -1},
                                              {"VNQMR", 13, true, 10}}};

std::uint32_t xor_of(std::string_view text) {
  std::uint32_t sum = 0;
  for (const char c : text) sum ^= static_cast<std::uint8_t>(c);
  return sum;
}

/// CRC-16 with polynomial x^16 + x^12 + x^5 + 1, from 0, most significant bit first.
std::uint32_t crc16_of(std::string_view text) {
  std::uint32_t crc = 0;
  for (const char c : text) {
    crc ^= static_cast<std::uint32_t>(static_cast<std::uint8_t>(c)) << 8;
    for (int bit = 0; bit < 8; ++bit) {
      crc = ((crc & 0x8000U) != 0 ? (crc << 1) ^ 0x1021U : crc << 1) & 0xFFFFU;
    }
  }
  return crc;
}

/// What stands between '$' and '*', if the checksum behind '*' is right.
std::optional<std::string_view> checked_body(std::string_view line) {
  const std::size_t star = line.rfind('*');
  if (!line.starts_with('$') || star == std::string_view::npos) return std::nullopt;
  const std::string_view body = line.substr(1, star - 1), sum = line.substr(star + 1);
  std::uint32_t stated = 0;
  const char* end = sum.data() + sum.size();
  const auto [rest, error] = std::from_chars(sum.data(), end, stated, 16);
  if (error != std::errc{} || rest != end) return std::nullopt;
  const bool is_right =
      (sum.size() == 2 && stated == xor_of(body)) || (sum.size() == 4 && stated == crc16_of(body));
  return is_right ? std::optional(body) : std::nullopt;
}

DecodedLine damaged(std::string_view why) {
  return {LineKind::damaged, {}, why};
}

bool is_suffix(std::string_view field) {
  return field.size() > 1 && (field.front() == 'S' || field.front() == 'T');
}

std::optional<Eigen::Quaterniond> orientation(const Sentence& sentence,
                                              std::span<const double> numbers) {
  if (sentence.is_quaternion) {
    const Eigen::Quaterniond q(numbers[3], numbers[0], numbers[1], numbers[2]);
    if (std::abs(q.norm() - 1.0) > 0.03) return std::nullopt;
    return q.normalized();
  }
  for (const double angle_deg : numbers.first(3)) {
    if (std::abs(angle_deg) > 360.0) return std::nullopt;
  }
  return sensing::rotation_zyx(kDegree * numbers[2], kDegree * numbers[1], kDegree * numbers[0]);
}

}  // namespace

DecodedLine VectorNavDecoder::decode(std::string_view line) const {
  const auto body = checked_body(line);
  if (!body) return damaged("wrong checksum");
  Fields fields(*body);
  const std::string_view name = *fields.next();
  const auto* sentence = std::find_if(kSentences.begin(), kSentences.end(),
                                      [&](const Sentence& s) { return s.name == name; });
  if (sentence == kSentences.end()) return {};
  std::array<double, kMostNumbers> numbers{};
  for (std::size_t i = 0; i < sentence->numbers; ++i) {
    const auto field = fields.next();
    const auto number = field ? read_number(*field) : std::nullopt;
    if (!number) return damaged("a number is missing or unreadable");
    numbers[i] = *number;
  }
  while (const auto more = fields.next()) {
    if (!is_suffix(*more)) return damaged("more numbers than the sentence has");
  }
  const auto R_ned_frd = orientation(*sentence, numbers);
  if (!R_ned_frd) return damaged("angles or quaternion out of range");
  DecodedLine decoded{LineKind::reading, {}, {}};
  decoded.reading.R_world_body = from_ned(*R_ned_frd);
  decoded.reading.content = hash_text(*body);
  if (sentence->first_rate >= 0) {
    const auto first = static_cast<std::size_t>(sentence->first_rate);
    decoded.reading.rate_rad_s = from_frd({numbers[first], numbers[first + 1], numbers[first + 2]});
  }
  return decoded;
}

}  // namespace lifeline::ahrs
