#pragma once

#include <string_view>
#include <tuple>

#include "common/wire/messages.hpp"

namespace lifeline::dds {

/// One row of the table below. Keys stand in the IDL, every QoS value in the XML profiles
/// (config/qos/*.xml); docs/topics.md says why they are what they are.
template <typename Message>
struct TopicRow {
  std::string_view name;
  std::string_view type;  ///< as other DDS implementations see it
  std::string_view writer_profile;
  std::string_view reader_profile;
  std::string_view standby_profile = {};  ///< of a writer that stands in for another; empty = none
};

/// The participant's profile in every QoS file.
inline constexpr std::string_view kParticipantProfile = "lifeline_participant";

/// The only place where topics are named.
inline constexpr std::tuple kTopics{
    TopicRow<wire::HelmetPose>{"lifeline/pose", "lifeline::msg::HelmetPose", "pose_writer",
                               "pose_reader"},
    TopicRow<wire::HelmetScan>{"lifeline/scan", "lifeline::msg::HelmetScan", "scan_writer",
                               "scan_reader"},
    TopicRow<wire::TsdTile>{"lifeline/tsd_tile", "lifeline::msg::TsdTile", "tsd_tile_writer",
                            "tsd_tile_reader"},
    TopicRow<wire::TileRequest>{"lifeline/tile_request", "lifeline::msg::TileRequest",
                                "tile_request_writer", "tile_request_reader"},
    TopicRow<wire::TileCopy>{"lifeline/tile_copy", "lifeline::msg::TileCopy", "tile_copy_writer",
                             "tile_copy_reader"},
    TopicRow<wire::MergeDirective>{"lifeline/merge_directive", "lifeline::msg::MergeDirective",
                                   "merge_directive_writer", "merge_directive_reader",
                                   "merge_directive_standby_writer"},
    TopicRow<wire::DirectiveCopy>{"lifeline/directive_copy", "lifeline::msg::DirectiveCopy",
                                  "directive_copy_writer", "directive_copy_reader"},
    TopicRow<wire::MergeEvidence>{"lifeline/merge_evidence", "lifeline::msg::MergeEvidence",
                                  "merge_evidence_writer", "merge_evidence_reader"},
    TopicRow<wire::AgentStatus>{"lifeline/agent_status", "lifeline::msg::AgentStatus",
                                "agent_status_writer", "agent_status_reader"},
    TopicRow<wire::Detection>{"lifeline/detection", "lifeline::msg::Detection", "detection_writer",
                              "detection_reader"},
    TopicRow<wire::Alert>{"lifeline/alert", "lifeline::msg::Alert", "alert_writer", "alert_reader"},
};

template <typename Message>
[[nodiscard]] constexpr const TopicRow<Message>& topic_of() {
  return std::get<TopicRow<Message>>(kTopics);
}

}  // namespace lifeline::dds
