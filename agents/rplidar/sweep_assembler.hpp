#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "agents/rplidar/sample_decoder.hpp"
#include "agents/sensing/raw_scan.hpp"

namespace lifeline::rplidar {

/// How the lidar sits on the head, and what it can measure.
struct SweepSettings {
  double us_per_sample = 0.0;
  double range_min_m = 0.15;  ///< A3 data sheet: nothing nearer is measured
  double range_max_m = 25.0;
  double yaw_rad = 0.0;   ///< from the nose to the device's zero, counter-clockwise
  bool inverted = false;  ///< mounted upside down: turns the other way round
};

/// Gathers samples into sweeps of one turn each, from the device's zero on, and lays each onto a
/// regular grid of angles: docs/decisions/0401.
///
/// A sweep has as many beams as the rotor's speed gives samples to a turn; each sample goes to the
/// beam whose sector holds it, so that its angle is off by half a step at most. Where two fall into
/// one sector, the one nearer to its middle counts; an empty sector is a beam without reading.
class SweepAssembler {
 public:
  explicit SweepAssembler(const SweepSettings& settings) : settings_(settings) {}

  /// Takes the next sample. Gives a sweep when a turn is complete; its stamp is the time of beam 0
  /// as nanoseconds of the clock of the samples. A turn of which half is missing gives none.
  [[nodiscard]] std::optional<sensing::RawScan> add(const Sample& sample);

  /// Turns completed, with and without a sweep.
  [[nodiscard]] std::uint64_t turns() const { return turns_; }
  /// Samples that gave way to another one in their sector.
  [[nodiscard]] std::uint64_t crowded_out() const { return crowded_out_; }

  /// More samples than this in a turn means that the rotor stands: the turn is begun anew.
  static constexpr std::size_t kMostSamples = 16384;

 private:
  /// A sample and its angle, counted from the beginning of this turn.
  struct Placed {
    std::int64_t angle_q16;
    Sample sample;
  };

  [[nodiscard]] std::int64_t unwrap(const Sample& sample) const;
  [[nodiscard]] std::optional<sensing::RawScan> close_turn();
  [[nodiscard]] std::optional<sensing::RawScan> make_scan(std::span<const Placed> turn);
  [[nodiscard]] std::vector<float> lay_out(std::int64_t beams, double shift);
  [[nodiscard]] static double best_shift(std::span<const Placed> turn, std::int64_t beams);
  [[nodiscard]] static SteadyTime start_of(std::span<const Placed> turn, double turn_s);

  SweepSettings settings_;
  std::vector<Placed> samples_;  ///< of this turn, and the first of the next
  std::int64_t last_q16_ = 0;
  SteadyTime last_taken_{};
  std::uint64_t turns_ = 0;
  std::uint64_t crowded_out_ = 0;
};

}  // namespace lifeline::rplidar
