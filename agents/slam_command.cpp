#include "agents/slam_command.hpp"

#include <chrono>
#include <cstdio>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <sys/resource.h>

#include "agents/agent_settings.hpp"
#include "agents/loaded_pages.hpp"
#include "agents/sensing/motion_tracker.hpp"
#include "agents/slam/loop_closer.hpp"
#include "agents/slam/scan_check.hpp"
#include "agents/slam/stage_times.hpp"
#include "agents/sources/open_source.hpp"
#include "common/base/log.hpp"
#include "common/base/quantile.hpp"
#include "common/base/stop_signal.hpp"
#include "common/files/atomic_file.hpp"
#include "common/files/map_file.hpp"
#include "common/files/occupancy_image.hpp"
#include "common/files/tum.hpp"
#include "common/grid/occupancy_grid.hpp"
#include "common/grid/stamped_pose.hpp"
#include "idl/config.pb.h"

namespace lifeline {
namespace {

/// What the scans did, in their order.
struct SlamRun {
  void note(const slam::SlamStep& step) {
    ++scans;
    weak += step.verdict == slam::Verdict::weak ? 1 : 0;
    rejected += step.verdict == slam::Verdict::rejected ? 1 : 0;
    searches += step.source == slam::PoseSource::search ? 1 : 0;
    pushed += step.pushed;
    undecided += step.stories > 1 ? 1 : 0;
    lost_scans += step.lost ? 1 : 0;
    relocalisations += step.source == slam::PoseSource::relocalised ? 1 : 0;
  }

