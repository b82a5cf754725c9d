#pragma once

#include <memory>
#include <optional>

#include "common/sharing/hear.hpp"
#include "common/sharing/tile_asker.hpp"
#include "common/sharing/tile_server.hpp"

namespace lifeline::sharing {

/// A participant's ends of the two topics by which missing tiles are asked for and sent again.
struct ExchangeChannels {
  std::unique_ptr<wire::Outbox<wire::TileRequest>> ask;
  std::unique_ptr<wire::Inbox<wire::TileRequest>> asked;
  std::unique_ptr<wire::Outbox<wire::TileCopy>> send;
  std::unique_ptr<wire::Inbox<wire::TileCopy>> sent;
};

struct ExchangeConfig {
  Speaker speaker;
  std::optional<LayerKey> own_layer;  ///< empty: a coordinator
  double share_bit_s = 128'000;       ///< most payload of tiles that are sent again
  TileAskerConfig asker = {};
};

/// Makes a store equal to what the others hold, whatever was lost on the way
/// (docs/architecture.md, rule 7): helmets and coordinator do it alike. A state machine: step()
/// never blocks. One owner, not thread-safe.
class TileExchange {
 public:
  TileExchange(ExchangeConfig config, ExchangeChannels channels);

  void step(SteadyTime now, Timestamp wall_now, const Roster& roster, ReplicaStore& store,
            LinkBudget& link);

  [[nodiscard]] std::size_t layers_behind(SteadyTime now) const {
    return asker_.layers_behind(now);
  }
  /// As TileServer.
  [[nodiscard]] std::map<TileIndex, Revision> take_newer_elsewhere() {
    return server_.take_newer_elsewhere();
  }
  /// Tiles that others wait for.
  [[nodiscard]] std::size_t waiting() const { return server_.waiting(); }
  [[nodiscard]] std::uint64_t refused() const;

 private:
  void take_copies(SteadyTime now, ReplicaStore& store);
  void take_requests(SteadyTime now, const ReplicaStore& store);

  ExchangeConfig config_;
  ExchangeChannels channels_;
  TileAsker asker_;
  TileServer server_;
  EnvelopeStamper request_stamper_;
  HearingNotes notes_;
};

}  // namespace lifeline::sharing
