#include "common/dds/patient_transport.hpp"

#include <memory>
#include <utility>

#include <fastdds/rtps/network/SenderResource.h>
#include <fastdds/rtps/transport/ChainingTransport.h>
#include <fastdds/rtps/transport/ChainingTransportDescriptor.h>
#include <fastdds/rtps/transport/UDPTransportDescriptor.h>

#include "common/dds/fastdds_version.hpp"
#include "common/dds/first_acknacks.hpp"

namespace lifeline::dds {
namespace {

namespace transport = eprosima::fastdds::rtps;

/// Hands everything on but the ACKNACKs that come too soon: those are as if lost on the way.
class PatientTransport final : public transport::ChainingTransport {
 public:
  using ChainingTransport::ChainingTransport;

  bool send(rtps::SenderResource* low_sender, const rtps::octet* message, std::uint32_t size,
            rtps::LocatorsIterator* destinations_begin, rtps::LocatorsIterator* destinations_end,
            const std::chrono::steady_clock::time_point& timeout) override {
    if (!first_acknacks_.may_send({message, size}, std::chrono::steady_clock::now())) return true;
    return low_sender->send(message, size, destinations_begin, destinations_end, timeout);
  }
  transport::TransportDescriptorInterface* get_configuration() override {
    return low_level_transport_->get_configuration();
  }
  void receive(transport::TransportReceiverInterface* next, const rtps::octet* message,
               std::uint32_t size, const rtps::Locator_t& local,
               const rtps::Locator_t& remote) override {
    next->OnDataReceived(message, size, local, remote);
  }

 private:
  FirstAckNacks first_acknacks_;
};

struct PatientTransportDescriptor final : transport::ChainingTransportDescriptor {
  using transport::ChainingTransportDescriptor::ChainingTransportDescriptor;

  [[nodiscard]] transport::TransportInterface* create_transport() const override {
    return new PatientTransport(*this);  // Fast DDS takes it over
  }
};

}  // namespace

void space_out_first_acknacks(fast::TransportConfigQos& transports) {
  for (auto& each : transports.user_transports) {
    if (std::dynamic_pointer_cast<transport::UDPTransportDescriptor>(each) != nullptr)
      each = std::make_shared<PatientTransportDescriptor>(std::move(each));
  }
}

}  // namespace lifeline::dds
