#pragma once

#include <string>

#include "agents/sharing/helmet_sharing.hpp"
#include "common/base/result.hpp"
#include "common/dds/participant.hpp"

namespace lifeline {

/// Opens a helmet's ends of the topics. `interface`: the network interface by whose counter the
/// budget is held, or `none`. `sees_mates`: where the team-mates are is heard too.
[[nodiscard]] Result<sharing::HelmetChannels> open_channels(dds::Participant& participant,
                                                            const std::string& interface,
                                                            bool sees_mates);

}  // namespace lifeline
