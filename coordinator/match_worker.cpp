#include "coordinator/match_worker.hpp"

#include <chrono>
#include <utility>

#include "common/base/check.hpp"

namespace lifeline {

MatchOutcome Matcher::match(const MatchJob& job) {
  const auto a = features_of(job.a, job.layer_a, job.geometry);
  const auto b = features_of(job.b, job.layer_b, job.geometry);
  if (!a || !b) {
    matching::MatchResult refused;
    refused.verdict = matching::Verdict::rejected;
    refused.reason = a ? b.error().text : a.error().text;
    return {job.a, job.b, refused};
  }
  return {job.a, job.b, matching::match_maps(**a, **b, config_)};
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
