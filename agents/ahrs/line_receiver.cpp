#include "agents/ahrs/line_receiver.hpp"

namespace lifeline::ahrs {

void LineReceiver::start(SteadyTime now) {
  lines_.clear();
  clock_ = {};
  watch_.start(now);
}

void LineReceiver::push(std::span<const std::uint8_t> bytes, SteadyTime arrived,
                        std::vector<Reading>& readings) {
  if (!bytes.empty()) watch_.note_bytes(arrived);
  lines_.push(bytes, [&](std::string_view line, std::size_t behind) {
    // Several lines at once: those that came first came as much earlier as the others needed.
    take(line, arrived - from_seconds(byte_s_ * static_cast<double>(behind)), readings);
  });
}

void LineReceiver::take(std::string_view line, SteadyTime ended, std::vector<Reading>& readings) {
  const DecodedLine decoded = decoder_->decode(line);
  if (decoded.kind == LineKind::other) return;
  if (decoded.kind == LineKind::damaged) {
    watch_.note_damaged();
    last_damage_ = decoded.why;
    return;
  }
  const double length_s = byte_s_ * static_cast<double>(line.size() + 2);  // and its end
  const SteadyTime stamp =
      clock_.to_steady(decoded.reading.device_time, ended - from_seconds(length_s));
  if (watch_.take(decoded.reading, stamp, ended)) readings.push_back({decoded.reading, stamp});
}

}  // namespace lifeline::ahrs
