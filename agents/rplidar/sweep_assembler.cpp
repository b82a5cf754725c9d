#include "agents/rplidar/sweep_assembler.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numbers>
#include <numeric>

namespace lifeline::rplidar {
namespace {

/// A near reading may come this far behind a far one: only then is a turn complete.
constexpr std::int64_t kLatest_q16 = 10LL << 16;
/// In a longer gap a fast rotor turns by half: whether it was a whole turn more, nobody knows.
constexpr Duration kLongestGap = std::chrono::milliseconds(25);
constexpr double kFewestBeams = 90.0, kMostBeams = 8192.0;
/// Of a turn's samples: with less it is no sweep.
constexpr double kEnoughSamples = 0.5;

/// A sector of the turn and what was measured in it.
struct Sector {
  float range_m = 0.0F;
  double off = 1.0;  ///< from its middle, in sectors
};

double seconds_between(SteadyTime from, SteadyTime to) {
  return to_seconds(to - from);
}

}  // namespace

std::optional<sensing::RawScan> SweepAssembler::add(const Sample& sample) {
  const bool lost = sample.after_gap && sample.taken - last_taken_ > kLongestGap;
  if (lost || samples_.empty() || samples_.size() >= kMostSamples) {
    samples_.clear();
    last_q16_ = sample.reading.angle_q16;
  } else {
    last_q16_ = unwrap(sample);
  }
  last_taken_ = sample.taken;
  samples_.push_back({last_q16_, sample});
  if (last_q16_ < kTurn_q16 + kLatest_q16) return std::nullopt;
  return close_turn();
}

/// The sample's angle, at most half a turn from the one before.
std::int64_t SweepAssembler::unwrap(const Sample& sample) const {
  std::int64_t step_q16 = (sample.reading.angle_q16 - last_q16_) % kTurn_q16;
  if (step_q16 > kTurn_q16 / 2) step_q16 -= kTurn_q16;
  if (step_q16 < -kTurn_q16 / 2) step_q16 += kTurn_q16;
  return last_q16_ + step_q16;
}

/// Makes a sweep of the turn's samples, and keeps those of the next turn.
std::optional<sensing::RawScan> SweepAssembler::close_turn() {
  ++turns_;
  const auto later = std::stable_partition(samples_.begin(), samples_.end(),
                                           [](const Placed& p) { return p.angle_q16 < kTurn_q16; });
  // What came behind the turn before is too late for it.
  const auto begin = std::stable_partition(samples_.begin(), later,
                                           [](const Placed& p) { return p.angle_q16 < 0; });
  auto scan = make_scan(std::span<const Placed>(begin, later));
  samples_.erase(samples_.begin(), later);
  for (Placed& placed : samples_) placed.angle_q16 -= kTurn_q16;
  last_q16_ -= kTurn_q16;
  return scan;
}

std::optional<sensing::RawScan> SweepAssembler::make_scan(std::span<const Placed> turn) {
  const auto count = static_cast<double>(turn.size());
  const double turned_q16 = std::accumulate(
      turn.begin(), turn.end(), 0.0,
      [](double sum, const Placed& placed) { return sum + placed.sample.reading.step_q16; });
  if (turned_q16 <= 0.0) return std::nullopt;
  const double samples_a_turn = kTurn_q16 * count / turned_q16;
  if (samples_a_turn < kFewestBeams || samples_a_turn > kMostBeams ||
      count < kEnoughSamples * samples_a_turn) {
    return std::nullopt;
  }
  const auto beams = std::lround(samples_a_turn);
  const double shift = best_shift(turn, beams);
  const double turn_s = 1e-6 * settings_.us_per_sample * samples_a_turn;
  const double beam_s = turn_s / static_cast<double>(beams);
  sensing::RawScan scan;
  const double step_rad = 2.0 * std::numbers::pi / static_cast<double>(beams);
  scan.angle_step_rad = settings_.inverted ? step_rad : -step_rad;
  scan.first_angle_rad = settings_.yaw_rad + (0.5 + shift) * scan.angle_step_rad;
  scan.range_min_m = settings_.range_min_m;
  scan.range_max_m = settings_.range_max_m;
  scan.ranges_m = lay_out(beams, shift);
  scan.sweep_time = from_seconds(turn_s - beam_s);
  const SteadyTime start = start_of(turn, turn_s) + from_seconds((0.5 + shift) * beam_s);
  scan.stamp = Timestamp(start.time_since_epoch());
  return scan;
}

/// Where the sectors have to begin, in sectors from the device's zero (-0.5 to 0.5), so that the
/// samples lie around their middles: then small unevenness puts no two into one.
double SweepAssembler::best_shift(std::span<const Placed> turn, std::int64_t beams) {
  double east = 0.0, north = 0.0;
  for (const Placed& placed : turn) {
    const double phase = 2.0 * std::numbers::pi *
                         static_cast<double>(placed.angle_q16 * beams % kTurn_q16) / kTurn_q16;
    east += std::cos(phase);
    north += std::sin(phase);
  }
  // The mean place within a sector, less its middle.
  return std::atan2(-north, -east) / (2.0 * std::numbers::pi);
}

/// Each sample into the sector that holds its angle; the shift may bring in some of the next turn.
std::vector<float> SweepAssembler::lay_out(std::int64_t beams, double shift) {
  std::vector<Sector> sectors(static_cast<std::size_t>(beams));
  for (const Placed& placed : samples_) {
    const std::uint32_t quarters = placed.sample.reading.distance_quarters;
    const double place = static_cast<double>(placed.angle_q16 * beams) / kTurn_q16 - shift;
    const double index = std::floor(place);
    if (quarters == 0 || index < 0.0 || index >= static_cast<double>(beams)) continue;
    Sector& sector = sectors[static_cast<std::size_t>(index)];
    const double off = std::abs(place - index - 0.5);
    crowded_out_ += sector.range_m > 0.0F ? 1 : 0;
    if (off < sector.off) sector = {static_cast<float>(quarters) / 4000.0F, off};
  }
  std::vector<float> ranges_m;
  ranges_m.reserve(sectors.size());
  for (const Sector& sector : sectors) ranges_m.push_back(sector.range_m);
  return ranges_m;
}

/// When the rotor passed the device's zero, for an even turn: the mean over all samples.
SteadyTime SweepAssembler::start_of(std::span<const Placed> turn, double turn_s) {
  const SteadyTime base = turn.front().sample.taken;
  double sum_s = 0.0;
  for (const Placed& placed : turn) {
    sum_s += seconds_between(base, placed.sample.taken) -
             turn_s * static_cast<double>(placed.angle_q16) / kTurn_q16;
  }
  return base + from_seconds(sum_s / static_cast<double>(turn.size()));
}

}  // namespace lifeline::rplidar
