#pragma once

#include <cstddef>
#include <map>
#include <memory>
#include <optional>
#include <thread>

#include "common/base/bounded_queue.hpp"
#include "common/sharing/replica_store.hpp"
#include "coordinator/matching/match_maps.hpp"
#include "coordinator/merging/edge_support.hpp"
#include "coordinator/merging/merge_schedule.hpp"

namespace lifeline {

/// Two layers as they stood when the match was asked for; cells are shared, not copied.
struct MatchJob {
  merging::LayerProgress a, b;
  sharing::ReplicaLayer layer_a, layer_b;
  GridGeometry geometry;
  std::optional<Pose2> check_T_a_b{};  ///< a place to look at besides, whatever the match finds
};

struct MatchOutcome {
  merging::LayerProgress a, b;
  matching::MatchResult result;
  std::optional<merging::PlaceCheck>
      check{};  ///< where one was asked for and both maps can be read
};

/// Matches pairs of layers and keeps each layer's features until the layer changes. Not
/// thread-safe.
class Matcher {
 public:
  explicit Matcher(matching::MatchConfig config) : config_(config) {}
  [[nodiscard]] MatchOutcome match(const MatchJob& job);

 private:
  using Features = Result<std::shared_ptr<const matching::MapFeatures>>;
  struct Cached {
    std::size_t changes = 0;
    std::shared_ptr<const matching::MapFeatures> features;
  };
  Features features_of(const merging::LayerProgress& progress, const sharing::ReplicaLayer& layer,
                       const GridGeometry& geometry);
  matching::MatchConfig config_;
  std::map<LayerKey, Cached> cache_;
};

/// Where the coordinator has its pairs matched: at once in tests, on a thread of its own in the
/// program.
class MatchWorker {
 public:
  virtual ~MatchWorker() = default;
  /// Only when not busy.
  virtual void submit(MatchJob job) = 0;
  [[nodiscard]] virtual std::optional<MatchOutcome> take() = 0;
  /// A job was submitted whose outcome was not taken yet.
  [[nodiscard]] virtual bool busy() const = 0;
};

class InlineMatchWorker final : public MatchWorker {
 public:
  explicit InlineMatchWorker(matching::MatchConfig config) : matcher_(config) {}
  void submit(MatchJob job) override { outcome_ = matcher_.match(job); }
  [[nodiscard]] std::optional<MatchOutcome> take() override { return std::exchange(outcome_, {}); }
  [[nodiscard]] bool busy() const override { return outcome_.has_value(); }

 private:
  Matcher matcher_;
  std::optional<MatchOutcome> outcome_;
};

class ThreadedMatchWorker final : public MatchWorker {
 public:
  explicit ThreadedMatchWorker(matching::MatchConfig config);
  ~ThreadedMatchWorker() override;
  void submit(MatchJob job) override;
  [[nodiscard]] std::optional<MatchOutcome> take() override;
  [[nodiscard]] bool busy() const override { return pending_; }

 private:
  Matcher matcher_;  // used by the thread alone
  BoundedQueue<MatchJob> jobs_{1, Overflow::wait};
  BoundedQueue<MatchOutcome> outcomes_{1, Overflow::wait};
  bool pending_ = false;
  std::jthread thread_;  // last: joined before what it uses goes away
};

}  // namespace lifeline
