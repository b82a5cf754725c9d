#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "common/sharing/envelope_stamper.hpp"
#include "common/sharing/fused_map.hpp"
#include "common/sharing/roster.hpp"
#include "common/wire/channel.hpp"
#include "coordinator/layer_watch.hpp"
#include "coordinator/match_worker.hpp"
#include "coordinator/merging/directive_writer.hpp"
#include "coordinator/merging/merge_keeper.hpp"

namespace lifeline {

/// The coordinator's ends of the topics.
struct CoordinatorChannels {
  std::unique_ptr<wire::Inbox<wire::TsdTile>> tiles;
  std::unique_ptr<wire::Inbox<wire::HelmetPose>> poses;
  std::unique_ptr<wire::Inbox<wire::AgentStatus>> statuses;
  std::unique_ptr<wire::Outbox<wire::MergeDirective>> directive;
  std::unique_ptr<wire::Outbox<wire::MergeEvidence>> evidence;
  std::unique_ptr<wire::Outbox<wire::AgentStatus>> status;
  /// Octets that left this process so far, as the middleware counts them.
  std::function<std::uint64_t()> bytes_sent;
};

struct CoordinatorSettings {
  sharing::Speaker speaker;
  GridGeometry geometry;
  merging::MergeScheduleConfig schedule;
  merging::DirectiveConfig directive;
};

/// A pair's newest match, and when it was made.
struct MergeRecord {
  merging::LayerPair pair;
  matching::MatchResult result;  ///< verdict and reason as the merge graph sees them
  Duration at{};                 ///< since the coordinator's start, of the newest view
  bool in_directive = false;     ///< the pair is merged by its own match
};

/// The command vehicle: replicas of all layers, matching of pairs, the merge directive and the
/// common map. A state machine: step() does whatever is due and never blocks. One owner, not
/// thread-safe.
class Coordinator {
 public:
  using Path =
      std::vector<Eigen::Vector2d>;  ///< positions in the layer's map frame, at least 5 cm apart

  Coordinator(CoordinatorSettings settings, CoordinatorChannels channels, MatchWorker& worker,
              const Clock& clock);

  void step();

  [[nodiscard]] const sharing::Roster& roster() const { return roster_; }
  [[nodiscard]] const sharing::ReplicaStore& store() const { return store_; }
  [[nodiscard]] const std::map<LayerKey, Path>& paths() const { return paths_; }
  [[nodiscard]] const wire::MergeDirective& directive() const { return writer_.directive(); }
  /// The map of the largest group, in its common frame.
  [[nodiscard]] const sharing::FusedMap& common_map() const { return common_map_; }
  /// The newest match of every pair, and every accepted one so far in order of time.
  [[nodiscard]] const std::map<merging::LayerPair, MergeRecord>& newest_matches() const {
    return newest_;
  }
  [[nodiscard]] const std::vector<MergeRecord>& accepted_matches() const { return accepted_; }
  /// Who belongs together and which accepted matches are not followed, with the reason.
  [[nodiscard]] const merging::MergePlan& plan() const { return keeper_.plan(); }
  /// Nothing to match now: no pair is due, none is being matched.
  [[nodiscard]] bool idle() const;
  [[nodiscard]] wire::AgentStatus status() const;

 private:
  struct Watched {
    LayerWatch walls;
    std::size_t counted = 0;  ///< the change up to which known cells were counted
    SteadyTime changed_at;
  };

  void hear_tiles();
  void note_changes(SteadyTime now);
  void hear_poses();
  void hear_statuses(SteadyTime now);
  void count_known_cells(SteadyTime now);
  void match_next();
  void take_outcome(SteadyTime now);
  /// Records and publishes what has become of a pair.
  void tell(const merging::PairNews& news, SteadyTime now);
  /// Writes a new directive where the plan asks for one; what it changes, for people.
  std::string follow_plan(Timestamp wall_now);
  void send_directive(Timestamp wall_now);
  void refuse(const std::string& topic, const Error& error);
  [[nodiscard]] std::vector<merging::LayerProgress> progress() const;

  CoordinatorSettings settings_;
  CoordinatorChannels channels_;
  MatchWorker& worker_;
  const Clock& clock_;
  SteadyTime started_;
  sharing::ReplicaStore store_;
  sharing::FusedMap common_map_;
  sharing::Roster roster_;
  merging::MergeSchedule schedule_;
  merging::MergeKeeper keeper_;
  merging::DirectiveWriter writer_;
  std::map<LayerKey, merging::LayerProgress> progress_;
  std::map<LayerKey, Watched> watched_;
  std::map<LayerKey, Path> paths_;
  std::map<merging::LayerPair, MergeRecord> newest_;
  std::vector<MergeRecord> accepted_;
  sharing::EnvelopeStamper directive_stamper_, evidence_stamper_, status_stamper_;
  SteadyTime status_due_{}, count_due_{};
  std::uint64_t refused_ = 0;
};

}  // namespace lifeline
