#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <utility>

#include "common/base/log.hpp"
#include "common/store/record_store.hpp"
#include "common/wire/channel.hpp"

namespace lifeline::store {

/// An outbox whose samples leave only once they are on disk: what anybody else knows of us, we know
/// ourselves after a restart (docs/decisions/0601). They wait for one group commit; where the disk
/// refuses or hangs, for none. The order stays. One owner, not thread-safe; pump() sends what has
/// become due.
template <typename Message>
class WriteAheadOutbox final : public wire::Outbox<Message> {
 public:
  /// Hands a sample to the store; the ticket after which it may leave. Nothing: it goes with the
  /// next sample that has one, whose part it is.
  using Keep = std::function<std::optional<RecordStore::Ticket>(const Message&)>;
  static constexpr std::size_t kMostWaiting = 8192;

  WriteAheadOutbox(std::unique_ptr<wire::Outbox<Message>> inner, const RecordStore& store,
                   Keep keep)
      : inner_(std::move(inner)), store_(store), keep_(std::move(keep)) {}

  [[nodiscard]] Result<void> put(const Message& message) override {
    if (waiting_.size() >= kMostWaiting) {
      return fail(ErrorCode::unavailable, "{} samples wait to be sent; no more are taken",
                  waiting_.size());
    }
    const auto ticket = keep_(message);
    waiting_.push_back({ticket, message});
    for (auto part = waiting_.rbegin() + 1; ticket && part != waiting_.rend(); ++part) {
      if (part->ticket) break;
      part->ticket = ticket;
    }
    return {};
  }

  [[nodiscard]] bool has_reader() const override { return inner_->has_reader(); }
  void assert_alive() override { inner_->assert_alive(); }

  /// A sample that the middleware refuses is tried again at the next call.
  void pump() {
    if (waiting_.empty()) return;
    const RecordStore::Ticket settled = store_.settled();
    while (!waiting_.empty() && waiting_.front().ticket && *waiting_.front().ticket <= settled) {
      if (auto sent = inner_->put(waiting_.front().message); !sent) {
        spdlog::warn("{}; it is tried again", sent.error().text);
        return;
      }
      waiting_.pop_front();
    }
  }

 private:
  struct Waiting {
    std::optional<RecordStore::Ticket> ticket;
    Message message;
  };

  std::unique_ptr<wire::Outbox<Message>> inner_;
  const RecordStore& store_;
  Keep keep_;
  std::deque<Waiting> waiting_;
};

}  // namespace lifeline::store
