#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "common/recording/heard.hpp"
#include "coordinator/coordinator.hpp"

namespace lifeline {

/// An inbox that is filled by hand.
template <typename Message>
class FedInbox final : public wire::Inbox<Message> {
 public:
  void feed(Message message) { waiting_.push_back(std::move(message)); }
  [[nodiscard]] std::vector<Message> take() override { return std::exchange(waiting_, {}); }
  [[nodiscard]] std::uint64_t refused() const override { return 0; }

 private:
  std::vector<Message> waiting_;
};

/// The ends of a coordinator that follows a recording: it hears what is fed, directives included,
/// and what it says reaches nobody.
class ReplayChannels {
 public:
  /// For one coordinator, which must not outlive this.
  [[nodiscard]] CoordinatorChannels make();
  /// Evidence, scans and requests concern nobody here.
  void feed(const Heard& heard);

 private:
  FedInbox<wire::TsdTile>* tiles_ = nullptr;
  FedInbox<wire::TileCopy>* copies_ = nullptr;
  FedInbox<wire::HelmetPose>* poses_ = nullptr;
  FedInbox<wire::AgentStatus>* statuses_ = nullptr;
  FedInbox<wire::Detection>* detections_ = nullptr;
  FedInbox<wire::MergeDirective>* directives_ = nullptr;
  FedInbox<wire::Alert>* alerts_ = nullptr;
};

/// A worker that never takes a job: who follows a recording decides nothing anew.
class IdleMatchWorker final : public MatchWorker {
 public:
  void submit(MatchJob /*job*/) override {}
  [[nodiscard]] std::optional<MatchOutcome> take() override { return std::nullopt; }
  [[nodiscard]] bool busy() const override { return true; }
};

}  // namespace lifeline
