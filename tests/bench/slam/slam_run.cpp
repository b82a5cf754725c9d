#include "tests/bench/slam/slam_run.hpp"

#include <algorithm>
#include <chrono>
#include <csignal>
#include <fstream>
#include <optional>
#include <thread>

#include <malloc.h>

#include "common/files/map_file.hpp"
#include "common/files/map_picture.hpp"
#include "common/files/trajectory_error.hpp"
#include "common/files/tum.hpp"
#include "common/grid/occupancy_grid.hpp"
#include "deploy/demo/child_process.hpp"

namespace lifeline::bench {
namespace {

constexpr Duration kMostTime = std::chrono::minutes(30);
constexpr Duration kPoll = std::chrono::milliseconds(10);

std::string last_line(const std::filesystem::path& file) {
  std::ifstream stream(file);
  std::string last = "no output";
  for (std::string line; std::getline(stream, line);) {
    if (!line.empty()) last = line;
  }
  return last;
}

Result<void> play(const SlamJob& job, const std::filesystem::path& log) {
  auto child = demo::ChildProcess::start(
      {{job.agent.string(), "slam", "--source", job.source, "--matcher", job.matcher,
        "--trajectory", (job.folder / "t.tum").string(), "--map", (job.folder / "map").string(),
        "--stats", (job.folder / "stats.json").string()},
       log,
       false});
  if (!child) return forward_error(child);
  const auto deadline = std::chrono::steady_clock::now() + kMostTime;
  while (std::chrono::steady_clock::now() < deadline) {
    const auto status = child->ended();
    if (status == 0) return {};
    if (status) {
      return fail(ErrorCode::unavailable, "lifeline-agent ended with status {}: {}", *status,
                  last_line(log));
    }
    std::this_thread::sleep_for(kPoll);
  }
  return fail(ErrorCode::unavailable, "lifeline-agent did not end within half an hour");
}

std::vector<Eigen::Vector2d> points(const std::vector<StampedPose>& poses, const Pose2& T_map) {
  std::vector<Eigen::Vector2d> path;
  for (const StampedPose& pose : poses) path.push_back(T_map * pose.pose.translation());
  return path;
}

}  // namespace

Result<SlamOutcome> run_slam(const SlamJob& job) {
  // Linux counts what a parent occupies when it forks into its child's peak.
  ::malloc_trim(0);
  if (auto played = play(job, job.folder / "agent.log"); !played) return forward_error(played);
  SlamOutcome outcome;
  auto trajectory = files::read_tum(job.folder / "t.tum");
  if (!trajectory) return forward_error(trajectory);
  outcome.trajectory = *std::move(trajectory);
  if (std::filesystem::exists(job.folder / "t.truth.tum")) {
    auto truth = files::read_tum(job.folder / "t.truth.tum");
    if (!truth) return forward_error(truth);
    outcome.truth = *std::move(truth);
  }
  std::ifstream stats(job.folder / "stats.json");
  outcome.stats = nlohmann::json::parse(stats, nullptr, false);
  if (!outcome.stats.is_object()) {
    return fail(ErrorCode::bad_data, "{}: not the JSON that was asked for",
                (job.folder / "stats.json").string());
  }
  outcome.map = job.folder / "map.lifemap";
  return outcome;
}

Result<void> draw_run(const std::filesystem::path& picture, const SlamOutcome& run,
                      const std::string& title) {
  const auto map = files::load_map(run.map);
  if (!map) return forward_error(map);
  std::vector<files::PicturePath> paths;
  std::vector<StampedPose> truth = run.truth;
  std::ranges::stable_sort(truth, {}, &StampedPose::stamp);  // recorded times may go back
  if (const auto error = files::trajectory_error(run.trajectory, truth); error) {
    paths.push_back({"truth", points(run.truth, error->T_truth_estimate.inverse()), 1});
  }
  paths.push_back({"helmet", points(run.trajectory, {}), 0});
  const auto occupancy = to_occupancy(map->grid);
  if (!occupancy) return forward_error(occupancy);
  return files::write_map_picture(picture, *occupancy, paths, title);
}

}  // namespace lifeline::bench
