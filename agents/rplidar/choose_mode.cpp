#include <algorithm>
#include <cctype>

#include <fmt/ranges.h>

#include "agents/rplidar/device.hpp"
#include "agents/rplidar/frames.hpp"

namespace lifeline::rplidar {
namespace {

bool same_name(const std::string& a, const std::string& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](unsigned char x, unsigned char y) {
    return std::tolower(x) == std::tolower(y);
  });
}

bool can_decode(const ScanMode& mode) {
  return frame_format(static_cast<AnswerType>(mode.answer_type)).has_value();
}

std::string describe(const ScanMode& mode) {
  return fmt::format("{} ({:.1f}k samples/s{})", mode.name, 1e-3 * mode.samples_per_s(),
                     can_decode(mode) ? "" : ", not decoded");
}

std::string list(const std::vector<ScanMode>& modes) {
  std::vector<std::string> texts;
  for (const ScanMode& mode : modes) texts.push_back(describe(mode));
  return fmt::format("{}", fmt::join(texts, ", "));
}

}  // namespace

Result<ScanMode> choose_mode(const ScanModes& modes, const std::string& name,
                             const std::string& device) {
  const ScanMode* best = nullptr;
  for (const ScanMode& mode : modes.all) {
    if (name.empty() && mode.id == modes.typical && can_decode(mode)) return mode;
    const bool wanted = name.empty() ? can_decode(mode) : same_name(mode.name, name);
    if (wanted && (best == nullptr || mode.us_per_sample < best->us_per_sample)) best = &mode;
  }
  if (best == nullptr) {
    return fail(ErrorCode::wrong_use, "{}: has no scan mode '{}'; there are: {}", device,
                name.empty() ? "that can be decoded" : name, list(modes.all));
  }
  if (!can_decode(*best)) {
    return fail(ErrorCode::wrong_use,
                "{}: mode {} answers in frames of type {:#04x}, which this build does not decode "
                "(ultra capsules, 0x84: build with -DLIFELINE_RPLIDAR_ULTRA=ON); there are: {}",
                device, best->name, best->answer_type, list(modes.all));
  }
  return *best;
}

}  // namespace lifeline::rplidar
