#include "coordinator/recording/message_tap.hpp"

#include "common/dds/open_channel.hpp"
#include "common/sharing/accept.hpp"

namespace lifeline {

struct MessageTap::Notes {
  std::string mission_id;
  std::vector<Heard> heard;

  template <typename Message>
  void add(const Message& message) {
    if (sharing::check_envelope(message.envelope, mission_id)) heard.emplace_back(message);
  }
};

namespace {

template <typename Message, typename Notes>
class TappedInbox final : public wire::Inbox<Message> {
 public:
  TappedInbox(std::unique_ptr<wire::Inbox<Message>> inbox, std::shared_ptr<Notes> notes)
      : inbox_(std::move(inbox)), notes_(std::move(notes)) {}
  [[nodiscard]] std::vector<Message> take() override {
    auto taken = inbox_->take();
    for (const Message& message : taken) notes_->add(message);
    return taken;
  }
  [[nodiscard]] std::uint64_t refused() const override { return inbox_->refused(); }

 private:
  std::unique_ptr<wire::Inbox<Message>> inbox_;
  std::shared_ptr<Notes> notes_;
};

template <typename Message, typename Notes>
class TappedOutbox final : public wire::Outbox<Message> {
 public:
  TappedOutbox(std::unique_ptr<wire::Outbox<Message>> outbox, std::shared_ptr<Notes> notes)
      : outbox_(std::move(outbox)), notes_(std::move(notes)) {}
  [[nodiscard]] Result<void> put(const Message& message) override {
    notes_->add(message);
    return outbox_->put(message);
  }
  [[nodiscard]] bool has_reader() const override { return outbox_->has_reader(); }
  void assert_alive() override { outbox_->assert_alive(); }

 private:
  std::unique_ptr<wire::Outbox<Message>> outbox_;
  std::shared_ptr<Notes> notes_;
};

template <typename Message, typename Notes>
void tap(std::unique_ptr<wire::Inbox<Message>>& end, const std::shared_ptr<Notes>& notes) {
  end = std::make_unique<TappedInbox<Message, Notes>>(std::move(end), notes);
}

template <typename Message, typename Notes>
void tap(std::unique_ptr<wire::Outbox<Message>>& end, const std::shared_ptr<Notes>& notes) {
  end = std::make_unique<TappedOutbox<Message, Notes>>(std::move(end), notes);
}

}  // namespace

MessageTap::MessageTap(std::string mission_id)
    : notes_(std::make_shared<Notes>(Notes{std::move(mission_id), {}})) {}

void MessageTap::attach(CoordinatorChannels& channels) {
  tap(channels.tiles, notes_);
  tap(channels.poses, notes_);
  tap(channels.statuses, notes_);
  tap(channels.detections, notes_);
  tap(channels.evidence, notes_);
  tap(channels.status, notes_);
  tap(channels.exchange.asked, notes_);
  tap(channels.exchange.sent, notes_);
  if (channels.alerts != nullptr) tap(channels.alerts, notes_);
  if (channels.alert != nullptr) tap(channels.alert, notes_);
  if (channels.ruling != nullptr) tap(channels.ruling, notes_);
}

Result<void> MessageTap::listen(dds::Participant& participant, bool scans) {
  Result<void> all;
  if (scans) dds::open_inbox(participant, scans_, all);
  return all;
}

std::vector<Heard> MessageTap::take() {
  if (scans_ != nullptr) {
    for (const wire::HelmetScan& scan : scans_->take()) notes_->add(scan);
  }
  return std::exchange(notes_->heard, {});
}

}  // namespace lifeline
