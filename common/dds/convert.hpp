#pragma once

#include "common/base/result.hpp"
#include "common/wire/messages.hpp"
#include "dds/map.h"
#include "dds/merge.h"
#include "dds/status.h"

namespace lifeline::dds {

// The messages of common/wire/messages.hpp as the types generated from idl/*.idl, and back.
//
// to_idl() overwrites `out`, which may be reused. It fails (ErrorCode::bad_data) when a text or
// sequence breaks its bound, see check_bounds(). from_idl() copies and judges nothing, with one
// exception: an enumerator beyond 255 becomes 255, so that a wide unknown value cannot turn into a
// known one.

[[nodiscard]] Result<void> to_idl(const wire::HelmetPose& message, msg::HelmetPose& out);
[[nodiscard]] Result<void> to_idl(const wire::HelmetScan& message, msg::HelmetScan& out);
[[nodiscard]] Result<void> to_idl(const wire::TsdTile& message, msg::TsdTile& out);
[[nodiscard]] Result<void> to_idl(const wire::TileRequest& message, msg::TileRequest& out);
[[nodiscard]] Result<void> to_idl(const wire::TileCopy& message, msg::TileCopy& out);
[[nodiscard]] Result<void> to_idl(const wire::MergeDirective& message, msg::MergeDirective& out);
[[nodiscard]] Result<void> to_idl(const wire::DirectiveCopy& message, msg::DirectiveCopy& out);
[[nodiscard]] Result<void> to_idl(const wire::MergeEvidence& message, msg::MergeEvidence& out);
[[nodiscard]] Result<void> to_idl(const wire::AgentStatus& message, msg::AgentStatus& out);
[[nodiscard]] Result<void> to_idl(const wire::Detection& message, msg::Detection& out);
[[nodiscard]] Result<void> to_idl(const wire::Alert& message, msg::Alert& out);

[[nodiscard]] wire::HelmetPose from_idl(const msg::HelmetPose& sample);
[[nodiscard]] wire::HelmetScan from_idl(const msg::HelmetScan& sample);
[[nodiscard]] wire::TsdTile from_idl(const msg::TsdTile& sample);
[[nodiscard]] wire::TileRequest from_idl(const msg::TileRequest& sample);
[[nodiscard]] wire::TileCopy from_idl(const msg::TileCopy& sample);
[[nodiscard]] wire::MergeDirective from_idl(const msg::MergeDirective& sample);
[[nodiscard]] wire::DirectiveCopy from_idl(const msg::DirectiveCopy& sample);
[[nodiscard]] wire::MergeEvidence from_idl(const msg::MergeEvidence& sample);
[[nodiscard]] wire::AgentStatus from_idl(const msg::AgentStatus& sample);
[[nodiscard]] wire::Detection from_idl(const msg::Detection& sample);
[[nodiscard]] wire::Alert from_idl(const msg::Alert& sample);

}  // namespace lifeline::dds
