#include "common/dds/cdr_samples.hpp"

#include <algorithm>

#include "common/base/check.hpp"
#include "common/dds/bounds.hpp"
#include "common/dds/convert.hpp"
#include "common/dds/topics.hpp"
#include "common/dds/type_support.hpp"

namespace lifeline::dds {

template <typename Message>
Result<std::vector<std::uint8_t>> to_cdr(const Message& message) {
  SampleOf<Message> sample;
  if (const auto converted = to_idl(message, sample.value); !converted)
    return forward_error(converted);
  TypeSupportOf<Message> type;
  rtps::SerializedPayload_t payload(type.getSerializedSizeProvider(&sample)());
  LIFELINE_CHECK(type.serialize(&sample, &payload));
  return std::vector<std::uint8_t>(payload.data, payload.data + payload.length);
}

template <typename Message>
Result<Message> from_cdr(std::span<const std::uint8_t> octets) {
  TypeSupportOf<Message> type;
  SampleOf<Message> sample;
  if (octets.size() <= type.m_typeSize) {
    rtps::SerializedPayload_t payload(static_cast<std::uint32_t>(octets.size()));
    std::copy(octets.begin(), octets.end(), payload.data);
    payload.length = static_cast<std::uint32_t>(octets.size());
    type.deserialize(&payload, &sample);
  } else {
    sample.decodable = false;
  }
  if (!sample.decodable) {
    return fail(ErrorCode::bad_data, "its {} octets are no {}", octets.size(),
                topic_of<Message>().type);
  }
  Message message = from_idl(sample.value);
  if (const auto bounded = check_bounds(message); !bounded) return forward_error(bounded);
  return message;
}

#define LIFELINE_CDR(Message)                                        \
  template Result<std::vector<std::uint8_t>> to_cdr(const Message&); \
  template Result<Message> from_cdr(std::span<const std::uint8_t> octets);

LIFELINE_CDR(wire::HelmetPose)
LIFELINE_CDR(wire::HelmetScan)
LIFELINE_CDR(wire::TsdTile)
LIFELINE_CDR(wire::TileRequest)
LIFELINE_CDR(wire::TileCopy)
LIFELINE_CDR(wire::MergeDirective)
LIFELINE_CDR(wire::DirectiveCopy)
LIFELINE_CDR(wire::MergeEvidence)
LIFELINE_CDR(wire::AgentStatus)
LIFELINE_CDR(wire::Detection)
LIFELINE_CDR(wire::Alert)

#undef LIFELINE_CDR

}  // namespace lifeline::dds
