#pragma once

#include <chrono>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "common/base/ids.hpp"
#include "common/base/time.hpp"
#include "common/sharing/replica_store.hpp"
#include "common/sharing/roster.hpp"
#include "common/wire/messages.hpp"

namespace lifeline::sharing {

struct TileAskerConfig {
  Duration review_interval = std::chrono::milliseconds(250);
  Duration request_interval = std::chrono::milliseconds(50);
  /// A difference is asked about once nothing of the layer has come in for so long: what is on its
  /// way needs no request.
  Duration patience = std::chrono::milliseconds(1500);
  /// Where somebody has at least so many tiles more than we do, we came late, or were away: what
  /// the middleware still has on its way comes in without a pause.
  std::size_t many_tiles = 16;
  Duration patience_for_many = std::chrono::milliseconds(500);
  /// Or once it has lasted so long, whatever comes in; and then as often. A request costs as much
  /// as three tiles, and tiles of who walks about are always on their way.
  Duration long_patience = std::chrono::seconds(30);
  /// After a round without a gain; doubled with each of them. Requests and answers are not repeated
  /// by the middleware: on a bad link most rounds go without.
  Duration first_retry = std::chrono::seconds(1);
  Duration last_retry = std::chrono::seconds(8);
};

/// Finds out from the others' statuses which layers they hold otherwise than we do, and asks for
/// what we lack: the layer's owner while it is heard, else the coordinator, else the helmets by
/// name. A round of requests walks through the whole layer, some tiles each. A state machine:
/// step() never blocks. One owner, not thread-safe.
class TileAsker {
 public:
  /// `own_layer`: what this participant itself publishes and hence never asks for.
  TileAsker(AgentId self, std::optional<LayerKey> own_layer, TileAskerConfig config = {});

  /// The next request, if one is due; its envelope is empty.
  [[nodiscard]] std::optional<wire::TileRequest> step(SteadyTime now, const Roster& roster,
                                                      const ReplicaStore& store);

  /// Layers of which somebody who should know holds something else than we do, for longer than a
  /// tile is under way.
  [[nodiscard]] std::size_t layers_behind(SteadyTime now) const;

 private:
  struct Want {
    SteadyTime since{};                 ///< the difference
    SteadyTime gained_at{};             ///< when the layer last changed here
    RevisionDigest held{};              ///< our digest at the last review
    std::vector<std::string> able;      ///< who may have what we lack, best first
    bool lacks_many = false;            ///< whole tiles, TileAskerConfig::many_tiles at least
    unsigned rounds = 0;                ///< without a gain
    SteadyTime round_due{};             ///< if nothing comes in
    SteadyTime asked_at{};              ///< when the last round began
    std::string asked_id;               ///< in this round
    std::optional<TileIndex> asked_to;  ///< how far this round has come; empty between rounds
  };

  void review(SteadyTime now, const Roster& roster, const ReplicaStore& store);
  struct Difference {
    RevisionDigest held;            ///< our own digest
    std::vector<std::string> able;  ///< as Want::able
    bool lacks_many = false;
  };
  [[nodiscard]] std::map<LayerKey, Difference> differences(SteadyTime now, const Roster& roster,
                                                           const ReplicaStore& store) const;
  [[nodiscard]] bool is_due(const Want& want, SteadyTime now) const;
  [[nodiscard]] wire::TileRequest next_window(const LayerKey& layer, Want& want, SteadyTime now,
                                              const ReplicaStore& store) const;

  AgentId self_;
  std::optional<LayerKey> own_layer_;
  TileAskerConfig config_;
  std::map<LayerKey, Want> wants_;
  SteadyTime review_due_{}, request_due_{};
};

}  // namespace lifeline::sharing
