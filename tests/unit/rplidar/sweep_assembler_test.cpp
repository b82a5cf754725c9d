#include "agents/rplidar/sweep_assembler.hpp"

#include <cmath>

#include <gmock/gmock.h>

#include "agents/sensing/head_projection.hpp"
#include "common/base/angles.hpp"
#include "tests/support/rplidar/frame_maker.hpp"

namespace lifeline::rplidar {
namespace {

using sensing::RawScan;
using test::EmulatedMode;
using test::FrameMaker;

const SteadyTime kFirstTurn(std::chrono::seconds(1000));

struct Case {
  std::uint8_t type;
  double us_per_sample;
  double rotor_Hz;
};

/// The sweeps of a scan, sent and decoded without a line.
std::vector<RawScan> sweeps_of(const Case& c, const test::World& world, double seconds,
                               SweepSettings settings = {}) {
  const EmulatedMode mode{"m", static_cast<std::uint32_t>(256.0 * c.us_per_sample), 25 << 8,
                          c.type};
  settings.us_per_sample = mode.us_per_sample();
  FrameMaker maker(mode, c.rotor_Hz, world);
  SampleDecoder decoder(static_cast<AnswerType>(c.type), mode.us_per_sample(), 100'000'000);
  SweepAssembler assembler(settings);
  std::vector<RawScan> sweeps;
  std::vector<Sample> samples;
  for (double t_s = 0.0; t_s < seconds;) {
    const auto frame = maker.next();
    t_s = frame.last_sample_s;
    samples.clear();
    decoder.push(frame.bytes, kFirstTurn + from_seconds(t_s + 1.5e-6 * mode.us_per_sample()),
                 samples);
    for (const Sample& sample : samples) {
      if (auto sweep = assembler.add(sample)) sweeps.push_back(*std::move(sweep));
    }
  }
  return sweeps;
}

constexpr Case kDense{0x85, 62.5, 10.0}, kExpress{0x82, 126.0, 10.0}, kStandard{0x81, 252.0, 10.0};

/// The i-th of an even scan with 1600 to a turn, 2 m everywhere.
Reading reading_of(int i) {
  const std::int64_t turn_q16 = kTurn_q16;
  return {static_cast<std::int32_t>((turn_q16 * (i % 1600) + turn_q16 / 2) / 1600),
          kTurn_q16 / 1600, 8000};
}

TEST(SweepAssembler, a_turn_has_a_beam_for_each_of_its_samples) {
  for (const auto& [c, beams] : {std::pair(kDense, 1600), {kExpress, 794}, {kStandard, 397}}) {
    const auto sweeps = sweeps_of(c, test::room(3, 2), 1.05);
    ASSERT_GE(sweeps.size(), 9U);
    for (std::size_t i = 1; i < sweeps.size(); ++i) {
      EXPECT_NEAR(static_cast<double>(sweeps[i].ranges_m.size()), beams, 3) << i;
    }
  }
}

TEST(SweepAssembler, every_reading_lies_within_half_a_step_of_its_beam) {
  // The range tells what angle it was taken at.
  for (const Case& c : {kDense, kExpress, kStandard}) {
    const auto sweeps = sweeps_of(
        c,
        [](double angle_deg, double) {
          return static_cast<std::uint16_t>(1000 + std::lround(angle_deg * 40.0));
        },
        0.5);
    ASSERT_GE(sweeps.size(), 3U);
    const RawScan& scan = sweeps[2];
    const double step_deg = -scan.angle_step_rad / kDegree;
    for (std::size_t i = 0; i < scan.ranges_m.size(); ++i) {
      if (scan.ranges_m[i] == 0.0F) continue;
      double taken_deg = (1000.0 * scan.ranges_m[i] - 1000.0) / 40.0;
      if (c.type == 0x82) taken_deg -= 7.2;  // about what a cabin's angles lie behind here
      const double beam_deg = static_cast<double>(i) * step_deg - scan.first_angle_rad / kDegree;
      const double slack_deg = c.type == 0x82 ? 1.4 : 0.03;
      ASSERT_LT(std::abs(std::remainder(taken_deg - beam_deg, 360.0)), step_deg / 2 + slack_deg)
          << i;
    }
  }
}

TEST(SweepAssembler, hardly_any_sample_of_an_even_scan_is_lost) {
  const auto sweeps = sweeps_of(kDense, test::room(3, 2), 2.05);
  std::size_t empty = 0, all = 0;
  for (const RawScan& scan : sweeps) {
    for (const float range_m : scan.ranges_m) empty += range_m == 0.0F ? 1 : 0;
    all += scan.ranges_m.size();
  }
  EXPECT_LT(empty * 100, all);
}

TEST(SweepAssembler, draws_the_room_that_the_lidar_stands_in) {
  // Clockwise from the device's zero, and that 90 degrees to the left of the nose.
  SweepSettings settings;
  settings.yaw_rad = 90.0 * kDegree;
  const auto sweeps = sweeps_of(kDense, test::room(3, 2), 0.35, settings);
  ASSERT_FALSE(sweeps.empty());
  const Scan2 scan = sensing::project_scan(sweeps.back(), {});
  EXPECT_TRUE(scan.full_circle);
  EXPECT_GT(scan.hits(), 1500U);
  for (const Beam2& beam : scan.beams) {
    if (beam.kind != BeamKind::hit) continue;
    const double wall = std::max(std::abs(beam.x_m) / 2.0, std::abs(beam.y_m) / 3.0);
    ASSERT_NEAR(wall, 1.0, 0.006);
  }
}

TEST(SweepAssembler, an_inverted_lidar_turns_the_other_way) {
  const auto mark = [](double angle_deg, double) {
    return static_cast<std::uint16_t>(std::abs(angle_deg - 30.0) < 1.0 ? 1000 : 5000);
  };
  for (const bool inverted : {false, true}) {
    SweepSettings settings;
    settings.inverted = inverted;
    const auto sweeps = sweeps_of(kDense, mark, 0.35, settings);
    const Scan2 scan = sensing::project_scan(sweeps.back(), {});
    for (const Beam2& beam : scan.beams) {
      if (beam.kind != BeamKind::hit || beam.range_m > 2.0F) continue;
      ASSERT_NEAR(beam.angle_rad / kDegree, inverted ? 30.0 : -30.0, 1.3);
    }
  }
}

TEST(SweepAssembler, stamps_are_of_the_first_beam_and_sweeps_last_a_turn) {
  for (const Case& c : {kDense, kExpress}) {
    const auto sweeps = sweeps_of(c, test::room(3, 2), 1.05);
    ASSERT_GE(sweeps.size(), 9U);
    // Express: what is 8 deg behind is measured 2.2 ms after the rotor's zero.
    const double behind_s = c.type == 0x82 ? 7.3 / 3600.0 : 0.0;
    for (std::size_t i = 1; i < 9; ++i) {
      const double start_s =
          1e-9 * static_cast<double>(
                     (sweeps[i].stamp.time_since_epoch() - kFirstTurn.time_since_epoch()).count());
      EXPECT_NEAR(start_s, 0.1 * static_cast<double>(i) + behind_s, 2.5e-4) << i;
      EXPECT_NEAR(to_seconds(sweeps[i].sweep_time), 0.1, 3e-4);
    }
  }
}

TEST(SweepAssembler, a_sweep_with_a_hole_has_beams_without_reading_there) {
  SweepSettings settings;
  settings.us_per_sample = 62.5;
  SweepAssembler assembler(settings);
  std::optional<RawScan> scan;
  for (int i = 0; i < 3300 && !scan; ++i) {
    if (i >= 400 && i < 600) continue;
    Sample sample;
    sample.reading = reading_of(i);
    sample.taken = kFirstTurn + std::chrono::nanoseconds(62'500) * i;
    sample.after_gap = i == 600;
    scan = assembler.add(sample);
  }
  ASSERT_TRUE(scan);
  ASSERT_EQ(scan->ranges_m.size(), 1600U);
  for (std::size_t i = 0; i < 1600; ++i) {
    EXPECT_EQ(scan->ranges_m[i], i >= 400 && i < 600 ? 0.0F : 2.0F) << i;
  }
}

TEST(SweepAssembler, a_turn_with_too_long_a_gap_is_given_up) {
  SweepSettings settings;
  settings.us_per_sample = 62.5;
  SweepAssembler assembler(settings);
  std::vector<RawScan> sweeps;
  for (int i = 0; i < 5000; ++i) {
    if (i >= 400 && i < 1900) continue;  // nearly a turn: what follows looks like going back
    Sample sample;
    sample.reading = reading_of(i);
    sample.taken = kFirstTurn + std::chrono::nanoseconds(62'500) * i;
    sample.after_gap = i == 1900;
    if (auto scan = assembler.add(sample)) sweeps.push_back(*scan);
  }
  ASSERT_EQ(sweeps.size(), 2U);  // what is left of the second turn, and the third
  EXPECT_EQ(std::count(sweeps[0].ranges_m.begin(), sweeps[0].ranges_m.end(), 2.0F), 1300);
}

TEST(SweepAssembler, a_rotor_that_stands_gives_no_sweep_and_takes_no_memory) {
  SweepSettings settings;
  settings.us_per_sample = 62.5;
  SweepAssembler assembler(settings);
  for (int i = 0; i < 200'000; ++i) {
    ASSERT_FALSE(
        assembler.add({{1 << 16, 0, 8000}, kFirstTurn + std::chrono::microseconds(i), false}));
  }
  EXPECT_EQ(assembler.turns(), 0U);
}

}  // namespace
}  // namespace lifeline::rplidar
