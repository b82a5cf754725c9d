#include "common/sharing/tile_exchange.hpp"

#include "common/base/log.hpp"
#include "common/sharing/accept.hpp"
#include "common/sharing/hear.hpp"

namespace lifeline::sharing {

TileExchange::TileExchange(ExchangeConfig config, ExchangeChannels channels)
    : config_(std::move(config)),
      channels_(std::move(channels)),
      asker_(config_.speaker.id, config_.own_layer, config_.asker),
      server_(config_.speaker, config_.own_layer, config_.share_bit_s, *channels_.send),
      request_stamper_(config_.speaker) {}

void TileExchange::step(SteadyTime now, Timestamp wall_now, const Roster& roster,
                        ReplicaStore& store, LinkBudget& link) {
  take_copies(now, store);
  take_requests(now, store);
  if (auto request = asker_.step(now, roster, store)) {
    request->envelope = request_stamper_.next(wall_now);
    if (auto asked = channels_.ask->put(*request); !asked) spdlog::warn("{}", asked.error().text);
  }
  if (auto sent = server_.step(now, wall_now, store, link); !sent)
    spdlog::warn("{}", sent.error().text);
}

void TileExchange::take_copies(SteadyTime now, ReplicaStore& store) {
  hear(channels_.sent->take(), "tile_copy", config_.speaker.mission_id, now, notes_,
       [&](const wire::TileCopy& copy) -> Result<void> {
         // What we published ourselves nobody else knows better.
         if (config_.own_layer && copy.layer == to_layer_name(*config_.own_layer)) return {};
         if (auto applied = store.apply(copy); !applied) return forward_error(applied);
         return {};
       });
}

void TileExchange::take_requests(SteadyTime now, const ReplicaStore& store) {
  hear(channels_.asked->take(), "tile_request", config_.speaker.mission_id, now, notes_,
       [&](const wire::TileRequest& request) { return server_.take(request, store); });
}

std::uint64_t TileExchange::refused() const {
  return notes_.refusals.count() + channels_.asked->refused() + channels_.sent->refused();
}

}  // namespace lifeline::sharing
