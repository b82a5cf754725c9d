#include "common/recording/message_tap.hpp"

#include "common/sharing/accept.hpp"

namespace lifeline {

bool MessageTap::Notes::is_own(const wire::Envelope& envelope) const {
  return envelope.sender_id == self_.id.text() && envelope.incarnation == self_.incarnation.value;
}

bool MessageTap::Notes::is_of_mission(const wire::Envelope& envelope) const {
  return sharing::check_envelope(envelope, self_.mission_id).has_value();
}

/// Takes what it is given for itself, and hands on what others read.
class MessageTap::ReadingOutbox final : public wire::Outbox<wire::HelmetScan> {
 public:
  ReadingOutbox(std::unique_ptr<wire::Outbox<wire::HelmetScan>> outbox,
                std::shared_ptr<Notes> notes)
      : outbox_(std::move(outbox)), notes_(std::move(notes)) {}
  [[nodiscard]] Result<void> put(const wire::HelmetScan& scan) override {
    notes_->add_said(scan);
    return outbox_->has_reader() ? outbox_->put(scan) : Result<void>{};
  }
  [[nodiscard]] bool has_reader() const override { return true; }

 private:
  std::unique_ptr<wire::Outbox<wire::HelmetScan>> outbox_;
  std::shared_ptr<Notes> notes_;
};

MessageTap::MessageTap(sharing::Speaker self) : notes_(std::make_shared<Notes>(std::move(self))) {}

void MessageTap::attach_as_reader(std::unique_ptr<wire::Outbox<wire::HelmetScan>>& end) {
  if (end != nullptr) end = std::make_unique<ReadingOutbox>(std::move(end), notes_);
}

std::vector<Heard> MessageTap::take() {
  if (scans_ != nullptr) {
    for (const wire::HelmetScan& scan : scans_->take()) notes_->add_heard(scan);
  }
  return notes_->take();
}

}  // namespace lifeline
