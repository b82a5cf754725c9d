#include "tests/bench/paper/timing_study.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <string>

#include <fmt/format.h>

#include "common/base/angles.hpp"
#include "common/base/quantile.hpp"
#include "coordinator/matching/match_maps.hpp"
#include "tests/bench/paper/panels.hpp"
#include "tests/bench/paper/team.hpp"

namespace lifeline::bench {
namespace {

constexpr double kEveryS = 5.0;
constexpr double kRightM = 0.5, kRightRad = 2.0 * kDegree;
constexpr std::array<double, 4> kBetas{0.28, 2.0, 5.0, 10.0};
/// Those of the paper's Figure 8.
constexpr std::array<double, 2> kShown{0.28, 5.0};
constexpr std::array<matching::Method, 2> kMatchings{matching::Method::spectra,
                                                     matching::Method::oriented};

double explored_percent(const TsdGrid& map, const matching::MatchConfig& config) {
  const double cell_m = map.geometry().cell_size_m;
  return 100.0 * static_cast<double>(known_cells(map)) * cell_m * cell_m /
         (config.area_x_m * config.area_y_m);
}

/// Within half a metre, where the second rescuer stands, and 2 deg.
bool is_right(const Pose2& T_1_2, const Pose2& truth, const Eigen::Vector2d& p_map2) {
  return (T_1_2 * p_map2 - truth * p_map2).norm() < kRightM &&
         std::abs(normalise_angle(T_1_2.yaw_rad - truth.yaw_rad)) < kRightRad;
}

matching::MapFeatures features_of(const TsdGrid& map) {
  auto features = matching::build_features(map);
  if (!features) throw std::runtime_error(features.error().text);
  return *std::move(features);
}

const char* name_of(matching::Method method) {
  return method == matching::Method::spectra ? "paper's matching" : "ours";
}

double percent(std::size_t count, std::size_t of) {
  return of == 0 ? std::nan("") : 100.0 * static_cast<double>(count) / static_cast<double>(of);
}

}  // namespace

MergeOutcome outcome_of(const std::vector<MergeAttempt>& attempts, double beta_percent) {
  MergeOutcome outcome;
  for (const MergeAttempt& attempt : attempts) {
    if (!(attempt.explored_percent > beta_percent)) continue;
    if (!outcome.tried) outcome.first_is_right = attempt.best_is_right;
    outcome.tried = true;
    if (!attempt.accepted) continue;
    outcome.merged_s = attempt.at_s;
    outcome.merged_rightly = attempt.best_is_right;
    break;
  }
  return outcome;
}

void TimingStudy::play(const PaperExperiment& experiment, const PaperWalk& walk,
                       const std::optional<std::filesystem::path>& picture) {
  Team team(Method::ours);
  const Pose2 truth = true_T_map1_map2(walk);
  std::map<matching::Method, std::vector<MergeAttempt>> attempts;
  std::vector<TsdGrid> shown;
  std::vector<Panel> panels;
  double next_s = 0.0, next_shown = kShown.front();
  team.play(walk, [&](double at_s) {
    if (at_s < next_s) return;
    next_s += kEveryS;
    const auto a = features_of(team.layer(0)), b = features_of(team.layer(1));
    const Eigen::Vector2d p_map2 = team.helmet(1).state().T_map_head.translation();
    for (const matching::Method method : kMatchings) {
      const auto config = match_config(experiment, method);
      const auto result = matching::match_maps(a, b, config);
      const double explored = std::min(explored_percent(team.layer(0), config),
                                       explored_percent(team.layer(1), config));
      const bool right =
          !result.candidates.empty() && is_right(result.candidates.front().T_a_b, truth, p_map2);
      attempts[method].push_back({at_s, explored, right, result.accepted()});
      if (!picture || method != matching::Method::spectra || result.candidates.empty() ||
          !(explored > next_shown)) {
        continue;
      }
      shown.push_back(team.merged(result.candidates.front().T_a_b));
      panels.push_back({fmt::format("beta {} %, after {:.0f} s: {}", next_shown, at_s,
                                    right ? "right" : "wrong"),
                        nullptr, walk.scans[0].front().T_world_head_truth.value()});
      next_shown = next_shown < kShown.back() ? kShown.back() : 1000.0;
    }
  });
  for (auto& [method, series] : attempts) {
    pairs_[{experiment.number, method}].push_back(std::move(series));
  }
  if (!picture) return;
  for (std::size_t i = 0; i < panels.size(); ++i) panels[i].map = &shown[i];
  if (const auto done = draw_panels(*picture, walk.plan, panels, 2); !done) {
    throw std::runtime_error(done.error().text);
  }
}

std::vector<ReportRow> TimingStudy::rows() const {
  std::vector<ReportRow> rows;
  for (const auto& [key, pairs] : pairs_) {
    const auto& [experiment, method] = key;
    for (const double beta : kBetas) {
      std::size_t tried = 0, first = 0, right = 0, wrong = 0, late = 0;
      std::vector<double> merged_s;
      for (const auto& attempts : pairs) {
        const MergeOutcome outcome = outcome_of(attempts, beta);
        if (!outcome.tried) continue;
        ++tried;
        first += outcome.first_is_right ? 1U : 0U;
        if (outcome.merged_s) merged_s.push_back(*outcome.merged_s);
        const bool in_time = outcome.merged_s && *outcome.merged_s <= 0.5 * duration_s_;
        if (outcome.merged_s && !outcome.merged_rightly) {
          ++wrong;
        } else {
          (in_time ? right : late) += 1;
        }
      }
      const std::string name =
          fmt::format("b, experiment {}, {}, beta {} %", experiment, name_of(method), beta);
      const char* said = beta < 1.0 ? "not aligned well: many candidates" : "more accurate";
      rows.push_back({name + ": first candidate right", percent(first, tried), "%", {}, said});
      rows.push_back({name + ": merged rightly in time", percent(right, tried), "%", {}, ""});
      ReportRow row{name + ": merged wrongly", percent(wrong, tried), "%", {}, ""};
      if (method == matching::Method::oriented) row.bar = Bar{Bar::Side::at_most, 0.0};
      rows.push_back(row);
      rows.push_back({name + ": late or never", percent(late, tried), "%", {}, ""});
      rows.push_back({name + ": merged after, median",
                      merged_s.empty() ? std::nan("") : quantile(merged_s, 0.5),
                      "s",
                      {},
                      ""});
    }
  }
  // Nobody ever merged: nothing to take a median of.
  std::erase_if(rows, [](const ReportRow& row) { return std::isnan(row.value); });
  return rows;
}

}  // namespace lifeline::bench
