#include "tests/bench/slam/slam_judge.hpp"

#include <algorithm>
#include <limits>
#include <numbers>

#include <fmt/format.h>

#include "common/base/quantile.hpp"
#include "common/files/trajectory_error.hpp"
#include "common/files/tum.hpp"
#include "tests/bench/slam/body_error.hpp"
#include "tests/bench/slam/relations_error.hpp"

namespace lifeline::bench {
namespace {

constexpr double kNothing = std::numeric_limits<double>::quiet_NaN();
constexpr double kMostMemoryMb = 40.0;

std::optional<Bar> at_most(std::optional<double> limit, bool wanted = true) {
  if (!limit || !wanted) return std::nullopt;
  return Bar{Bar::Side::at_most, *limit};
}

std::vector<StampedPose> by_time(std::vector<StampedPose> poses) {
  std::ranges::stable_sort(poses, {}, &StampedPose::stamp);  // recorded times may go back
  return poses;
}

Result<double> measure(const LogCase& log, const SlamOutcome& run) {
  switch (log.measure) {
    case Measure::relations: {
      const auto error = relations_error(run.trajectory, log.truth, log.odometry);
      if (!error) return forward_error(error);
      return error->translation_mean_m;
    }
    case Measure::rmse: {
      const auto error = files::trajectory_error(run.trajectory, by_time(run.truth));
      if (!error) return forward_error(error);
      return error->rmse_m;
    }
    case Measure::body_rmse: {
      const auto truth = files::read_tum(log.truth);
      if (!truth) return forward_error(truth);
      const auto fitted = body_error(run.trajectory, by_time(*truth));
      if (!fitted) return forward_error(fitted);
      return fitted->error.rmse_m;
    }
    case Measure::failures:
      break;
  }
  return run.stats.value("failures", kNothing);
}

const char* measure_name(Measure measure) {
  switch (measure) {
    case Measure::relations:
      return "relations";
    case Measure::rmse:
      return "rmse";
    case Measure::body_rmse:
      return "rmse to motion capture";
    case Measure::failures:
      break;
  }
  return "failed scans";
}

void add_cost(const LogCase& log, const std::string& name, bool has_bars, const SlamOutcome& run,
              std::vector<ReportRow>& rows) {
  const bool timed = has_bars && log.beams >= 360;
  rows.push_back({name + ": step, median", run.stats.value("step_ms_median", kNothing), "ms",
                  at_most(0.25, timed), "Hector 0.19, iris_lama 0.70, AutonOHM 84"});
  rows.push_back({name + ": step, p99", run.stats.value("step_ms_p99", kNothing), "ms",
                  at_most(1.0, timed), "Hector 0.41, iris_lama 1.4, AutonOHM 169"});
  rows.push_back({name + ": peak memory", run.stats.value("peak_rss_mb", kNothing), "MB",
                  at_most(kMostMemoryMb, has_bars), "iris_lama 15, Hector 95, AutonOHM 223"});
}

/// The stages that took any time.
void add_stages(const std::string& name, const SlamOutcome& run, std::vector<ReportRow>& rows) {
  const auto stages = run.stats.find("stages_ms");
  if (stages == run.stats.end()) return;
  for (const auto& [stage, ms] : stages->items()) {
    const double p99 = ms.value("p99", kNothing);
    if (p99 <= 0.0) continue;
    rows.push_back(
        {fmt::format("{}: {}, median", name, stage), ms.value("median", kNothing), "ms"});
    rows.push_back({fmt::format("{}: {}, p99", name, stage), p99, "ms"});
  }
}

/// One figure of every walk that has figures.
std::vector<double> each(const std::vector<std::optional<WalkFigures>>& walks,
                         double WalkFigures::*figure) {
  std::vector<double> values;
  for (const auto& walk : walks) {
    if (walk) values.push_back((*walk).*figure);
  }
  return values;
}

}  // namespace

std::vector<ReportRow> judge_log(const LogCase& log, const std::string& matcher,
                                 const Result<SlamOutcome>& run) {
  const std::string name = fmt::format("{}, {}", log.name, matcher);
  const bool has_bars = matcher == kDefaultMatcher;
  if (!run) return {{name, kNothing, "m", at_most(log.bar, has_bars), run.error().text}};
  const auto value = measure(log, *run);
  const char* unit = log.measure == Measure::failures ? "" : "m";
  std::vector<ReportRow> rows{{fmt::format("{}: {}", name, measure_name(log.measure)),
                               value.value_or(kNothing), unit, at_most(log.bar, has_bars),
                               value ? log.reference : value.error().text}};
  if (log.worst) {
    const auto error = files::trajectory_error(run->trajectory, by_time(run->truth));
    rows.push_back({name + ": worst pose", error ? error->max_m : kNothing, "m",
                    at_most(log.worst, has_bars), ""});
  }
  add_cost(log, name, has_bars, *run, rows);
  if (has_bars) add_stages(name, *run, rows);
  return rows;
}

Result<WalkFigures> judge_walk(const SlamOutcome& run) {
  constexpr double kLostM = 0.5, kLostRad = 10.0 * std::numbers::pi / 180.0;
  const auto error = files::trajectory_error(run.trajectory, run.truth);
  if (!error) return forward_error(error);
  if (run.trajectory.size() != run.truth.size()) {
    return fail(ErrorCode::bad_data, "{} poses for {} scans", run.trajectory.size(),
                run.truth.size());
  }
  return WalkFigures{.rmse_m = error->rmse_m,
                     .worst_m = error->max_m,
                     .drift_deg_per_m = heading_drift_deg_per_m(run.trajectory, run.truth),
                     .step_ms_median = run.stats.value("step_ms_median", kNothing),
                     .step_ms_p99 = run.stats.value("step_ms_p99", kNothing),
                     .peak_rss_mb = run.stats.value("peak_rss_mb", kNothing),
                     .tracked = error->max_m <= kLostM && error->max_rad <= kLostRad};
}

std::vector<ReportRow> accuracy_rows(const std::string& name,
                                     const std::vector<std::optional<WalkFigures>>& walks,
                                     bool has_bars) {
  const std::string failed =
      std::ranges::all_of(walks, [](const auto& walk) { return walk.has_value(); })
          ? ""
          : "some runs failed";
  const auto row = [&](const char* what, double WalkFigures::*figure, double share,
                       const char* unit, double bar) {
    const double value = failed.empty() ? quantile(each(walks, figure), share) : kNothing;
    return ReportRow{fmt::format("{}: {}", name, what), value, unit, at_most(bar, has_bars),
                     failed};
  };
  return {
      row("rmse, median walk", &WalkFigures::rmse_m, 0.5, "m", 0.03),
      row("rmse, worst walk", &WalkFigures::rmse_m, 1.0, "m", 0.10),
      row("heading drift, median walk", &WalkFigures::drift_deg_per_m, 0.5, "deg/m", 0.02),
      row("step, median", &WalkFigures::step_ms_median, 0.5, "ms", 0.8),
      row("step, p99 of the worst walk", &WalkFigures::step_ms_p99, 1.0, "ms", 30.0),
      row("peak memory, worst walk", &WalkFigures::peak_rss_mb, 1.0, "MB", kMostMemoryMb),
  };
}

ReportRow tracking_row(const std::string& name,
                       const std::vector<std::optional<WalkFigures>>& walks, bool has_bar) {
  const auto tracked =
      std::ranges::count_if(walks, [](const auto& walk) { return walk && walk->tracked; });
  const double share =
      walks.empty() ? kNothing
                    : 100.0 * static_cast<double>(tracked) / static_cast<double>(walks.size());
  ReportRow row{name + ": walks without tracking failure", share, "%"};
  if (has_bar) row.bar = Bar{Bar::Side::at_least, 100.0};
  return row;
}

}  // namespace lifeline::bench
