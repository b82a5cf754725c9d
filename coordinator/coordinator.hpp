#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "common/sharing/alert_exchange.hpp"
#include "common/sharing/detection_list.hpp"
#include "common/sharing/envelope_stamper.hpp"
#include "common/sharing/fused_map.hpp"
#include "common/sharing/fusing_pace.hpp"
#include "common/sharing/kept_layers.hpp"
#include "common/sharing/one_way_watch.hpp"
#include "common/sharing/pose_watch.hpp"
#include "common/sharing/recording_status.hpp"
#include "common/sharing/roster.hpp"
#include "common/sharing/tile_exchange.hpp"
#include "common/wire/channel.hpp"
#include "coordinator/layer_watch.hpp"
#include "coordinator/leadership.hpp"
#include "coordinator/match_worker.hpp"
#include "coordinator/merging/directive_writer.hpp"
#include "coordinator/merging/merge_keeper.hpp"

namespace lifeline {

/// The coordinator's ends of the topics.
struct CoordinatorChannels {
  std::unique_ptr<wire::Inbox<wire::TsdTile>> tiles;
  std::unique_ptr<wire::Inbox<wire::HelmetPose>> poses;
  std::unique_ptr<wire::Inbox<wire::AgentStatus>> statuses;
  std::unique_ptr<wire::Inbox<wire::Detection>> detections;
  std::unique_ptr<wire::Outbox<wire::MergeDirective>> directive;
  std::unique_ptr<wire::Outbox<wire::MergeEvidence>> evidence;
  std::unique_ptr<wire::Outbox<wire::AgentStatus>> status;
  sharing::ExchangeChannels exchange;
  /// Octets that left this process so far, as the middleware counts them.
  std::function<std::uint64_t()> bytes_sent;
  /// Octets on the network so far, everything included: what the budget is held by.
  std::function<std::uint64_t()> octets_on_air;
  /// What other coordinators direct; heard only while none of our own is open (the topic's
  /// ownership is exclusive). Without it nobody is followed.
  std::unique_ptr<wire::Inbox<wire::MergeDirective>> directives{};
  /// Opens `directive`, once this coordinator leads, if it is not open from the start.
  std::function<Result<std::unique_ptr<wire::Outbox<wire::MergeDirective>>>()> open_directive{};
  /// Asked for the status, where there is a recording.
  std::function<sharing::RecordingStatus()> recording{};
  /// Alerts of all, and by what the commander speaks. Without them nobody is alarmed.
  std::unique_ptr<wire::Inbox<wire::Alert>> alerts{};
  std::unique_ptr<wire::Outbox<wire::Alert>> alert{};
  std::unique_ptr<wire::Outbox<wire::Detection>> ruling{};
};

/// What a coordinator knew before it was restarted.
struct CoordinatorMemory {
  sharing::KeptLayers layers;
  std::optional<wire::MergeDirective> directive;
  merging::EdgeMap edges;
  std::set<merging::LayerPair> parted_by_hand{};
  std::vector<wire::Alert> alerts{};  ///< what it raised
};

struct CoordinatorSettings {
  sharing::Speaker speaker;
  GridGeometry geometry;
  merging::MergeScheduleConfig schedule;
  merging::DirectiveConfig directive;
  double budget_bit_s = 4'000'000;  ///< of everything that it sends, to all receivers together
  LeadershipConfig leadership{};
  bool only_listens = false;  ///< what it sends reaches nobody, as in a replay
  /// The common map is that of this layer's group, as in a replay of what a helmet recorded; the
  /// largest group's without.
  std::optional<LayerKey> seen_by{};
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
      std::vector<Eigen::Vector2d>;  ///< positions in the layer's map frame, kPathStepM apart
  static constexpr double kPathStepM = 0.05;

  Coordinator(CoordinatorSettings settings, CoordinatorChannels channels, MatchWorker& worker,
              const Clock& clock);

  /// Goes on where a process before this one was stopped. Before the first step(). bad_data where
  /// the memory contradicts itself.
  [[nodiscard]] Result<void> resume(const CoordinatorMemory& memory);
  /// Hears of each tile that is taken in, to keep it.
  void set_tile_listener(sharing::ReplicaStore::Listener listener) {
    store_.set_listener(std::move(listener));
  }

  /// Hears of each tile of the common map whose cells changed or that vanished. Before the first
  /// step().
  using MapListener = std::function<void(TileIndex)>;
  void set_map_listener(MapListener listener) { map_listener_ = std::move(listener); }

  void step();
  /// After the last step(): brings the common map up to date, which a busy machine may be behind
  /// with.
  void finish();

  // What the commander decides (coordinator_orders.cpp). Each answers an error, for people, where
  // it cannot be done.

  /// A find is there (`confirmed`), is none (`dismissed`), or that is taken back (`reported`).
  [[nodiscard]] Result<void> rule(const sharing::DetectionKey& detection,
                                  wire::DetectionState state);
  /// Whatever their matches say, these two are not merged with each other; or they are, where their
  /// newest match laid them.
  [[nodiscard]] Result<void> part(const merging::LayerPair& pair);
  [[nodiscard]] Result<void> merge(const merging::LayerPair& pair);
  /// Alarms everybody, or one helmet (`subject_id`).
  [[nodiscard]] Result<void> raise(wire::AlertKind kind, const std::string& subject_id,
                                   const std::string& text);
  /// The commander has seen it (`acknowledged`), or it is over (`cleared`).
  [[nodiscard]] Result<void> answer(const sharing::AlertKey& alert, wire::AlertState state);

