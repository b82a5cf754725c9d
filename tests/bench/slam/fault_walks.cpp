#include "tests/bench/slam/fault_walks.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <memory>
#include <utility>

#include <fmt/format.h>

#include "agents/sensing/head_projection.hpp"
#include "agents/sensing/motion_tracker.hpp"
#include "agents/slam/scan_check.hpp"
#include "agents/slam/tsd_slam.hpp"
#include "common/base/quantile.hpp"

namespace lifeline::bench {
namespace {

using sensing::RawScan;

/// Found again further off than this is found wrongly.
constexpr double kWrongM = 0.3;
/// A helmet that was killed has to be back by then.
constexpr double kBackS = 10.0;

struct FaultFigures {
  bool lost = false;
  bool found = false;
  double waited_s = 0.0;         ///< from the end of the fault
  std::optional<double> back_s;  ///< from there until a scan was matched and used
  int wrong = 0;
  double worst_m = 0.0;  ///< while it did not say that it was lost, from the fault on
  int pushed_lost = 0;
  std::vector<double> search_ms;
};

class FaultyHelmet {
 public:
  FaultyHelmet() { slam_->time_stages(&times_); }

  slam::SlamStep step(const RawScan& raw) {
    Scan2 scan = sensing::project_scan(raw, {});
    const sensing::SensedMotion motion = motion_.next(raw);
    const slam::ScanFaults faults = check_.next(raw, motion);
    if (faults.frozen) scan.beams.clear();
    times_ = {};
    return slam_->step(scan, motion, faults.any());
  }
  void restart(std::optional<slam::LastPlace> last) {
    TsdGrid layer(slam_->layer().geometry());
    for (const TileIndex tile : slam_->layer().tiles()) layer.at(tile) = *slam_->layer().find(tile);
    slam_ = make();
    slam_->resume(std::move(layer), last);
    slam_->time_stages(&times_);
    motion_ = {};
    check_ = slam::ScanCheck{};
  }
  [[nodiscard]] double relocalise_ms() const { return 1e3 * to_seconds(times_.relocalise); }

