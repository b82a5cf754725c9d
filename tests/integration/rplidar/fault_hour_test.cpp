// A long mission of faults, as fast as the machine goes: two minutes of it here, an hour with
// LIFELINE_FAULT_MINUTES=60 (docs/testing.md).

#include <cstdlib>
#include <functional>
#include <future>
#include <random>
#include <thread>

#include <gtest/gtest.h>

#include "agents/rplidar/rplidar_source.hpp"
#include "tests/support/logged.hpp"
#include "tests/support/rplidar/emulator.hpp"
#include "tests/support/temporary_folder.hpp"

namespace lifeline::rplidar {
namespace {

using std::chrono::milliseconds;
using test::RplidarEmulator;

double minutes_asked_for() {
  const char* const text = std::getenv("LIFELINE_FAULT_MINUTES");
  return text == nullptr ? 2.0 : std::atof(text);
}

/// Begins faults, and takes back in the background those that do not end by themselves.
class Saboteur {
 public:
  explicit Saboteur(RplidarEmulator& lidar) : lidar_(lidar) {}

  void harm() {
    if (mending_.valid()) mending_.get();
    switch (random_() % 8) {
      case 0:
        lidar_.set_silent(true);
        mend_after(450, [this] { lidar_.set_silent(false); });
        break;
      case 1:
        lidar_.set_stalled(true);
        mend_after(550, [this] { lidar_.set_stalled(false); });
        break;
      case 2:
        lidar_.set_health(2, 0x8002);
        lidar_.set_silent(true);
        mend_after(500, [this] {
          lidar_.heal_at_reset();
          lidar_.set_silent(false);
        });
        break;
      case 3:
      case 4:
        lidar_.unplug();
        mend_after(0, [this] { lidar_.plug_in(); });
        break;
      default:
        const double most = random_() % 4 == 0 ? 2e-3 : 5e-4;
        const auto rate = [&] { return most * static_cast<double>(random_() % 1000) / 1000.0; };
        lidar_.set_noise({.lost = rate(), .flipped = rate(), .inserted = rate()});
    }
  }

  void make_peace() {
    if (mending_.valid()) mending_.get();
    lidar_.set_noise({});
  }

 private:
  void mend_after(int least_ms, std::function<void()> mend) {
    const milliseconds pause(least_ms + static_cast<int>(random_() % 200));
    mending_ = std::async(std::launch::async, [pause, mend = std::move(mend)] {
      std::this_thread::sleep_for(pause);
      mend();
    });
  }

  RplidarEmulator& lidar_;
  std::mt19937 random_{42};
  std::future<void> mending_;
};

// Counted in sweeps that arrive, not in the lidar's seconds: it measures as fast as it is read, and
// what is lost while the source waits by the wall clock depends on the machine.
TEST(RplidarSource, comes_through_a_mission_of_faults) {
  constexpr std::uint64_t kSweepsPerMinute = 600, kSweepsBetweenFaults = 200;
  const auto mission = static_cast<std::uint64_t>(kSweepsPerMinute * minutes_asked_for());
  const support::TemporaryFolder folder;
  const test::Logged log;
  test::EmulatorOptions options;
  options.real_time = false;
  RplidarEmulator lidar(options, (folder.path() / "lidar").string());
  const auto source = open_rplidar_source({"rplidar", lidar.device(), {{"mode", "denseboost"}}});
  ASSERT_TRUE(source) << source.error().text;

  Saboteur saboteur(lidar);
  std::uint64_t readings = 0, wrong = 0;
  for (std::uint64_t sweep = 1; sweep <= mission; ++sweep) {
    const auto scan = (*source)->next();
    ASSERT_TRUE(scan && *scan);
    for (const float range_m : (*scan)->ranges_m) {
      readings += range_m != 0.0F ? 1 : 0;
      wrong += range_m != 0.0F && (range_m < 1.99F || range_m > 3.7F) ? 1 : 0;
    }
    if (sweep % kSweepsBetweenFaults == 0) saboteur.harm();
  }
  saboteur.make_peace();
  for (int i = 0; i < 3; ++i) ASSERT_TRUE((*source)->next().value());

  EXPECT_GT(readings, mission * 800) << log.text();  // of 1,600 in a sweep on a good line
  EXPECT_LT(wrong * 10'000, readings);  // checksums collide now and then on a line this bad
  RecordProperty("wrong", std::to_string(wrong) + "/" + std::to_string(readings));
}

}  // namespace
}  // namespace lifeline::rplidar
