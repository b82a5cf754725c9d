#include "coordinator/recording/replay_channels.hpp"

namespace lifeline {
namespace {

template <typename Message>
class NoReader final : public wire::Outbox<Message> {
 public:
  [[nodiscard]] Result<void> put(const Message& /*message*/) override { return {}; }
  [[nodiscard]] bool has_reader() const override { return false; }
};

template <typename Message>
std::unique_ptr<wire::Inbox<Message>> make_inbox(FedInbox<Message>*& fed) {
  auto inbox = std::make_unique<FedInbox<Message>>();
  fed = inbox.get();
  return inbox;
}

}  // namespace

CoordinatorChannels ReplayChannels::make() {
  CoordinatorChannels channels;
  channels.tiles = make_inbox(tiles_);
  channels.poses = make_inbox(poses_);
  channels.statuses = make_inbox(statuses_);
  channels.detections = make_inbox(detections_);
  channels.directives = make_inbox(directives_);
  channels.alerts = make_inbox(alerts_);
  channels.alert = std::make_unique<NoReader<wire::Alert>>();
  channels.evidence = std::make_unique<NoReader<wire::MergeEvidence>>();
  channels.status = std::make_unique<NoReader<wire::AgentStatus>>();
  channels.exchange.ask = std::make_unique<NoReader<wire::TileRequest>>();
  channels.exchange.asked = std::make_unique<FedInbox<wire::TileRequest>>();
  channels.exchange.send = std::make_unique<NoReader<wire::TileCopy>>();
  channels.exchange.sent = make_inbox(copies_);
  channels.bytes_sent = channels.octets_on_air = [] { return std::uint64_t{0}; };
  return channels;
}

void ReplayChannels::feed(const Heard& heard) {
  std::visit(
      [&]<typename Message>(const Message& message) {
        if constexpr (std::is_same_v<Message, wire::TsdTile>) tiles_->feed(message);
        if constexpr (std::is_same_v<Message, wire::TileCopy>) copies_->feed(message);
        if constexpr (std::is_same_v<Message, wire::HelmetPose>) poses_->feed(message);
        if constexpr (std::is_same_v<Message, wire::AgentStatus>) statuses_->feed(message);
        if constexpr (std::is_same_v<Message, wire::Detection>) detections_->feed(message);
        if constexpr (std::is_same_v<Message, wire::MergeDirective>) directives_->feed(message);
        if constexpr (std::is_same_v<Message, wire::Alert>) alerts_->feed(message);
      },
      heard);
}

}  // namespace lifeline
