#pragma once

#include "common/base/result.hpp"
#include "common/wire/messages.hpp"

namespace lifeline::dds {

// Whether every text and sequence of a message keeps the bounds of common/wire/limits.hpp, which
// are those of idl/*.idl. The error names topic, field, size and bound. Holds both for what we send
// and for what came in: the generated code enforces a sequence's bound in neither direction, and
// cuts a text silently.

[[nodiscard]] Result<void> check_bounds(const wire::HelmetPose& message);
[[nodiscard]] Result<void> check_bounds(const wire::HelmetScan& message);
[[nodiscard]] Result<void> check_bounds(const wire::TsdTile& message);
[[nodiscard]] Result<void> check_bounds(const wire::TileRequest& message);
[[nodiscard]] Result<void> check_bounds(const wire::TileCopy& message);
[[nodiscard]] Result<void> check_bounds(const wire::MergeDirective& message);
[[nodiscard]] Result<void> check_bounds(const wire::DirectiveCopy& message);
[[nodiscard]] Result<void> check_bounds(const wire::MergeEvidence& message);
[[nodiscard]] Result<void> check_bounds(const wire::AgentStatus& message);
[[nodiscard]] Result<void> check_bounds(const wire::Detection& message);
[[nodiscard]] Result<void> check_bounds(const wire::Alert& message);

}  // namespace lifeline::dds
