#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "agents/sources/simulator/office.hpp"
#include "tests/support/scripted_fleet.hpp"
#include "tests/support/simulated_maps.hpp"

namespace lifeline::test {

/// Helmets that walk a generated office, their layers drawn from simulated scans.
class Drill {
 public:
  Drill(std::uint64_t building, const std::vector<std::string>& ids,
        CoordinatorSettings settings = ScriptedFleet::default_settings(),
        std::unique_ptr<MatchWorker> worker = nullptr)
      : floor_(
            SimulatedFloor::make(
                sources::generate_office({.seed = building, .width_m = 26, .depth_m = 18}).value())
                .value()),
        fleet_(ids, std::move(settings), std::move(worker)) {
    for (std::size_t i = 0; i < ids.size(); ++i) {
      const double x = static_cast<double>(i);
      SimulatedView& view = views_[ids[i]];
      view.walker = {.seed = building, .walker = static_cast<int>(i), .walkers = 1};
      view.noise_seed = 7 + i;
      view.T_world_map = {x, 2.0, 0.7 * x};
    }
  }

  [[nodiscard]] ScriptedFleet& fleet() { return fleet_; }
  [[nodiscard]] SimulatedView& view(const std::string& id) { return views_.at(id); }
  /// What a helmet's layer is after its walk of `walked_s` seconds.
  [[nodiscard]] TsdGrid layer(const std::string& id) const { return floor_.map(views_.at(id)); }

  /// Everybody walks on to this time, and shows the layer.
  void walk_to(double until_s) {
    for (auto& [id, view] : views_) {
      view.until_s = until_s;
      fleet_.helmet(id).show(floor_.map(view));
    }
    fleet_.run(std::chrono::seconds(2));
  }
  void finish() {
    for (auto& [id, view] : views_) fleet_.helmet(id).finish();
    fleet_.run(std::chrono::seconds(5));
  }

  /// How far the directive lays b from where it truly is, at the farthest of a few places of its
  /// map.
  [[nodiscard]] double error_m(const std::string& a, const std::string& b) const {
    const Pose2 truth = views_.at(a).T_world_map.inverse() * views_.at(b).T_world_map;
    const Pose2 told = fleet_.T_a_b(a, b);
    double worst_m = 0.0;
    for (const Eigen::Vector2d& p_world : {Eigen::Vector2d(5, 5), {20, 5}, {5, 13}, {20, 13}}) {
      const Eigen::Vector2d p_b = views_.at(b).T_world_map.inverse() * p_world;
      worst_m = std::max(worst_m, (told * p_b - truth * p_b).norm());
    }
    return worst_m;
  }

 private:
  SimulatedFloor floor_;
  ScriptedFleet fleet_;
  std::map<std::string, SimulatedView> views_;
};

}  // namespace lifeline::test