  /// Whether this coordinator's directive is the one that is written.
  [[nodiscard]] bool leads() const { return channels_.directive != nullptr; }
  [[nodiscard]] const merging::EdgeMap& merges() const { return keeper_.graph().edges(); }
  [[nodiscard]] const sharing::Roster& roster() const { return roster_; }
  [[nodiscard]] const sharing::ReplicaStore& store() const { return store_; }
  /// Everybody's finds, each once.
  [[nodiscard]] std::vector<sharing::FleetDetection> detections() const {
    return detections_.list();
  }
  [[nodiscard]] const std::map<LayerKey, Path>& paths() const { return paths_; }
  /// Where everybody was last heard to be.
  [[nodiscard]] const sharing::PoseWatch& poses() const { return poses_; }
  [[nodiscard]] const sharing::AlertList& alerts() const { return alerts_.list(); }
  /// What it raised itself, to be kept through a restart.
  [[nodiscard]] std::vector<wire::Alert> own_alerts() const { return alerts_.own(); }
  [[nodiscard]] const std::set<merging::LayerPair>& parted_by_hand() const {
    return keeper_.parted_by_hand();
  }
  [[nodiscard]] const sharing::Speaker& speaker() const { return settings_.speaker; }
  /// Times for people count from the coordinator's start.
  [[nodiscard]] Duration since_start(SteadyTime time) const { return time - started_; }
  [[nodiscard]] const wire::MergeDirective& directive() const { return writer_.directive(); }
  /// The map of the largest group (or of `seen_by`'s), in its common frame.
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

  void hear_directives();
  /// Follows what another coordinator directs, if it is newer.
  void take_over(const wire::MergeDirective& directive);
  void take_part(SteadyTime now);
  void begin_to_lead(SteadyTime now);
  void give_way();
  /// Says the directive again where `status` shows that its sender does not follow it.
  void keep_followed(const wire::AgentStatus& status, SteadyTime now);
  /// Whether its sender follows another directive of our epoch, as far as their maps tell.
  [[nodiscard]] bool follows_another(const wire::AgentStatus& theirs) const;
  void note_epoch(const wire::AgentStatus& status, SteadyTime now);
  void stay_heard(SteadyTime now);
  /// Not yet: others follow an answer that is not known here, and ours would be a part of it.
  [[nodiscard]] bool holds_back(SteadyTime now);
  void update_common_map();
  void note_changes(SteadyTime now);
  void hear_poses();
  void hear_statuses(SteadyTime now);
  void count_known_cells(SteadyTime now);
  void match_next();
  void take_outcome(SteadyTime now);
  void hear_detections(SteadyTime now);
  /// After a person changed the graph.
  void follow_hand(const std::vector<merging::PairNews>& news);
  /// Records and publishes what has become of a pair.
  void tell(const merging::PairNews& news, SteadyTime now);
  /// Writes a new directive where the plan asks for one; what it changes, for people.
  std::string follow_plan(SteadyTime now);
  void send_directive(SteadyTime now);
  void place_common_map();
  [[nodiscard]] std::vector<merging::LayerProgress> progress() const;

  CoordinatorSettings settings_;
  CoordinatorChannels channels_;
  MatchWorker& worker_;
  const Clock& clock_;
  SteadyTime started_;
  sharing::ReplicaStore store_;
  sharing::FusedMap common_map_;
  sharing::FusingPace fusing_;
  sharing::DetectionList detections_;
  sharing::Roster roster_;
  sharing::OneWayWatch one_way_;
  sharing::LinkBudget link_;
  sharing::TileExchange exchange_;
  merging::MergeSchedule schedule_;
  merging::MergeKeeper keeper_;
  merging::DirectiveWriter writer_;
  Leadership leadership_;
  Epoch heard_epoch_{};
  std::optional<wire::MergeDirective> heard_while_leading_;
  std::map<std::string, SteadyTime> contradicted_since_;  ///< by whom, while we lead
  wire::AgentStatus said_;                                ///< the last own status
  std::optional<SteadyTime> led_since_;                   ///< while it holds back
  SteadyTime assert_due_{};
  std::map<LayerKey, merging::LayerProgress> progress_;
  std::map<LayerKey, Watched> watched_;
  std::map<LayerKey, Path> paths_;
  std::map<merging::LayerPair, MergeRecord> newest_;
  std::vector<MergeRecord> accepted_;
  sharing::PoseWatch poses_;
  sharing::AlertExchange alerts_;
  MapListener map_listener_;
  sharing::EnvelopeStamper directive_stamper_, evidence_stamper_, status_stamper_;
  sharing::EnvelopeStamper ruling_stamper_;
  SteadyTime status_due_{}, count_due_{};
  /// When the directive was last sent, for the first time or again.
  SteadyTime directive_sent_at_{};
  sharing::HearingNotes notes_;
};

}  // namespace lifeline
