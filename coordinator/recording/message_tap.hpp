#pragma once

#include <memory>
#include <string>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "common/base/result.hpp"
#include "common/dds/participant.hpp"
#include "common/wire/messages.hpp"
#include "coordinator/coordinator.hpp"

namespace lifeline {

/// A sample of any topic.
using Heard = std::variant<wire::HelmetPose, wire::HelmetScan, wire::TsdTile, wire::TileRequest,
                           wire::TileCopy, wire::MergeDirective, wire::MergeEvidence,
                           wire::AgentStatus, wire::Detection, wire::Alert>;

/// Notes what a coordinator takes from its inboxes and says of its own, sample by sample, in the
/// order in which it does. Samples of other missions are left out. One owner, not thread-safe.
class MessageTap {
 public:
  explicit MessageTap(std::string mission_id);

  /// Puts itself between the coordinator and its channels: what it hears (directives excepted,
  /// which are noted where they are followed), and what it says itself: evidence, status, alerts,
  /// rulings on finds.
  void attach(CoordinatorChannels& channels);
  /// Listens to what the coordinator has no use for, if asked: scans, which helmets send only while
  /// somebody listens.
  [[nodiscard]] Result<void> listen(dds::Participant& participant, bool scans);

  /// All since the last call.
  [[nodiscard]] std::vector<Heard> take();

 private:
  struct Notes;
  std::shared_ptr<Notes> notes_;  ///< the channels' ends know it too
  std::unique_ptr<wire::Inbox<wire::HelmetScan>> scans_;
};

}  // namespace lifeline
