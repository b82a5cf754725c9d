// A long mission of faults, as fast as the machine goes: two minutes of it here, an hour with
// LIFELINE_FAULT_MINUTES=60 (docs/testing.md).

#include <atomic>
#include <cstdlib>
#include <functional>
#include <random>

#include <gtest/gtest.h>

#include "agents/rplidar/rplidar_source.hpp"
#include "tests/integration/rplidar/logged.hpp"
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

/// Gives the lidar another fault every 20 s of its own time.
class Saboteur {
 public:
  explicit Saboteur(RplidarEmulator& lidar) : lidar_(lidar) {}

  void run(const std::stop_token& stop) {
    double due_s = 20.0;
    while (!stop.stop_requested()) {
      std::this_thread::sleep_for(milliseconds(2));
      if (lidar_.emulated_s() < due_s) continue;
      harm();
      ++faults_;
      due_s = lidar_.emulated_s() + 20.0;
    }
    lidar_.set_noise({});
    lidar_.plug_in();
  }

  [[nodiscard]] int faults() const { return faults_; }

 private:
  void harm() {
    const auto pause = [this](int least_ms) {
      std::this_thread::sleep_for(milliseconds(least_ms + static_cast<int>(random_() % 200)));
    };
    switch (random_() % 8) {
      case 0:
        lidar_.set_silent(true);
        pause(450);
        lidar_.set_silent(false);
        break;
      case 1:
        lidar_.set_stalled(true);
        pause(550);
        lidar_.set_stalled(false);
        break;
      case 2:
        lidar_.set_health(2, 0x8002);
        lidar_.set_silent(true);
        pause(500);
        lidar_.heal_at_reset();
        lidar_.set_silent(false);
        break;
      case 3:
      case 4:
        lidar_.unplug();
        pause(0);
        lidar_.plug_in();
        break;
      default:
        const double most = random_() % 4 == 0 ? 2e-3 : 5e-4;
        const auto rate = [&] { return most * static_cast<double>(random_() % 1000) / 1000.0; };
        lidar_.set_noise({.lost = rate(), .flipped = rate(), .inserted = rate()});
    }
  }

  RplidarEmulator& lidar_;
  std::mt19937 random_{42};
  std::atomic<int> faults_{0};
};

TEST(RplidarSource, comes_through_a_mission_of_faults) {
  const double mission_s = 60.0 * minutes_asked_for();
  const support::TemporaryFolder folder;
  const test::Logged log;
  test::EmulatorOptions options;
  options.real_time = false;
  RplidarEmulator lidar(options, (folder.path() / "lidar").string());
  const auto source = open_rplidar_source({"rplidar", lidar.device(), {{"mode", "denseboost"}}});
  ASSERT_TRUE(source) << source.error().text;

  Saboteur saboteur(lidar);
  std::jthread sabotage([&](const std::stop_token& stop) { saboteur.run(stop); });
  std::uint64_t sweeps = 0, readings = 0, wrong = 0;
  while (lidar.emulated_s() < mission_s) {
    const auto scan = (*source)->next();
    ASSERT_TRUE(scan && *scan);
    ++sweeps;
    for (const float range_m : (*scan)->ranges_m) {
      readings += range_m != 0.0F ? 1 : 0;
      wrong += range_m != 0.0F && (range_m < 1.99F || range_m > 3.7F) ? 1 : 0;
    }
  }
  sabotage.request_stop();
  sabotage.join();
  for (int i = 0; i < 3; ++i) ASSERT_TRUE((*source)->next().value());

  EXPECT_GE(saboteur.faults(), static_cast<int>(mission_s / 20.0 / 2.0));
  EXPECT_GT(static_cast<double>(sweeps), 0.5 * 10.0 * mission_s);
  EXPECT_LT(wrong * 10'000, readings);  // checksums collide now and then on a line this bad
  RecordProperty("sweeps", std::to_string(sweeps));
  RecordProperty("faults", saboteur.faults());
  RecordProperty("wrong", std::to_string(wrong) + "/" + std::to_string(readings));
}

}  // namespace
}  // namespace lifeline::rplidar
