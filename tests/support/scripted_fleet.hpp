#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "agents/sharing/helmet_sharing.hpp"
#include "common/wire/loopback.hpp"
#include "coordinator/coordinator.hpp"

namespace lifeline::test {

/// A helmet whose layer a test draws: the real sharing half, and no SLAM.
class ScriptedHelmet {
 public:
  ScriptedHelmet(const std::string& id, wire::LoopbackBus& bus, const Clock& clock);

  /// From now on this is the layer: every tile that differs is published, one that is gone as
  /// unknown.
  void show(const TsdGrid& layer);
  /// It maps no more.
  void finish() { finished_ = true; }
  void step();

  [[nodiscard]] const sharing::HelmetSharing& sharing() const { return sharing_; }
  [[nodiscard]] bool finished() const { return finished_; }

 private:
  sharing::HelmetSharing sharing_;
  std::map<TileIndex, std::shared_ptr<const QuantisedTile>> shown_;
  bool finished_ = false;
};

/// Scripted helmets and a real coordinator on one bus and one hand-driven clock.
class ScriptedFleet {
 public:
  /// Helmets by their ids. `worker` matches for the coordinator; the real matcher where it is null.
  explicit ScriptedFleet(const std::vector<std::string>& ids,
                         CoordinatorSettings settings = default_settings(),
                         std::unique_ptr<MatchWorker> worker = nullptr);

  /// Steps everybody each 100 ms of the clock.
  void run(Duration duration);

  [[nodiscard]] ScriptedHelmet& helmet(const std::string& id) { return *helmets_.at(id); }
  [[nodiscard]] const Coordinator& coordinator() const { return *coordinator_; }
  [[nodiscard]] wire::LoopbackBus& bus() { return bus_; }
  [[nodiscard]] const Clock& clock() const { return clock_; }

  /// All directives and evidence sent so far, in order.
  [[nodiscard]] const std::vector<wire::MergeDirective>& directives() const { return directives_; }
  [[nodiscard]] const std::vector<wire::MergeEvidence>& evidence() const { return evidence_; }
  /// The newest evidence of two helmets' maps, as text; empty without any.
  [[nodiscard]] std::string reason(const std::string& a, const std::string& b) const;

  /// Members of the newest directive's largest group, by id.
  [[nodiscard]] std::vector<std::string> group() const;
  /// Where the newest directive lays b on a; both must be in one group.
  [[nodiscard]] Pose2 T_a_b(const std::string& a, const std::string& b) const;
  /// The map that the coordinator and all these helmets hold, in hexadecimal; "differ" where they
  /// do not hold the same.
  [[nodiscard]] std::string common_hash(const std::vector<std::string>& ids) const;

  [[nodiscard]] static CoordinatorSettings default_settings();

 private:
  ManualClock clock_;
  wire::LoopbackBus bus_;
  std::unique_ptr<MatchWorker> worker_;
  std::map<std::string, std::unique_ptr<ScriptedHelmet>> helmets_;
  std::unique_ptr<Coordinator> coordinator_;
  std::unique_ptr<wire::Inbox<wire::MergeDirective>> directive_inbox_;
  std::unique_ptr<wire::Inbox<wire::MergeEvidence>> evidence_inbox_;
  std::vector<wire::MergeDirective> directives_;
  std::vector<wire::MergeEvidence> evidence_;
};

}  // namespace lifeline::test
