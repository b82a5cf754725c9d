#include "common/sharing/helmet_mark.hpp"

#include <cctype>
#include <numeric>

namespace lifeline::sharing {
namespace {

constexpr std::size_t kMostDigits = 2;

char upper(char c) {
  return static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
}

std::string label_of(const std::string& id) {
  const std::size_t last = id.find_last_not_of("0123456789");
  std::string number = last == std::string::npos ? id : id.substr(last + 1);
  while (number.size() > 1 && number.front() == '0') number.erase(0, 1);
  if (number.size() > kMostDigits) number.erase(0, number.size() - kMostDigits);
  if (last == std::string::npos) return number;  // nothing but a number
  std::string label(1, upper(id[0]));
  if (!number.empty()) return label + number;
  if (id.size() > 1) label += upper(id[1]);
  return label;
}

}  // namespace

HelmetMark mark_of(const std::string& id) {
  const auto sum = std::accumulate(
      id.begin(), id.end(), std::uint64_t{0},
      [](std::uint64_t before, char c) { return 31 * before + static_cast<unsigned char>(c); });
  return {label_of(id), static_cast<std::uint32_t>(sum % kMarkShapes)};
}

}  // namespace lifeline::sharing
