#include "coordinator/match_worker.hpp"

#include <chrono>
#include <utility>

#include "common/base/check.hpp"
#include "coordinator/matching/candidate.hpp"
#include "coordinator/matching/compare_walls.hpp"

namespace lifeline {
namespace {

merging::PlaceCheck check_place(const matching::MapFeatures& a, const matching::MapFeatures& b,
                                const Pose2& T_a_b, const matching::MatchConfig& config) {
  const Pose2 T_a_b_local = matching::to_local_frames(a, b, T_a_b);
  const auto measured = matching::measure_candidate(a, b, T_a_b_local, config);
  const auto& figures = measured.candidate;
  merging::PlaceCheck check{
      figures, measured.overlap_centre_b_m,
      (figures.agreeing_wall_m - figures.score) / matching::kConflictWeight,
      0.5 * (matching::displaced_conflict_m(b.walls, T_a_b_local, a) +
             matching::displaced_conflict_m(a.walls, T_a_b_local.inverse(), b))};
  check.figures.T_a_b = T_a_b;
  return check;
}

}  // namespace

MatchOutcome Matcher::match(const MatchJob& job) {
  const auto a = features_of(job.a, job.layer_a, job.geometry);
  const auto b = features_of(job.b, job.layer_b, job.geometry);
  if (!a || !b) {
    matching::MatchResult refused;
    refused.verdict = matching::Verdict::rejected;
    refused.reason = a ? b.error().text : a.error().text;
    return {job.a, job.b, refused, {}};
  }
  MatchOutcome outcome{job.a, job.b, matching::match_maps(**a, **b, config_), {}};
  if (job.check_T_a_b) outcome.check = check_place(**a, **b, *job.check_T_a_b, config_);
  return outcome;
}

Matcher::Features Matcher::features_of(const merging::LayerProgress& progress,
                                       const sharing::ReplicaLayer& layer,
                                       const GridGeometry& geometry) {
  Cached& cached = cache_[progress.layer];
  if (cached.features != nullptr && cached.changes == progress.changes) return cached.features;
  auto built = matching::build_features(sharing::to_grid(layer, geometry));
  if (!built) return forward_error(built);
  cached = {progress.changes, std::make_shared<const matching::MapFeatures>(*std::move(built))};
  return cached.features;
}

ThreadedMatchWorker::ThreadedMatchWorker(matching::MatchConfig config)
    : matcher_(config), thread_([this](const std::stop_token& stop) {
        while (!stop.stop_requested()) {
          if (auto job = jobs_.pop(std::chrono::milliseconds(100)))
            outcomes_.push(matcher_.match(*job));
        }
      }) {}

ThreadedMatchWorker::~ThreadedMatchWorker() {
  jobs_.close();
  outcomes_.close();
}

void ThreadedMatchWorker::submit(MatchJob job) {
  LIFELINE_CHECK(!pending_);
  pending_ = true;
  jobs_.push(std::move(job));
}

std::optional<MatchOutcome> ThreadedMatchWorker::take() {
  auto outcome = outcomes_.pop(Duration::zero());
  if (outcome) pending_ = false;
  return outcome;
}

}  // namespace lifeline