 private:
  /// As a running helmet has it.
  static std::unique_ptr<slam::TsdSlam> make() {
    slam::SlamConfig config;
    config.stories.max_stories = 1;
    return std::make_unique<slam::TsdSlam>(config, GridGeometry{});
  }
  std::unique_ptr<slam::TsdSlam> slam_ = make();
  sensing::MotionTracker motion_;
  slam::ScanCheck check_;
  slam::StageTimes times_;
};

FaultFigures play(const Fault& fault, const std::vector<RawScan>& walk) {
  FaultFigures figures;
  FaultyHelmet helmet;
  Pose2 T_map_world = walk.front().T_world_head_truth->inverse();
  const std::size_t first = walk.size() / 2;
  const std::size_t end = std::min(first + static_cast<std::size_t>(fault.scans), walk.size() - 1);
  slam::LastPlace last;
  for (std::size_t k = 0; k < walk.size(); ++k) {
    RawScan raw = walk[k];
    if (k >= first && k < end) fault.spoil(raw, static_cast<int>(k - first));
    if (fault.away && k >= first && k < end) continue;
    if (k == end && fault.restarts) {
      helmet.restart(fault.away ? std::optional(last) : std::nullopt);
    }
    const slam::SlamStep step = helmet.step(raw);
    if (k < first) {
      // What comes after is judged in the map as it is by then, drift and all.
      T_map_world = step.T_map_head * walk[k].T_world_head_truth->inverse();
      last.T_map_head = step.T_map_head;
      last.ago = walk[end].stamp - walk[k].stamp;
      continue;
    }
    const Pose2 truth = T_map_world * *walk[k].T_world_head_truth;
    const double off_m = (truth.translation() - step.T_map_head.translation()).norm();
    if (step.lost) figures.search_ms.push_back(helmet.relocalise_ms());
    if (step.lost) figures.pushed_lost += figures.lost ? step.pushed : 0;
    figures.lost = figures.lost || step.lost;
    if (step.source == slam::PoseSource::relocalised) {
      if (!figures.found) figures.waited_s = to_seconds(walk[k].stamp - walk[end].stamp);
      figures.found = true;
      figures.wrong += off_m > kWrongM ? 1 : 0;
    }
    // A helmet that dead reckons says so by its trust; what it uses as its place must be right.
    if (!step.lost && step.verdict == slam::Verdict::accepted) {
      figures.worst_m = std::max(figures.worst_m, off_m);
      if (k >= end && !figures.back_s) figures.back_s = to_seconds(walk[k].stamp - walk[end].stamp);
    }
  }
  return figures;
}

void thin_to(RawScan& raw, std::size_t every) {
  for (std::size_t i = 0; i < raw.ranges_m.size(); ++i) {
    if (i % every != 0) raw.ranges_m[i] = 0.0F;
  }
}

/// As in the mirror image of the building, which the map does not know.
void mirror(RawScan& raw) {
  std::reverse(raw.ranges_m.begin(), raw.ranges_m.end());
  const auto turn_over = [](sensing::Attitude& attitude) {
    attitude.roll_rad = -attitude.roll_rad;
    attitude.yaw_rad = -attitude.yaw_rad;
  };
  if (raw.attitude) turn_over(*raw.attitude);
  for (sensing::TimedAttitude& later : raw.later_attitudes) turn_over(later.attitude);
}

Fault filled(const char* name, float with) {
  return {.name = name,
          .scans = 10,
          .spoil = [with](RawScan& raw,
                          int) { std::fill(raw.ranges_m.begin(), raw.ranges_m.end(), with); },
          .loses = false};
}

ReportRow back_row(const std::string& name, const std::vector<FaultFigures>& all) {
  const auto in_time = std::count_if(all.begin(), all.end(), [](const FaultFigures& figures) {
    return figures.back_s.value_or(kBackS + 1.0) <= kBackS;
  });
  return {fmt::format("{}: back within {:.0f} s", name, kBackS), static_cast<double>(in_time),
          fmt::format("of {}", all.size()),
          Bar{Bar::Side::at_least, static_cast<double>(all.size())}};
}

}  // namespace

std::vector<Fault> all_faults() {
  const auto cover = [](RawScan& raw, int) {
    std::fill(raw.ranges_m.begin(), raw.ranges_m.end(), 0.0F);
  };
  const auto carry = [cover](RawScan& raw, int i) {
    cover(raw, i);
    raw.attitude.reset();
  };
  std::vector<Fault> faults;
  faults.push_back({.name = "covered for 10 s", .scans = 100, .spoil = cover});
  faults.push_back({.name = "carried for 10 s, heading unknown", .scans = 100, .spoil = carry});
  const auto carry_away = [carry](RawScan& raw, int i) {
    constexpr int kCarried = 100;
    if (i < kCarried) return carry(raw, i);
    mirror(raw);
  };
  faults.push_back({.name = "carried out of its map, heading unknown",
                    .scans = std::numeric_limits<int>::max(),
                    .spoil = carry_away});
  faults.push_back({.name = "restarted in its map", .scans = 0, .spoil = cover, .restarts = true});
  for (const int away_s : {1, 3, 6}) {
    faults.push_back({.name = fmt::format("walked on while it restarted for {} s", away_s),
                      .scans = 10 * away_s,
                      .spoil = [](RawScan&, int) {},
                      .restarts = true,
                      .away = true});
  }
  faults.push_back(filled("1 s all invalid", 0.0F));
  faults.push_back(filled("1 s of NaN", std::numeric_limits<float>::quiet_NaN()));
  faults.push_back(filled("1 s of +inf", std::numeric_limits<float>::infinity()));
  faults.push_back({.name = "2 s 80 % invalid",
                    .scans = 20,
                    .spoil = [](RawScan& raw, int) { thin_to(raw, 5); },
                    .loses = false});
  faults.push_back({.name = "1 s one beam",
                    .scans = 10,
                    .spoil = [](RawScan& raw, int) { raw.ranges_m.resize(1); },
                    .loses = false});
  faults.push_back({.name = "1.5 s frozen",
                    .scans = 15,
                    .spoil =
                        [frozen = std::vector<float>()](RawScan& raw, int i) mutable {
                          if (i == 0) frozen = raw.ranges_m;
                          raw.ranges_m = frozen;
                        },
                    .loses = false});
  faults.push_back({.name = "time going back 5 s",
                    .scans = 1,
                    .spoil = [](RawScan& raw, int) { raw.stamp -= std::chrono::seconds(5); },
                    .loses = false});
  faults.push_back({.name = "half the beams for 1 s",
                    .scans = 10,
                    .spoil =
                        [](RawScan& raw, int) {
                          std::vector<float> half;
                          for (std::size_t j = 0; j < raw.ranges_m.size(); j += 2) {
                            half.push_back(raw.ranges_m[j]);
                          }
                          raw.ranges_m = std::move(half);
                          raw.angle_step_rad *= 2.0;
                        },
                    .loses = false});
  return faults;
}

std::vector<ReportRow> fault_rows(const Fault& fault,
                                  const std::vector<std::vector<RawScan>>& walks) {
  std::vector<FaultFigures> all;
  for (const auto& walk : walks) all.push_back(play(fault, walk));
  const std::string name = "faults, " + fault.name;
  const Bar none{Bar::Side::at_most, 0.0};
  int lost = 0, found = 0, wrong = 0, pushed = 0;
  std::vector<double> waited_s, worst_m, search_ms;
  for (const FaultFigures& figures : all) {
    lost += figures.lost ? 1 : 0;
    found += figures.found ? 1 : 0;
    wrong += figures.wrong;
    pushed += figures.pushed_lost;
    worst_m.push_back(figures.worst_m);
    if (figures.found) waited_s.push_back(figures.waited_s);
    search_ms.insert(search_ms.end(), figures.search_ms.begin(), figures.search_ms.end());
  }
  std::vector<ReportRow> rows{
      {name + ": worst place believed, worst walk", quantile(worst_m, 1.0), "m",
       Bar{Bar::Side::at_most, 0.5}},
      {name + ": places found wrongly", static_cast<double>(wrong), "", none},
      {name + ": pushed while lost", static_cast<double>(pushed), "", none}};
  if (fault.away) rows.push_back(back_row(name, all));
  if (lost == 0 && !fault.loses) return rows;
  rows.push_back({name + ": lost", static_cast<double>(lost), fmt::format("of {}", walks.size())});
  rows.push_back({name + ": found again", static_cast<double>(found), fmt::format("of {}", lost)});
  rows.push_back({name + ": found after, median", quantile(waited_s, 0.5), "s"});
  rows.push_back(
      {name + ": search, p99", quantile(search_ms, 0.99), "ms", Bar{Bar::Side::at_most, 30.0}});
  return rows;
}

}  // namespace lifeline::bench
