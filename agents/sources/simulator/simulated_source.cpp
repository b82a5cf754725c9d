#include "agents/sources/simulator/simulated_source.hpp"

#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "agents/sources/simulator/doors.hpp"
#include "agents/sources/simulator/draw.hpp"
#include "agents/sources/simulator/free_space.hpp"
#include "agents/sources/simulator/load_plan.hpp"
#include "agents/sources/simulator/ray_scene.hpp"
#include "agents/sources/simulator/sensors.hpp"
#include "agents/sources/simulator/simulator_options.hpp"
#include "agents/sources/simulator/walk.hpp"

namespace lifeline::sources {
namespace {

/// When every simulated walk begins: any time would do, as long as it is always the same.
constexpr Timestamp kStart{std::chrono::seconds(1'600'000'000)};

/// Noise of its own for every walker, sensor by sensor.
std::uint64_t sensor_seed(const WalkerNumber& number, std::uint64_t sensor) {
  return stir(stir(number.seed, static_cast<std::uint64_t>(number.walker)), sensor);
}

/// How often the attitude sensor speaks within a sweep.
constexpr double kAhrsIntervalS = 0.01;

/// What the attitude sensor says a moment after it said `attitude`. A moment's change it tells far
/// better than the attitude: its error stays.
sensing::Attitude moved(const sensing::Attitude& attitude, const HeadPose& from,
                        const HeadPose& to) {
  return {.roll_rad = attitude.roll_rad + to.roll_rad - from.roll_rad,
          .pitch_rad = attitude.pitch_rad + to.pitch_rad - from.pitch_rad,
          .yaw_rad = normalise_angle(attitude.yaw_rad + to.T_world_head.yaw_rad -
                                     from.T_world_head.yaw_rad)};
}

/// The doorways that doors hang in.
std::vector<Doorway> doorways_of(const FloorPlan& plan, const FreeSpace& space, Doors::When when) {
  if (when == Doors::When::never) return {};
  return plan.doorways.empty() ? find_doorways(plan, space) : plan.doorways;
}

class SimulatedSource final : public sensing::ScanSource {
 public:
  SimulatedSource(const FloorPlan& plan, FreeSpace space, const SimulatorOptions& options)
      : options_(options),
        scene_(plan.walls),
        space_(std::move(space)),
        walk_(space_, options.walker, options.head),
        doors_(doorways_of(plan, space_, options.doors), options.doors,
               stir(options.walker.seed, 12)),  // one timetable for all walkers
        lidar_(options.lidar, sensor_seed(options.walker, 10)),
        ahrs_(sensor_seed(options.walker, 11)) {}

  Result<std::optional<sensing::RawScan>> next() override {
    const double t_s = static_cast<double>(sweeps_) / options_.lidar.turns_per_s;
    if (options_.duration_s ? t_s >= *options_.duration_s : walk_.first_round_done()) {
      return std::optional<sensing::RawScan>();
    }
    const HeadPose head = walk_.head_at(t_s);
    doors_.advance(t_s, head.T_world_head.translation());
    std::vector<std::pair<double, HeadPose>> later;  // heads of the sweep, 100 a second
    const auto head_at = [&](double at_s) {
      const HeadPose now = walk_.head_at(at_s);
      if (at_s >= (later.empty() ? t_s : later.back().first) + kAhrsIntervalS) {
        later.emplace_back(at_s, now);
      }
      return now;
    };
    sensing::RawScan scan = lidar_.sweep(scene_, head_at, t_s, doors_.closed());
    scan.stamp = kStart + from_seconds(t_s);
    if (options_.ahrs) {
      const double dt_s = sweeps_ == 0 ? 0.0 : 1.0 / options_.lidar.turns_per_s;
      scan.attitude = options_.head == Walk::Head::still
                          ? ahrs_.measure(head.T_world_head.yaw_rad, dt_s)
                          : ahrs_.measure_leaning(head, dt_s);
      for (const auto& [at_s, now] : later) {
        scan.later_attitudes.push_back(
            {from_seconds(at_s - t_s), moved(*scan.attitude, head, now)});
      }
    }
    ++sweeps_;
    return std::optional(std::move(scan));
  }

 private:
  SimulatorOptions options_;
  RayScene scene_;
  FreeSpace space_;
  Walk walk_;  // walks on space_
  Doors doors_;
  SimulatedLidar lidar_;
  SimulatedAhrs ahrs_;
  std::int64_t sweeps_ = 0;
};

}  // namespace

Result<std::unique_ptr<sensing::ScanSource>> open_simulated_source(const SourceSpec& spec) {
  const auto options = read_simulator_options(spec);
  if (!options) return forward_error(options);
  const auto plan = load_plan(spec.target, options->office);
  if (!plan) return forward_error(plan);
  auto space = FreeSpace::make(*plan);
  if (!space) return forward_error(space);
  return std::make_unique<SimulatedSource>(*plan, std::move(*space), *options);
}

Result<FloorPlan> load_plan(const SourceSpec& spec) {
  const auto options = read_simulator_options(spec);
  if (!options) return forward_error(options);
  return load_plan(spec.target, options->office);
}

}  // namespace lifeline::sources
