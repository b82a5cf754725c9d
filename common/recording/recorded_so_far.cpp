#include "common/recording/recorded_so_far.hpp"

#include <iterator>
#include <set>

#include "common/recording/topic_names.hpp"

namespace lifeline {
namespace {

// The recorder waits for a reader about a millisecond, and a reader holds a few hundred kilobytes.
constexpr std::uint64_t kRowsAtOnce = 500;

template <typename... Messages>
std::set<std::string> names_of() {
  return {std::string(kRecordingTopic), recorded_topic<Messages>().name...};
}

bool is_needed(const bag::Topic& topic) {
  static const std::set<std::string> names =
      names_of<wire::TsdTile, wire::TileCopy, wire::HelmetPose, wire::AgentStatus, wire::Detection,
               wire::MergeDirective, wire::Alert>();
  return names.contains(topic.name);
}

}  // namespace

Result<std::optional<bag::Message>> RecordedSoFar::next() {
  while (waiting_.empty()) {
    const std::uint64_t before = after_;
    auto more = recorder_.read(after_, kRowsAtOnce, is_needed);
    if (!more) return forward_error(more);
    std::move(more->begin(), more->end(), std::back_inserter(waiting_));
    if (after_ == before) return std::nullopt;
  }
  bag::Message next = std::move(waiting_.front());
  waiting_.pop_front();
  return next;
}

}  // namespace lifeline
