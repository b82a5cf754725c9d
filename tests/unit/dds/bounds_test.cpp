#include "common/dds/bounds.hpp"

#include <functional>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "common/dds/convert.hpp"
#include "common/wire/limits.hpp"

namespace lifeline::dds {
namespace {

using namespace wire;

std::string text_of(const Result<void>& result) {
  return result ? "" : result.error().text;
}

/// One bounded field: sets it to a size, and says what check and conversion think of that.
struct BoundedField {
  std::string name;
  std::size_t bound;
  std::function<Result<void>(std::size_t)> check;
  std::function<Result<void>(std::size_t)> convert;
};

template <typename Idl, typename Message, typename Resize>
BoundedField field(std::string name, std::size_t bound, Resize resize) {
  const auto sized = [resize](std::size_t size) {
    Message message;
    resize(message, size);
    return message;
  };
  return {std::move(name), bound, [sized](std::size_t size) { return check_bounds(sized(size)); },
          [sized](std::size_t size) {
            Idl out;
            return to_idl(sized(size), out);
          }};
}

void grow(std::string& text, std::size_t size) {
  text.assign(size, 'x');
}
template <typename T>
void grow(std::vector<T>& sequence, std::size_t size) {
  sequence.resize(size);
}

#define LIFELINE_FIELD(Type, bound, access) \
  field<msg::Type, wire::Type>(             \
      #Type "." #access, bound,             \
      [](wire::Type& message, std::size_t size) { grow(message.access, size); })
#define LIFELINE_ELEMENT(Type, bound, sequence, access)                    \
  field<msg::Type, wire::Type>(#Type "." #sequence "[1]" #access, bound,   \
                               [](wire::Type& message, std::size_t size) { \
                                 message.sequence.resize(2);               \
                                 grow(message.sequence[1] access, size);   \
                               })

std::vector<BoundedField> bounded_fields() {
  return {
      LIFELINE_FIELD(HelmetPose, kMaxMissionIdLength, envelope.mission_id),
      LIFELINE_FIELD(HelmetPose, kMaxIdLength, envelope.sender_id),
      LIFELINE_FIELD(HelmetPose, kMaxSignature, envelope.signature),
      LIFELINE_FIELD(HelmetPose, kMaxIdLength, agent_id),
      LIFELINE_FIELD(HelmetScan, kMaxIdLength, agent_id),
      LIFELINE_FIELD(HelmetScan, kMaxScanBeams, ranges_cm),
      LIFELINE_FIELD(TsdTile, kMaxIdLength, layer.agent_id),
      LIFELINE_FIELD(TsdTile, kMaxTilePart, payload),
      LIFELINE_FIELD(TileRequest, kMaxIdLength, requester_id),
      LIFELINE_FIELD(TileRequest, kMaxIdLength, layer.agent_id),
      LIFELINE_FIELD(TileRequest, kMaxIdLength, asked_id),
      LIFELINE_FIELD(TileRequest, kMaxTilesPerRequest, held),
      LIFELINE_FIELD(TileCopy, kMaxIdLength, layer.agent_id),
      LIFELINE_FIELD(TileCopy, kMaxTilePart, payload),
      LIFELINE_FIELD(MergeDirective, kMaxMissionIdLength, mission_id),
      LIFELINE_FIELD(MergeDirective, kMaxMembers, members),
      LIFELINE_ELEMENT(MergeDirective, kMaxIdLength, members, .layer.agent_id),
      LIFELINE_FIELD(DirectiveCopy, kMaxIdLength, teller_id),
      LIFELINE_FIELD(DirectiveCopy, kMaxMissionIdLength, directive.mission_id),
      LIFELINE_FIELD(DirectiveCopy, kMaxMembers, directive.members),
      LIFELINE_FIELD(MergeEvidence, kMaxIdLength, a.agent_id),
      LIFELINE_FIELD(MergeEvidence, kMaxIdLength, b.agent_id),
      LIFELINE_FIELD(MergeEvidence, kMaxReason, reason),
      LIFELINE_FIELD(MergeEvidence, kMaxCandidates, candidates),
      LIFELINE_FIELD(AgentStatus, kMaxIdLength, agent_id),
      LIFELINE_FIELD(AgentStatus, kMaxLayers, layers),
      LIFELINE_ELEMENT(AgentStatus, kMaxIdLength, layers, .layer.agent_id),
      LIFELINE_FIELD(AgentStatus, kMaxPeers, peers_heard),
      LIFELINE_ELEMENT(AgentStatus, kMaxIdLength, peers_heard, ),
      LIFELINE_FIELD(AgentStatus, kMaxPeers, peers_echo_ms),
      LIFELINE_FIELD(Detection, kMaxIdLength, agent_id),
      LIFELINE_FIELD(Alert, kMaxIdLength, issuer_id),
      LIFELINE_FIELD(Alert, kMaxIdLength, subject_id),
      LIFELINE_FIELD(Alert, kMaxAlertText, text),
      LIFELINE_FIELD(Alert, kMaxPeers, acknowledged_by),
      LIFELINE_ELEMENT(Alert, kMaxIdLength, acknowledged_by, ),
  };
}

TEST(Bounds, every_field_may_be_as_long_as_its_bound) {
  for (const auto& field : bounded_fields()) {
    EXPECT_TRUE(field.check(field.bound)) << field.name;
    EXPECT_TRUE(field.convert(field.bound)) << field.name;
  }
}

TEST(Bounds, no_field_may_be_longer) {
  for (const auto& field : bounded_fields()) {
    EXPECT_FALSE(field.check(field.bound + 1)) << field.name;
    const auto converted = field.convert(field.bound + 1);
    ASSERT_FALSE(converted) << field.name;
    EXPECT_EQ(converted.error().code, ErrorCode::bad_data) << field.name;
  }
}

TEST(Bounds, the_error_names_topic_field_size_and_bound) {
  TsdTile tile;
  tile.payload.resize(1001);

  EXPECT_EQ(text_of(check_bounds(tile)),
            "lifeline/tsd_tile: payload has 1001 elements, at most 1000 may be sent");
}

TEST(Bounds, a_zero_octet_in_a_text_is_refused) {
  Alert alert;
  alert.text = std::string("do\0wn", 5);

  EXPECT_EQ(text_of(check_bounds(alert)), "lifeline/alert: text holds a zero octet");
}

TEST(Bounds, of_several_broken_bounds_the_first_is_named) {
  HelmetScan scan;
  scan.ranges_cm.resize(641);
  scan.envelope.sender_id = std::string(33, 'x');

  EXPECT_EQ(text_of(check_bounds(scan)),
            "lifeline/scan: envelope.sender_id has 33 elements, at most 32 may be sent");
}

}  // namespace
}  // namespace lifeline::dds
