#pragma once

#include <fastdds/dds/core/policy/QosPolicies.hpp>

namespace lifeline::dds {

/// Lets every UDP transport of a participant space out its first ACKNACKs (first_acknacks.hpp).
void space_out_first_acknacks(eprosima::fastdds::dds::TransportConfigQos& transports);

}  // namespace lifeline::dds
