#include "agents/sources/simulator/simulated_source.hpp"

#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "agents/sources/simulator/doors.hpp"
#include "agents/sources/simulator/draw.hpp"
#include "agents/sources/simulator/free_space.hpp"
#include "agents/sources/simulator/load_plan.hpp"
#include "agents/sources/simulator/make_hard.hpp"
#include "agents/sources/simulator/passers_by.hpp"
#include "agents/sources/simulator/ray_scene.hpp"
#include "agents/sources/simulator/sensors.hpp"
#include "agents/sources/simulator/simulator_options.hpp"
#include "agents/sources/simulator/surroundings.hpp"
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
std::vector<Doorway> doorways_of(const FloorPlan& plan, Doors::When when) {
  return when == Doors::When::never ? std::vector<Doorway>{} : plan.doorways;
}

/// The faces of one material.
std::vector<WallSegment> faces_of(const FloorPlan& plan, Material material) {
  std::vector<WallSegment> faces;
  for (std::size_t i = 0; i < plan.materials.size(); ++i) {
    if (plan.materials[i] == material) faces.push_back(plan.walls[i]);
  }
  return faces;
}

/// All faces that beams do not pass through.
std::vector<WallSegment> opaque_faces(const FloorPlan& plan) {
  if (plan.materials.empty()) return plan.walls;
  std::vector<WallSegment> faces = faces_of(plan, Material::plain);
  const std::vector<WallSegment> black = faces_of(plan, Material::black);
  faces.insert(faces.end(), black.begin(), black.end());
  return faces;
}

std::vector<WallSegment> all_panes(const FloorPlan& plan) {
  std::vector<WallSegment> panes = faces_of(plan, Material::glass);
  panes.insert(panes.end(), plan.panes.begin(), plan.panes.end());
  return panes;
}

class SimulatedSource final : public sensing::ScanSource {
 public:
  SimulatedSource(const FloorPlan& plan, FreeSpace space, std::vector<Find> finds,
                  const SimulatorOptions& options)
      : options_(options),
        scene_(opaque_faces(plan)),
        black_(faces_of(plan, Material::black)),
        has_black_(!faces_of(plan, Material::black).empty()),
        panes_(all_panes(plan)),
        ceilings_(options.lidar.ceiling_m, plan.ceilings),
        space_(std::move(space)),
        walk_(space_, options.walker, options.head),
        doors_(doorways_of(plan, options.doors), options.doors,
               stir(options.walker.seed, 12)),  // one timetable for all walkers
        people_(space_, options.people, stir(options.walker.seed, 14)),
        lidar_(options.lidar, sensor_seed(options.walker, 10)),
        ahrs_(sensor_seed(options.walker, 11)),
        detector_(std::move(finds), sensor_seed(options.walker, 13)) {
    // Doors remember what was before.
    for (; time_s() < options_.from_s; ++sweeps_) advance(time_s());
  }

  Result<std::optional<sensing::RawScan>> next() override {
    const double t_s = time_s();
    if (options_.duration_s ? t_s >= *options_.duration_s : walk_.first_round_done()) {
      return std::optional<sensing::RawScan>();
    }
    const HeadPose head = advance(t_s);
    std::vector<std::pair<double, HeadPose>> later;  // heads of the sweep, 100 a second
    const auto head_at = [&](double at_s) {
      const HeadPose now = walk_.head_at(at_s);
      if (at_s >= (later.empty() ? t_s : later.back().first) + kAhrsIntervalS) {
        later.emplace_back(at_s, now);
      }
      return now;
    };
    sensing::RawScan scan = lidar_.sweep(surroundings(), head_at, t_s);
    scan.stamp = kStart + from_seconds(t_s);
    scan.sightings = detector_.look(scene_, head.T_world_head, doors_.closed());
    if (options_.ahrs) {
      const double dt_s = t_s <= options_.from_s ? 0.0 : 1.0 / options_.lidar.turns_per_s;
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
  /// Everything that moves, moved on to `t_s`; answers the head.
  HeadPose advance(double t_s) {
    const HeadPose head = walk_.head_at(t_s);
    doors_.advance(t_s, head.T_world_head.translation());
    people_.advance(t_s, head.T_world_head.translation());
    return head;
  }
  [[nodiscard]] Surroundings surroundings() const {
    return {.walls = scene_,
            .more_walls = doors_.closed(),
            .panes = panes_,
            .closed_glass = doors_.closed_glass(),
            .black = has_black_ ? &black_ : nullptr,
            .people = people_.places(),
            .ceilings = &ceilings_};
  }
  [[nodiscard]] double time_s() const {
    return static_cast<double>(sweeps_) / options_.lidar.turns_per_s;
  }

  SimulatorOptions options_;
  RayScene scene_, black_;
  bool has_black_;
  std::vector<WallSegment> panes_;
  Ceilings ceilings_;
  FreeSpace space_;
  Walk walk_;  // walks on space_
  Doors doors_;
  PassersBy people_;
  SimulatedLidar lidar_;
  SimulatedAhrs ahrs_;
  SimulatedDetector detector_;
  std::int64_t sweeps_ = 0;
};

/// A building as its spec describes it.
struct Site {
  SimulatorOptions options;
  FloorPlan plan;
  FreeSpace space;
  std::vector<Find> finds;
};

Result<Site> open_site(const SourceSpec& spec) {
  const auto options = read_simulator_options(spec);
  if (!options) return forward_error(options);
  auto plan = load_plan(spec.target, options->office);
  if (!plan) return forward_error(plan);
  auto space = FreeSpace::make(*plan);
  if (!space) return forward_error(space);
  if (options->doors != Doors::When::never && plan->doorways.empty()) {
    plan->doorways = find_doorways(*plan, *space);
  }
  const auto hard = make_hard(options->hardships, options->lidar.ceiling_m,
                              stir(options->office.seed, 21), *plan);
  if (!hard) return forward_error(hard);
  auto finds = place_finds(*space, options->victims, options->tags, stir(options->office.seed, 20));
  if (!finds) return forward_error(finds);
  return Site{*options, *std::move(plan), *std::move(space), *std::move(finds)};
}

}  // namespace

Result<std::unique_ptr<sensing::ScanSource>> open_simulated_source(const SourceSpec& spec) {
  auto site = open_site(spec);
  if (!site) return forward_error(site);
  return std::make_unique<SimulatedSource>(site->plan, std::move(site->space),
                                           std::move(site->finds), site->options);
}

Result<FloorPlan> load_plan(const SourceSpec& spec) {
  const auto options = read_simulator_options(spec);
  if (!options) return forward_error(options);
  auto plan = load_plan(spec.target, options->office);
  if (!plan) return plan;
  const auto hard = make_hard(options->hardships, options->lidar.ceiling_m,
                              stir(options->office.seed, 21), *plan);
  if (!hard) return forward_error(hard);
  return plan;
}

Result<std::vector<Find>> load_finds(const SourceSpec& spec) {
  auto site = open_site(spec);
  if (!site) return forward_error(site);
  return std::move(site->finds);
}

}  // namespace lifeline::sources
