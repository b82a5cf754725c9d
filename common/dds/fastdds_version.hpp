#pragma once

// Everything that belongs to the 2.9 series of Fast DDS and looks different in the 3 series: the
// `fastrtps/` headers, ReturnCode_t, the XML profile manager. Included by the sources of common/dds
// only.

#include <string_view>

#include <fastdds/dds/core/status/IncompatibleQosStatus.hpp>
#include <fastdds/dds/core/status/StatusMask.hpp>
#include <fastdds/dds/domain/DomainParticipant.hpp>
#include <fastdds/dds/domain/DomainParticipantFactory.hpp>
#include <fastdds/dds/domain/DomainParticipantListener.hpp>
#include <fastdds/dds/log/Log.hpp>
#include <fastdds/dds/publisher/DataWriter.hpp>
#include <fastdds/dds/publisher/DataWriterListener.hpp>
#include <fastdds/dds/publisher/Publisher.hpp>
#include <fastdds/dds/subscriber/DataReader.hpp>
#include <fastdds/dds/subscriber/DataReaderListener.hpp>
#include <fastdds/dds/subscriber/SampleInfo.hpp>
#include <fastdds/dds/subscriber/Subscriber.hpp>
#include <fastdds/dds/topic/Topic.hpp>
#include <fastdds/dds/topic/TopicDataType.hpp>
#include <fastdds/dds/topic/TypeSupport.hpp>
#include <fastrtps/attributes/ParticipantAttributes.h>
#include <fastrtps/attributes/PublisherAttributes.h>
#include <fastrtps/attributes/SubscriberAttributes.h>
#include <fastrtps/types/TypesBase.h>
#include <fastrtps/xmlparser/XMLProfileManager.h>

namespace lifeline::dds {

namespace fast = eprosima::fastdds::dds;
namespace rtps = eprosima::fastrtps::rtps;
using ReturnCode = eprosima::fastrtps::types::ReturnCode_t;

[[nodiscard]] inline bool is_ok(ReturnCode code) {
  return code == ReturnCode::RETCODE_OK;
}

/// What a return code says, for messages to people.
[[nodiscard]] inline std::string_view describe(ReturnCode code) {
  switch (code()) {
    case ReturnCode::RETCODE_TIMEOUT:
      return "no room in the history, or a lock held too long";
    case ReturnCode::RETCODE_OUT_OF_RESOURCES:
      return "out of resources";
    case ReturnCode::RETCODE_BAD_PARAMETER:
      return "bad parameter";
    case ReturnCode::RETCODE_PRECONDITION_NOT_MET:
      return "precondition not met";
    case ReturnCode::RETCODE_INCONSISTENT_POLICY:
      return "QoS policies that contradict each other";
    case ReturnCode::RETCODE_NOT_ENABLED:
      return "not enabled";
    default:
      return "middleware error";
  }
}

/// Process-wide state of the XML parser. All of it is static in the library: callers hold
/// profiles_mutex().
namespace xml {

using Manager = eprosima::fastrtps::xmlparser::XMLProfileManager;
inline constexpr auto kOk = eprosima::fastrtps::xmlparser::XMLP_ret::XML_OK;

/// Forgets every profile loaded so far. Entities keep what they were made with.
inline void forget_profiles() {
  Manager::DeleteInstance();
}

[[nodiscard]] inline bool has_participant(const std::string& profile) {
  eprosima::fastrtps::ParticipantAttributes attributes;
  return Manager::fillParticipantAttributes(profile, attributes, false) == kOk;
}
[[nodiscard]] inline bool has_writer(const std::string& profile) {
  eprosima::fastrtps::PublisherAttributes attributes;
  return Manager::fillPublisherAttributes(profile, attributes, false) == kOk;
}
[[nodiscard]] inline bool has_reader(const std::string& profile) {
  eprosima::fastrtps::SubscriberAttributes attributes;
  return Manager::fillSubscriberAttributes(profile, attributes, false) == kOk;
}

}  // namespace xml

}  // namespace lifeline::dds
