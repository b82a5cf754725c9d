#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "agents/ahrs/ahrs_decoder.hpp"
#include "agents/ahrs/attitude_watch.hpp"
#include "agents/ahrs/device_clock.hpp"
#include "agents/ahrs/line_splitter.hpp"

namespace lifeline::ahrs {

/// From a serial line's bytes and the times at which they came to readings that may be used. Knows
/// no port: bytes alone drive it.
class LineReceiver {
 public:
  struct Reading {
    AhrsReading reading;
    SteadyTime stamp;  ///< when it was measured
  };

  LineReceiver(std::unique_ptr<AhrsDecoder> decoder, int baud)
      : decoder_(std::move(decoder)), byte_s_(10.0 / baud) {}

  /// The port was opened; what was begun before is forgotten.
  void start(SteadyTime now);
  /// Bytes that were there at `arrived`. Adds what can be used to `readings`.
  void push(std::span<const std::uint8_t> bytes, SteadyTime arrived,
            std::vector<Reading>& readings);

  [[nodiscard]] const AhrsDecoder& decoder() const { return *decoder_; }
  [[nodiscard]] const AttitudeWatch& watch() const { return watch_; }
  /// What was wrong with the line damaged last.
  [[nodiscard]] const std::string& last_damage() const { return last_damage_; }

 private:
  void take(std::string_view line, SteadyTime ended, std::vector<Reading>& readings);

  std::unique_ptr<AhrsDecoder> decoder_;
  double byte_s_;  ///< that a byte is on the line: start, eight bits, stop
  LineSplitter lines_;
  DeviceClock clock_;
  AttitudeWatch watch_;
  std::string last_damage_;
};

}  // namespace lifeline::ahrs
