#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "common/recording/heard.hpp"
#include "common/sharing/envelope_stamper.hpp"
#include "common/wire/channel.hpp"

namespace lifeline {

/// Notes what a state machine takes from its inboxes and says of its own, sample by sample, in the
/// order in which it does. Left out are samples of other missions, and what it said itself where
/// that comes back. One owner, not thread-safe.
class MessageTap {
 public:
  /// `self`: whose channels they are.
  explicit MessageTap(sharing::Speaker self);

  /// Puts itself before an end, before the state machine takes it; an end that is not there stays
  /// so. What does not leave is not noted.
  template <typename Message>
  void attach(std::unique_ptr<wire::Inbox<Message>>& end) {
    if (end != nullptr) end = std::make_unique<TappedInbox<Message>>(std::move(end), notes_);
  }
  template <typename Message>
  void attach(std::unique_ptr<wire::Outbox<Message>>& end) {
    if (end != nullptr) end = std::make_unique<TappedOutbox<Message>>(std::move(end), notes_);
  }
  /// The same for an end whose samples are made only while somebody reads: from here on they are
  /// made for the notes, and leave only for readers.
  void attach_as_reader(std::unique_ptr<wire::Outbox<wire::HelmetScan>>& end);

  /// Notes what comes to an inbox that nobody else takes from.
  void listen(std::unique_ptr<wire::Inbox<wire::HelmetScan>> scans) { scans_ = std::move(scans); }

  /// All since the last call.
  [[nodiscard]] std::vector<Heard> take();

 private:
  class Notes {
   public:
    explicit Notes(sharing::Speaker self) : self_(std::move(self)) {}
    template <typename Message>
    void add_heard(const Message& message) {
      if (!is_own(message.envelope)) add_said(message);
    }
    template <typename Message>
    void add_said(const Message& message) {
      if (is_of_mission(message.envelope)) messages_.emplace_back(message);
    }
    [[nodiscard]] std::vector<Heard> take() { return std::exchange(messages_, {}); }

   private:
    [[nodiscard]] bool is_own(const wire::Envelope& envelope) const;
    [[nodiscard]] bool is_of_mission(const wire::Envelope& envelope) const;

    sharing::Speaker self_;
    std::vector<Heard> messages_;
  };

  template <typename Message>
  class TappedInbox final : public wire::Inbox<Message> {
   public:
    TappedInbox(std::unique_ptr<wire::Inbox<Message>> inbox, std::shared_ptr<Notes> notes)
        : inbox_(std::move(inbox)), notes_(std::move(notes)) {}
    [[nodiscard]] std::vector<Message> take() override {
      auto taken = inbox_->take();
      for (const Message& message : taken) notes_->add_heard(message);
      return taken;
    }
    [[nodiscard]] std::uint64_t refused() const override { return inbox_->refused(); }

   private:
    std::unique_ptr<wire::Inbox<Message>> inbox_;
    std::shared_ptr<Notes> notes_;
  };

  template <typename Message>
  class TappedOutbox final : public wire::Outbox<Message> {
   public:
    TappedOutbox(std::unique_ptr<wire::Outbox<Message>> outbox, std::shared_ptr<Notes> notes)
        : outbox_(std::move(outbox)), notes_(std::move(notes)) {}
    [[nodiscard]] Result<void> put(const Message& message) override {
      auto left = outbox_->put(message);
      if (left) notes_->add_said(message);
      return left;
    }
    [[nodiscard]] bool has_reader() const override { return outbox_->has_reader(); }
    void assert_alive() override { outbox_->assert_alive(); }

   private:
    std::unique_ptr<wire::Outbox<Message>> outbox_;
    std::shared_ptr<Notes> notes_;
  };

  class ReadingOutbox;

  std::shared_ptr<Notes> notes_;  ///< the channels' ends know it too
  std::unique_ptr<wire::Inbox<wire::HelmetScan>> scans_;
};

}  // namespace lifeline
