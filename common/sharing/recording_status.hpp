#pragma once

#include <cstdint>

#include "common/wire/messages.hpp"

namespace lifeline::sharing {

/// How a recording stands.
struct RecordingStatus {
  wire::RecordingState state = wire::RecordingState::off;
  std::uint64_t unrecorded = 0;  ///< what it lacks, in messages
};

}  // namespace lifeline::sharing
