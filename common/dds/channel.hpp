#pragma once

#include <memory>

#include "common/base/result.hpp"
#include "common/dds/participant.hpp"
#include "common/wire/channel.hpp"
#include "common/wire/messages.hpp"

namespace lifeline::dds {

/// Which of several writers of one key is heard where ownership is exclusive (merge_directive).
enum class Standing {
  primary,
  standby,  ///< heard only while the primary is not alive
};

/// Where samples of `Message`'s topic leave this process. One thread per outbox. put() converts,
/// checks the bounds (bad_data) and hands over; it never waits for the network. On destruction the
/// last samples of a reliable topic are given up to 0.3 s to be acknowledged.
/// Error: bad_data when the topic's profile contradicts itself, with the profile file.
/// `Message` is one of the ten of common/wire/messages.hpp.
template <typename Message>
[[nodiscard]] Result<std::unique_ptr<wire::Outbox<Message>>> make_outbox(
    Participant& participant, Standing standing = Standing::primary);

/// Where samples of `Message`'s topic arrive, other participants' only: a process does not hear
/// itself. One thread per inbox. refused() counts what the middleware rejected and what could
/// not be decoded or broke a bound; not what was replaced by a newer sample or lost on the way.
template <typename Message>
[[nodiscard]] Result<std::unique_ptr<wire::Inbox<Message>>> make_inbox(Participant& participant);

}  // namespace lifeline::dds
