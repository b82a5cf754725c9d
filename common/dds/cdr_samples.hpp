#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "common/base/result.hpp"

namespace lifeline::dds {

// Samples of our own topics as octets: an encapsulation header, then CDR, as they travel. For
// recordings. `Message` is one of the ten of common/wire/messages.hpp.

/// bad_data when a text or sequence breaks its bound.
template <typename Message>
[[nodiscard]] Result<std::vector<std::uint8_t>> to_cdr(const Message& message);

/// From octets that may be anything: what an inbox would refuse is refused (bad_data).
template <typename Message>
[[nodiscard]] Result<Message> from_cdr(std::span<const std::uint8_t> octets);

}  // namespace lifeline::dds
