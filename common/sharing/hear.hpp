#pragma once

#include <string_view>
#include <vector>

#include "common/base/time.hpp"
#include "common/sharing/accept.hpp"
#include "common/sharing/flood_watch.hpp"
#include "common/sharing/refusals.hpp"

namespace lifeline::sharing {

/// What a participant notes of the samples that it hears.
struct HearingNotes {
  Refusals refusals;
  FloodWatch floods;
};

/// Samples that only have to be put where they belong: each whose envelope is accepted goes to
/// `take_in`, which answers a Result; whatever is refused is noted under the topic's name, and who
/// sends too many.
template <typename Message, typename TakeIn>
void hear(const std::vector<Message>& samples, std::string_view topic, std::string_view mission_id,
          SteadyTime now, HearingNotes& notes, const TakeIn& take_in) {
  for (const Message& sample : samples) {
    if (auto accepted = check_envelope(sample.envelope, mission_id); !accepted) {
      notes.refusals.note(topic, accepted.error());
      continue;
    }
    notes.floods.note(topic, sample.envelope.sender_id, now);
    if (auto taken = take_in(sample); !taken) notes.refusals.note(topic, taken.error());
  }
}

}  // namespace lifeline::sharing
