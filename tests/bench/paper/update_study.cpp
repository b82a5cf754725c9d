#include "tests/bench/paper/update_study.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>

#include <fmt/format.h>

#include "agents/sources/simulator/draw.hpp"
#include "common/base/angles.hpp"
#include "common/base/quantile.hpp"
#include "common/files/trajectory_error.hpp"
#include "common/grid/occupancy_grid.hpp"
#include "tests/bench/paper/panels.hpp"
#include "tests/bench/paper/team.hpp"

namespace lifeline::bench {
namespace {

constexpr double kSpoiltM = 0.25, kSpoiltRad = 3.0 * kDegree;
constexpr std::array<double, 3> kWeights{1.0, 0.95, 0.5};

Pose2 spoilt(const Pose2& T_map1_map2, std::uint64_t seed) {
  sources::Draw draw(sources::stir(seed, 70));
  const double towards = draw.between(-std::numbers::pi, std::numbers::pi);
  const double turn_rad = draw.chance(0.5) ? kSpoiltRad : -kSpoiltRad;
  return Pose2{kSpoiltM * std::cos(towards), kSpoiltM * std::sin(towards), 0.0} * T_map1_map2 *
         Pose2{0.0, 0.0, turn_rad};
}

std::string name_of_weight(double w_T1) {
  return w_T1 == 1.0 ? "no update" : fmt::format("w_T1 = {}", w_T1);
}

const char* said_of(bool is_spoilt, double w_T1) {
  if (is_spoilt) return w_T1 == 0.95 ? "better than 0.5 where T_G is wrong" : "";
  if (w_T1 == 1.0) return "imperfectly merged, walls doubled";
  return w_T1 == 0.5 ? "more correct than with 0.95" : "several parts do not overlap";
}

files::TrajectoryError error_of(const HelmetMapper& helmet) {
  const auto error = files::trajectory_error(helmet.trajectory(), helmet.truth());
  if (!error) throw std::runtime_error(error.error().text);
  return *error;
}

bool explored(const Team& team, double beta_percent) {
  constexpr double kAllCells = 600.0 * 600.0;  // the paper's grid
  return std::min(known_cells(team.layer(0)), known_cells(team.layer(1))) >
         static_cast<std::size_t>(beta_percent / 100.0 * kAllCells);
}

std::vector<double> each(const std::vector<UpdateStudy::Run>& runs,
                         double UpdateStudy::Run::*figure) {
  std::vector<double> values;
  for (const auto& run : runs) values.push_back(run.*figure);
  return values;
}

}  // namespace

void UpdateStudy::play(const PaperExperiment& experiment, const PaperWalk& walk, std::uint64_t seed,
                       const std::optional<std::filesystem::path>& picture) {
  const Pose2 truth = true_T_map1_map2(walk);
  std::vector<TsdGrid> maps;
  std::vector<Panel> panels;
  maps.reserve(2 * kWeights.size());
  for (const bool is_spoilt : {false, true}) {
    const Pose2 T_map1_map2 = is_spoilt ? spoilt(truth, seed) : truth;
    for (const double w_T1 : kWeights) {
      Team team(Method::ours);
      bool merged = false;
      team.play(walk, [&](double) {
        if (merged || !explored(team, experiment.beta_percent)) return;
        team.merge(T_map1_map2, w_T1);
        merged = true;
      });
      const auto first = error_of(team.helmet(0)), second = error_of(team.helmet(1));
      maps.push_back(team.merged(T_map1_map2));
      const MapError error = map_error(maps.back(), first.T_truth_estimate, walk.plan);
      runs_[{experiment.number, is_spoilt, w_T1}].push_back(
          {error.wall_m, 100.0 * error.astray_share, 100.0 * error.complete_share,
           std::max(first.rmse_m, second.rmse_m)});
      panels.push_back({fmt::format("{}, {}: {:.1f} cm", is_spoilt ? "T_G spoilt" : "T_G good",
                                    name_of_weight(w_T1), 100.0 * error.wall_m),
                        &maps.back(), first.T_truth_estimate});
    }
  }
  if (!picture) return;
  if (const auto done = draw_panels(*picture, walk.plan, panels, 3); !done) {
    throw std::runtime_error(done.error().text);
  }
}

std::vector<ReportRow> UpdateStudy::rows() const {
  std::vector<ReportRow> rows;
  for (const auto& [key, runs_of_key] : runs_) {
    const auto& runs = runs_of_key;  // clang 14 captures no structured binding
    const auto& [experiment, is_spoilt, w_T1] = key;
    const std::string name = fmt::format("c, experiment {}, T_G {}, {}", experiment,
                                         is_spoilt ? "spoilt" : "good", name_of_weight(w_T1));
    const auto add = [&](const char* what, double Run::*figure, double share, const char* unit,
                         const char* said) {
      rows.push_back(
          {fmt::format("{}: {}", name, what), quantile(each(runs, figure), share), unit, {}, said});
    };
    add("wall error, median", &Run::wall_m, 0.5, "m", said_of(is_spoilt, w_T1));
    add("wall error, worst", &Run::wall_m, 1.0, "m", "");
    add("walls astray, median", &Run::astray_percent, 0.5, "%", "");
    add("plan's walls found, median", &Run::complete_percent, 0.5, "%", "");
    add("rmse of the worse helmet, median", &Run::rmse_m, 0.5, "m", "");
    add("rmse of the worse helmet, worst", &Run::rmse_m, 1.0, "m", "");
  }
  return rows;
}

}  // namespace lifeline::bench
