#include "agents/sources/ros2_watch.hpp"

#include <algorithm>
#include <utility>

#include "agents/sources/ros2_options.hpp"
#include "common/base/log.hpp"
#include "common/base/printable.hpp"

namespace lifeline::sources {
namespace {

/// What a stranger calls its type goes into the log: not all of it, and nothing that moves a
/// cursor.
std::string shortened(std::string text) {
  constexpr std::size_t kMost = 80;
  if (text.size() > kMost) text.resize(kMost);
  return printable(std::move(text));
}

}  // namespace

TopicWatch::TopicWatch(std::string topic, std::string type, std::uint32_t domain, SteadyTime now)
    : topic_(std::move(topic)), type_(std::move(type)), domain_(domain), since_(now) {}

bool TopicWatch::takes(const dds::PublisherId& publisher, SteadyTime now) {
  if (followed_ && *followed_ != publisher) {
    if (now - followed_spoke_ < kSilentAfter) {
      if (!std::exchange(told_of_others_, true)) {
        spdlog::warn(
            "{}: has several publishers in domain {}, only one is taken; give each helmet's driver "
            "a domain of its own",
            topic_, domain_);
      }
      return false;
    }
    spdlog::info("{}: another publisher is taken from now on", topic_);
    told_of_others_ = false;
  }
  followed_ = publisher;
  followed_spoke_ = now;
  return true;
}

void TopicWatch::note_good(SteadyTime now) {
  ++good_;
  last_good_ = now;
}

void TopicWatch::note_bad(std::string_view why, SteadyTime now) {
  last_bad_ = now;
  why_bad_ = why;
  if (bad_++ % 1000 == 0) {
    spdlog::warn("{}: {} of its messages cannot be used so far; the last: {}", topic_, bad_, why);
  }
}

TopicFault TopicWatch::find_fault(const dds::RawTopicState& state, SteadyTime now) const {
  const auto is_recent = [now](const std::optional<SteadyTime>& time) {
    return time && now - *time < kSilentAfter;
  };
  if (is_recent(last_good_)) return TopicFault::none;
  if (is_recent(last_bad_)) return TopicFault::unusable;
  if (!last_good_ && now - since_ < kDiscovery) return TopicFault::none;
  if (state.matched > 0) return TopicFault::silent;
  if (state.announced > 0) return TopicFault::foreign_qos;
  return state.foreign_type.empty() ? TopicFault::unpublished : TopicFault::foreign_type;
}

std::string TopicWatch::fault_text(TopicFault fault, const dds::RawTopicState& state) const {
  switch (fault) {
    case TopicFault::unpublished:
      return fmt::format(
          "nobody publishes it (DDS: {}) in domain {}; check that the driver runs, its "
          "ROS_DOMAIN_ID, and that the QoS file names its network",
          dds_topic(topic_), domain_);
    case TopicFault::foreign_type:
      return fmt::format("is published as {}, not as {}; name the right topic",
                         shortened(state.foreign_type), type_);
    case TopicFault::foreign_qos:
      return fmt::format(
          "its publisher's QoS does not fit (DDS policy {}); compare it with the "
          "QoS file",
          state.refused_policy);
    case TopicFault::silent:
      return fmt::format("silent, though {} there; check the sensor and its driver",
                         state.matched == 1 ? "its publisher is"
                                            : fmt::format("{} publishers are", state.matched));
    case TopicFault::unusable:
      return fmt::format("nothing that comes can be used: {}", why_bad_);
    case TopicFault::none:
      break;
  }
  return "is heard";
}

void TopicWatch::look(const dds::RawTopicState& state, SteadyTime now) {
  if (const bool has = state.matched > 0; has != std::exchange(had_publisher_, has) && has) {
    spdlog::info("{}: has a publisher in domain {}", topic_, domain_);
  }
  const TopicFault fault = find_fault(state, now);
  if (fault == std::exchange(fault_, fault)) return;
  if (fault == TopicFault::none) {
    spdlog::info("{}: is heard", topic_);
  } else {
    spdlog::warn("{}: {}", topic_, fault_text(fault, state));
  }
}

}  // namespace lifeline::sources
