#include "tests/bench/merge/fleet_pairs.hpp"

#include <cmath>
#include <cstdint>
#include <numbers>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "agents/sources/simulator/draw.hpp"
#include "agents/sources/simulator/office.hpp"
#include "common/base/check.hpp"
#include "common/wire/coarse_cells.hpp"
#include "coordinator/matching/match_maps.hpp"
#include "coordinator/matching/stop_watch.hpp"
#include "tests/bench/merge/path_report.hpp"
#include "tests/support/simulated_maps.hpp"

namespace lifeline::bench {
namespace {

constexpr int kTeam = 10;
constexpr double kWalk_s = 120.0;

struct HelmetMap {
  Pose2 T_world_map;
  TsdGrid layer;
};

std::vector<HelmetMap> walk() {
  auto plan = sources::generate_office({.seed = 77, .width_m = 40.0, .depth_m = 25.0});
  LIFELINE_CHECK(plan);
  const auto floor = test::SimulatedFloor::make(*std::move(plan));
  LIFELINE_CHECK(floor);
  sources::Draw draw(45);
  std::vector<HelmetMap> maps;
  for (int i = 0; i < kTeam; ++i) {
    test::SimulatedView view;
    view.walker = {.seed = 5, .walker = i, .walkers = kTeam};
    view.until_s = kWalk_s;
    view.T_world_map = {draw.between(-9, 9), draw.between(-9, 9), draw.between(-3, 3)};
    view.noise_seed = static_cast<std::uint64_t>(i) + 1;
    maps.push_back({view.T_world_map, floor->map(view)});
  }
  return maps;
}

struct Outcome {
  std::size_t right = 0, wrong = 0;
  std::vector<double> metres, degrees;
  matching::StepTimes steps_ms;
};

void judge(const matching::MatchResult& result, const Pose2& T_a_b, Outcome& outcome) {
  outcome.steps_ms.search += result.steps_ms.search;
  outcome.steps_ms.refine += result.steps_ms.refine;
  outcome.steps_ms.figures += result.steps_ms.figures;
  outcome.steps_ms.control += result.steps_ms.control;
  if (!result.accepted()) return;
  const Pose2& found = result.candidates.front().T_a_b;
  const Eigen::Vector2d& p_b = result.overlap_centre_b_m;
  const double error_m = (found * p_b - T_a_b * p_b).norm();
  const double error_deg =
      std::abs(normalise_angle(found.yaw_rad - T_a_b.yaw_rad)) * 180.0 / std::numbers::pi;
  if (error_m >= 0.5 || error_deg >= 2.0) {
    ++outcome.wrong;
    return;
  }
  ++outcome.right;
  outcome.metres.push_back(error_m);
  outcome.degrees.push_back(error_deg);
}

/// What a coordinator gets of a layer by default.
TsdGrid as_shared(const TsdGrid& layer) {
  TsdGrid shared(layer.geometry());
  for (const TileIndex tile : layer.tiles())
    shared.at(tile) = dequantise(wire::coarse(quantise(*layer.find(tile))));
  return shared;
}

void write_rows(const std::vector<HelmetMap>& maps, const std::string& kind, Report& report) {
  matching::StopWatch watch;
  std::vector<matching::MapFeatures> features;
  for (const HelmetMap& map : maps) features.push_back(matching::build_features(map.layer).value());
  const double features_ms = watch.lap_ms();
  Outcome outcome;
  std::size_t pairs = 0;
  double known_m2 = 0.0;
  for (std::size_t a = 0; a < maps.size(); ++a) {
    known_m2 += features[a].known_m2 / kTeam;
    for (std::size_t b = a + 1; b < maps.size(); ++b) {
      ++pairs;
      judge(matching::match_maps(features[a], features[b], {}),
            maps[a].T_world_map.inverse() * maps[b].T_world_map, outcome);
    }
  }
  const double pairs_ms = watch.lap_ms();

  const std::string name = fmt::format("{} helmets, {:.0f} m2 each{}", kTeam, known_m2, kind);
  const auto add = [&](const std::string& what, double value, const char* unit,
                       std::optional<Bar> bar = {}) {
    report.rows.push_back({name + ": " + what, value, unit, bar, {}});
  };
  const auto at_most = [](double limit) { return Bar{Bar::Side::at_most, limit}; };
  add(fmt::format("all {} pairs", pairs), pairs_ms / 1000.0, "s", at_most(2.0));
  const auto each = static_cast<double>(pairs);
  add("features of one map", features_ms / kTeam, "ms");
  add("one pair, search", outcome.steps_ms.search / each, "ms");
  add("one pair, refinement", outcome.steps_ms.refine / each, "ms");
  add("one pair, figures and bend", outcome.steps_ms.figures / each, "ms");
  add("one pair, mirror image", outcome.steps_ms.control / each, "ms");
  add(fmt::format("merged rightly of {}", pairs), static_cast<double>(outcome.right), "");
  add("merged wrongly", static_cast<double>(outcome.wrong), "", at_most(0.0));
  add("error to the exact truth, median", quantile(outcome.metres, 0.5), "m", at_most(0.015));
  add("error to the exact truth, p95", quantile(outcome.metres, 0.95), "m", at_most(0.06));
  add("error to the exact truth, median", quantile(outcome.degrees, 0.5), "deg", at_most(0.06));
  add("error to the exact truth, p95", quantile(outcome.degrees, 0.95), "deg", at_most(0.3));
}

}  // namespace

void write_fleet_rows(Report& report) {
  std::vector<HelmetMap> maps = walk();
  write_rows(maps, "", report);
  for (HelmetMap& map : maps) map.layer = as_shared(map.layer);
  write_rows(maps, ", coarse", report);
}

}  // namespace lifeline::bench
