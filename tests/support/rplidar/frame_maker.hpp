#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace lifeline::test {

/// A scan mode of an emulated RPLIDAR.
struct EmulatedMode {
  std::string name;
  std::uint32_t us_per_sample_q8 = 0;
  std::uint32_t max_distance_q8 = 25 << 8;  ///< metres
  std::uint8_t answer_type = 0;

  [[nodiscard]] double us_per_sample() const { return us_per_sample_q8 / 256.0; }
};

/// What the lidar sees at an angle (degrees, clockwise from its zero) and a time: whole mm, 0 where
/// it measures nothing.
using World = std::function<std::uint16_t(double angle_deg, double t_s)>;

/// A rectangular room around the lidar, `width_m` ahead and behind, `depth_m` to both sides.
[[nodiscard]] World room(double width_m, double depth_m);

/// A frame as it goes over the line, and what is in it.
struct EmulatedFrame {
  std::vector<std::uint8_t> bytes;
  std::uint16_t start_q6 = 0;           ///< angle of the first sample, 1/64 deg
  std::vector<std::uint32_t> quarters;  ///< distances, 1/4 mm
  std::vector<std::uint8_t> behind_q3;  ///< express: how far each angle lies behind, 1/8 deg
  double last_sample_s = 0.0;           ///< middle of the last sample, since the maker began
};

/// Makes the frames of a scan, one after the other, without a line: the device's half of the
/// protocol, written apart from the decoders. Formats 0x81, 0x82, 0x84 and 0x85.
class FrameMaker {
 public:
  FrameMaker(const EmulatedMode& mode, double rotor_Hz, World world, double start_deg = 0.0);

  /// The next frame. The rotor stands if told so: the angles stop growing.
  [[nodiscard]] EmulatedFrame next(bool rotor_turns = true);

  [[nodiscard]] std::size_t samples_per_frame() const;
  [[nodiscard]] double angle_deg() const { return angle_deg_; }

 private:
  void fill_node(EmulatedFrame& frame);
  void fill_express(EmulatedFrame& frame);
  void fill_dense(EmulatedFrame& frame);
  void fill_ultra(EmulatedFrame& frame);
  [[nodiscard]] std::uint32_t next_mm();

  EmulatedMode mode_;
  double step_deg_;
  World world_;
  double angle_deg_;
  double t_s_ = 0.0;
  bool turns_ = true;
  bool first_ = true;
  std::vector<std::uint32_t> ahead_mm_;  ///< ultra: the next frame's samples, already measured
};

}  // namespace lifeline::test
