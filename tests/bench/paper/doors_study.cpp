#include "tests/bench/paper/doors_study.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <fmt/format.h>

#include "common/base/angles.hpp"
#include "common/base/quantile.hpp"
#include "common/files/trajectory_error.hpp"
#include "tests/bench/paper/panels.hpp"

namespace lifeline::bench {
namespace {

constexpr double kLostM = 0.5, kLostRad = 10.0 * kDegree;

/// What the paper says of its figures; it gives no numbers.
const char* said_of(int experiment, Method method) {
  if (method == Method::ours) return "";
  if (experiment == 2) return "not shown";
  return method == Method::conventional ? "orientation errors, bent map" : "issue resolved";
}

std::vector<Eigen::Vector2d> path_of(const std::vector<StampedPose>& poses, const Pose2& T) {
  std::vector<Eigen::Vector2d> path;
  for (const StampedPose& pose : poses) path.push_back(T * pose.pose.translation());
  return path;
}

std::vector<double> each(const std::vector<DoorsStudy::Run>& runs,
                         double DoorsStudy::Run::*figure) {
  std::vector<double> values;
  for (const auto& run : runs) values.push_back(run.*figure);
  return values;
}

}  // namespace

void DoorsStudy::play(const PaperExperiment& experiment, const PaperWalk& walk,
                      const std::optional<std::filesystem::path>& picture) {
  std::vector<std::unique_ptr<HelmetMapper>> drawn;
  std::vector<Panel> panels;
  for (const Method method : kMethods) {
    for (std::size_t rescuer = 0; rescuer < walk.scans.size(); ++rescuer) {
      auto helmet = make_helmet(method);
      for (const auto& raw : walk.scans[rescuer]) helmet->step(as_seen_by(method, raw));
      helmet->finish();
      const auto error = files::trajectory_error(helmet->trajectory(), helmet->truth());
      if (!error) throw std::runtime_error(error.error().text);
      runs_[{experiment.number, method}].push_back(
          {error->rmse_m, error->rmse_rad / kDegree, error->max_rad / kDegree,
           error->max_m <= kLostM && error->max_rad <= kLostRad});
      if (!picture || rescuer != 0) continue;
      // From where the walk began: what goes wrong later is seen.
      const Pose2 T_world_map = helmet->truth().front().pose;
      panels.push_back(
          {fmt::format("{}: {:.2f} m, {:.1f} deg", name_of(method), error->rmse_m,
                       error->max_rad / kDegree),
           &helmet->layer(),
           T_world_map,
           {path_of(helmet->truth(), {}), path_of(helmet->trajectory(), T_world_map)}});
      drawn.push_back(std::move(helmet));
    }
  }
  if (!picture) return;
  if (const auto done = draw_panels(*picture, walk.plan, panels, 3); !done) {
    throw std::runtime_error(done.error().text);
  }
}

std::vector<ReportRow> DoorsStudy::rows() const {
  std::vector<ReportRow> rows;
  for (const auto& [key, runs] : runs_) {
    const auto& [experiment, method] = key;
    const std::string name = fmt::format("a, experiment {}, {}", experiment, name_of(method));
    const char* said = said_of(experiment, method);
    const auto survived =
        static_cast<double>(
            std::count_if(runs.begin(), runs.end(), [](const Run& run) { return run.survived; })) *
        100.0 / static_cast<double>(runs.size());
    ReportRow row{name + ": walks that survive every door", survived, "%", {}, said};
    if (method != Method::conventional) row.bar = Bar{Bar::Side::at_least, 100.0};
    rows.push_back(row);
    const auto heading = each(runs, &Run::heading_worst_deg);
    rows.push_back(
        {name + ": worst heading error, median", quantile(heading, 0.5), "deg", {}, said});
    rows.push_back({name + ": worst heading error, worst", quantile(heading, 1.0), "deg", {}, ""});
    rows.push_back({name + ": heading error rms, median",
                    quantile(each(runs, &Run::heading_rms_deg), 0.5),
                    "deg",
                    {},
                    ""});
    const auto rmse = each(runs, &Run::rmse_m);
    rows.push_back({name + ": rmse, median", quantile(rmse, 0.5), "m", {}, ""});
    rows.push_back({name + ": rmse, worst", quantile(rmse, 1.0), "m", {}, ""});
  }
  return rows;
}

}  // namespace lifeline::bench