  std::vector<StampedPose> trajectory;
  std::vector<StampedPose> truth;
  std::vector<double> step_ms;
  std::vector<slam::StageTimes> stages;
  std::vector<double> loop_ms;
  int weak = 0;
  int rejected = 0;
  int searches = 0;
  int pushed = 0;
  int undecided = 0;
  int lost_scans = 0;
  int relocalisations = 0;
  int bad_scans = 0;
  int revisited = 0;
  std::size_t scans = 0;
  std::size_t loops = 0;
  int corrections = 0;
};

double peak_rss_mb() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024.0;  // Linux counts in KiB
}

double milliseconds(Duration duration) {
  return 1e3 * to_seconds(duration);
}
double milliseconds_since(std::chrono::steady_clock::time_point started) {
  return milliseconds(std::chrono::steady_clock::now() - started);
}

/// What a helmet does beside the steps: looks for loops and corrects the past. Here it is done at
/// once, so that the same input gives the same output.
void correct(std::optional<slam::LoopCloser>& closer, slam::TsdSlam& slam, SlamRun& run) {
  const auto started = std::chrono::steady_clock::now();
  std::vector<slam::Keyframe> keyframes = slam.take_keyframes();
  if (!closer) return;
  for (slam::Keyframe& keyframe : keyframes) {
    if (!closer->take(std::move(keyframe))) continue;
    const auto work_out = [&] { return closer->correction(); };
    run.corrections += slam.apply(closer->keyframes(), work_out) ? 1 : 0;
  }
  run.loop_ms.push_back(milliseconds_since(started));
}

void finish(slam::LoopCloser& closer, slam::TsdSlam& slam, SlamRun& run) {
  if (closer.has_corrected()) {
    const auto work_out = [&] { return *closer.finish(); };
    run.corrections += slam.apply(closer.keyframes(), work_out) ? 1 : 0;
  } else if (auto correction = closer.finish()) {
    run.corrections += slam.apply(*std::move(correction)) ? 1 : 0;
  }
}

Result<SlamRun> play(sensing::ScanSource& source, const sensing::ProjectionConfig& projection,
                     slam::TsdSlam& slam, std::optional<slam::LoopCloser>& closer) {
  SlamRun run;
  sensing::MotionTracker tracker;
  slam::ScanCheck check;
  slam::StageTimes stages;
  slam.time_stages(&stages);
  while (!stop_requested()) {
    auto raw = source.next();
    if (!raw) return forward_error(raw);
    if (!*raw) break;
    stages = {};
    const auto started = std::chrono::steady_clock::now();
    Scan2 scan = sensing::project_scan(**raw, projection);
    const sensing::SensedMotion motion = tracker.next(**raw);
    const slam::ScanFaults faults = check.next(**raw, motion);
    if (faults.frozen) scan.beams.clear();
    stages.predict = std::chrono::steady_clock::now() - started;
    run.note(slam.step(scan, motion, slam::is_doubtful(faults, **raw)));
    run.step_ms.push_back(milliseconds_since(started));
    run.stages.push_back(stages);
    run.bad_scans += faults.any() ? 1 : 0;
    correct(closer, slam, run);
    if ((*raw)->T_world_head_truth) {
      run.truth.push_back({(*raw)->stamp, *(*raw)->T_world_head_truth});
    }
  }
  slam.settle_all();
  correct(closer, slam, run);
  if (closer) {
    finish(*closer, slam, run);
    run.loops = closer->loops();
    closer.reset();  // its keyframes are of no use any more
  }
  slam.time_stages(nullptr);
  run.revisited = slam.revisit();
  slam.smooth_trajectory();
  run.trajectory = slam.trajectory();
  return run;
}

/// {predict: {median, p99}, ...}, in milliseconds, over the scans.
nlohmann::ordered_json stages_ms(const SlamRun& run) {
  nlohmann::ordered_json json;
  const auto add = [&](const char* name, const std::vector<double>& ms) {
    json[name] = {{"median", quantile(ms, 0.5)}, {"p99", quantile(ms, 0.99)}};
  };
  constexpr std::pair<const char*, Duration slam::StageTimes::*> kStages[] = {
      {"predict", &slam::StageTimes::predict},
      {"match", &slam::StageTimes::match},
      {"search", &slam::StageTimes::search},
      {"push", &slam::StageTimes::push},
      {"relocalise", &slam::StageTimes::relocalise}};
  for (const auto& [name, stage] : kStages) {
    std::vector<double> ms;
    for (const slam::StageTimes& times : run.stages) ms.push_back(milliseconds(times.*stage));
    add(name, ms);
  }
  add("loop", run.loop_ms);
  return json;
}

std::string to_json(const SlamRun& run, const std::string& matcher, const TsdGrid& layer) {
  nlohmann::ordered_json json;
  json["matcher"] = matcher;
  json["scans"] = run.trajectory.size();
  json["step_ms_median"] = quantile(run.step_ms, 0.5);
  json["step_ms_p99"] = quantile(run.step_ms, 0.99);
  json["stages_ms"] = stages_ms(run);
  json["peak_rss_mb"] = peak_rss_mb();
  json["failures"] = run.rejected;
  json["weak"] = run.weak;
  json["rejected"] = run.rejected;
  json["searches"] = run.searches;
  json["pushed"] = run.pushed;
  json["undecided"] = run.undecided;
  json["lost_scans"] = run.lost_scans;
  json["relocalisations"] = run.relocalisations;
  json["bad_scans"] = run.bad_scans;
  json["placed_later"] = run.revisited;
  json["loops"] = run.loops;
  json["corrections"] = run.corrections;
  json["longest_correction_ms"] = quantile(run.loop_ms, 1.0);
  json["explored_m2"] = known_area_m2(layer);
  return json.dump(1) + "\n";
}

/// NAME.truth.tum beside NAME.tum.
std::filesystem::path truth_beside(std::filesystem::path trajectory) {
  if (trajectory.extension() == ".tum") trajectory.replace_extension();
  return trajectory += ".truth.tum";
}

Result<void> save_layer(const std::filesystem::path& name, Floor floor, const TsdGrid& layer,
                        const SlamRun& run) {
  const auto id = AgentId::parse("offline");
  if (!id) return forward_error(id);
  std::filesystem::path file = name;
  file += ".lifemap";
  if (auto saved = files::save_map(file, {*id, MapId{1}, floor}, layer, run.trajectory); !saved) {
    return saved;
  }
  const auto occupancy = to_occupancy(layer);
  if (!occupancy) return forward_error(occupancy);
  return files::write_occupancy_image(name, *occupancy);
}

Result<void> write_all(const SlamCommandOptions& options, const proto::AgentConfig& config,
                       const TsdGrid& layer, const SlamRun& run) {
  if (options.trajectory) {
    if (auto written = files::write_tum(*options.trajectory, run.trajectory); !written) {
      return written;
    }
    if (!run.truth.empty()) {
      auto written = files::write_tum(truth_beside(*options.trajectory), run.truth);
      if (!written) return written;
    }
  }
  if (options.map) {
    const Floor floor{static_cast<std::int16_t>(config.floor())};
    if (auto saved = save_layer(*options.map, floor, layer, run); !saved) return saved;
  }
  if (!options.stats) return {};
  return files::write_file_atomically(*options.stats, to_json(run, config.slam().matcher(), layer));
}

Result<void> run_slam(const SlamCommandOptions& options) {
  const auto config = read_agent_config(options.config, options.matcher);
  if (!config) return forward_error(config);
  set_up_log("slam", config->mission().log_level());
  const AgentSettings settings = to_settings(*config);
  std::stop_source stop;
  const auto source = sources::open_source_with_attitude(options.source, options.attitude,
                                                         sources::kUnpaced, stop.get_token());
  if (!source) return forward_error(source);
  slam::TsdSlam slam(settings.slam, settings.geometry);
  // The paper's matchers know no loops.
  std::optional<slam::LoopCloser> closer;
  if (settings.slam.matcher == slam::Matcher::direct) {
    closer.emplace(settings.slam.loops, settings.geometry, settings.slam.push,
                   settings.slam.tracker, settings.slam.direct, settings.slam.search);
  }
  give_back_loaded_pages();
  const std::jthread passing = pass_on_stop_signal(stop);
  const auto run = play(**source, settings.projection, slam, closer);
  if (!run) return forward_error(run);
  if (auto written = write_all(options, *config, slam.layer(), *run); !written) return written;
  if (options.json) {
    fmt::print("{}", to_json(*run, config->slam().matcher(), slam.layer()));
    return {};
  }
  fmt::print("{} scans, {} weak, {} failed; {:.2f} ms a scan (p99 {:.2f}); {:.0f} m2 explored\n",
             run->trajectory.size(), run->weak, run->rejected, quantile(run->step_ms, 0.5),
             quantile(run->step_ms, 0.99), known_area_m2(slam.layer()));
  return {};
}

}  // namespace

int run_slam_command(const SlamCommandOptions& options) {
  watch_stop_signals();
  const auto done = run_slam(options);
  if (done) return 0;
  fmt::print(stderr, "lifeline-agent: {}\n", done.error().text);
  return done.error().code == ErrorCode::wrong_use ? 2 : 1;
}

}  // namespace lifeline
