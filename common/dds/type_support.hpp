#pragma once

// Which generated type carries which message; for the sources and tests of common/dds only.

#include "common/dds/guarded_type.hpp"
#include "common/wire/messages.hpp"
#include "dds/mapPubSubTypes.h"
#include "dds/mergePubSubTypes.h"
#include "dds/statusPubSubTypes.h"

namespace lifeline::dds {

template <typename Message>
struct TypeOf;
// clang-format off
template <> struct TypeOf<wire::HelmetPose> { using Generated = msg::HelmetPosePubSubType; };
template <> struct TypeOf<wire::HelmetScan> { using Generated = msg::HelmetScanPubSubType; };
template <> struct TypeOf<wire::TsdTile> { using Generated = msg::TsdTilePubSubType; };
template <> struct TypeOf<wire::TileRequest> { using Generated = msg::TileRequestPubSubType; };
template <> struct TypeOf<wire::TileCopy> { using Generated = msg::TileCopyPubSubType; };
template <> struct TypeOf<wire::MergeDirective> { using Generated = msg::MergeDirectivePubSubType; };
template <> struct TypeOf<wire::DirectiveCopy> { using Generated = msg::DirectiveCopyPubSubType; };
template <> struct TypeOf<wire::MergeEvidence> { using Generated = msg::MergeEvidencePubSubType; };
template <> struct TypeOf<wire::AgentStatus> { using Generated = msg::AgentStatusPubSubType; };
template <> struct TypeOf<wire::Detection> { using Generated = msg::DetectionPubSubType; };
template <> struct TypeOf<wire::Alert> { using Generated = msg::AlertPubSubType; };
// clang-format on

template <typename Message>
using TypeSupportOf = GuardedType<typename TypeOf<Message>::Generated>;
template <typename Message>
using SampleOf = typename TypeSupportOf<Message>::Data;

}  // namespace lifeline::dds
