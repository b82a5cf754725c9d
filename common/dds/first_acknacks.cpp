#include "common/dds/first_acknacks.hpp"

#include <algorithm>
#include <cstddef>
#include <utility>

namespace lifeline::dds {
namespace {

// RTPS messages: OMG RTPS 2.3, chapter 9.4.
constexpr std::size_t kHeader = 20, kSubmessageHeader = 4, kPrefix = 12;
constexpr std::size_t kTwoIds = 8, kBaseAndBits = 12, kCount = 4;
constexpr std::uint8_t kInfoDst = 0x0e, kAckNack = 0x06, kVendorsOwn = 0x80, kLittleEndian = 0x01;

using Octets = std::span<const std::uint8_t>;

struct Submessage {
  std::uint8_t kind = 0;
  Octets content;
};

/// Takes the next submessage off `rest`, which becomes empty where none is whole.
std::optional<Submessage> take_submessage(Octets& rest) {
  const Octets from = std::exchange(rest, {});
  if (from.size() < kSubmessageHeader) return std::nullopt;
  const bool little = (from[1] & kLittleEndian) != 0;
  const std::size_t told = from[little ? 2 : 3] + 256U * from[little ? 3 : 2];
  const Octets after = from.subspan(kSubmessageHeader);
  const std::size_t size = told == 0 ? after.size() : told;  // none told: up to the end
  if (size > after.size()) return std::nullopt;
  rest = after.subspan(size);
  return Submessage{from[0], after.first(size)};
}

/// Of a reader that has heard nothing: it starts at 0, and names no number.
bool is_first(Octets acknack) {
  return acknack.size() == kTwoIds + kBaseAndBits + kCount &&
         std::ranges::all_of(acknack.subspan(kTwoIds, kBaseAndBits),
                             [](std::uint8_t octet) { return octet == 0; });
}

constexpr Duration kAsTheyCome = std::chrono::seconds(2);
constexpr Duration kFirstPause = std::chrono::milliseconds(200);
constexpr Duration kLongestPause = std::chrono::milliseconds(500);
// Fast DDS has stopped asking; whoever asks later begins anew.
constexpr Duration kEnded = std::chrono::seconds(1);
// Beyond, questions pass as they come: far more than a fleet's readers.
constexpr std::size_t kMostQuestions = 8192;

}  // namespace

std::optional<FirstAckNacks::Question> FirstAckNacks::question_in(Octets message) {
  if (message.size() < kHeader) return std::nullopt;
  Question question{};
  bool asks = false;
  for (Octets rest = message.subspan(kHeader); !rest.empty();) {
    const auto submessage = take_submessage(rest);
    if (!submessage) return std::nullopt;
    if (submessage->kind == kInfoDst && submessage->content.size() == kPrefix) {
      std::ranges::copy(submessage->content, question.begin());
    } else if (submessage->kind == kAckNack && !asks && is_first(submessage->content)) {
      std::ranges::copy(submessage->content.first(kTwoIds), question.begin() + kPrefix);
      asks = true;
    } else if (submessage->kind < kVendorsOwn) {  // Fast DDS adds its statistics
      return std::nullopt;
    }
  }
  return asks ? std::optional(question) : std::nullopt;
}

bool FirstAckNacks::may_send(Octets message, SteadyTime now) {
  const auto question = question_in(message);
  if (!question) return true;
  const std::lock_guard lock(mutex_);
  auto found = asked_.find(*question);
  if (found == asked_.end()) {
    if (asked_.size() >= kMostQuestions) forget_ended(now);
    if (asked_.size() >= kMostQuestions) return true;
    found = asked_.emplace(*question, Asked{}).first;
  }
  Asked& asked = found->second;
  const bool is_new = asked.pause == Duration{} || now - asked.tried_at > kEnded;
  asked.tried_at = now;
  if (is_new) asked.begun_at = now;
  if (is_new || now - asked.begun_at < kAsTheyCome) {
    asked.pause = kFirstPause;
    return true;
  }
  if (now < asked.next_at) return false;
  asked.pause = std::min(asked.pause * 3 / 2, kLongestPause);
  asked.next_at = now + asked.pause;
  return true;
}

void FirstAckNacks::forget_ended(SteadyTime now) {
  if (now - forgot_at_ < kEnded) return;
  forgot_at_ = now;
  std::erase_if(asked_, [&](const auto& each) { return now - each.second.tried_at > kEnded; });
}

}  // namespace lifeline::dds
