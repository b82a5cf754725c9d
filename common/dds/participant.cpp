#include "common/dds/participant.hpp"

#include "common/dds/participant_core.hpp"

namespace lifeline::dds {

Result<std::unique_ptr<Participant>> Participant::create(const ParticipantOptions& options) {
  auto core = ParticipantCore::create(options, mission_profiles());
  if (!core) return forward_error(core);
  return std::unique_ptr<Participant>(new Participant(std::move(*core)));
}

Participant::Participant(std::shared_ptr<ParticipantCore> core) : core_(std::move(core)) {}
Participant::~Participant() = default;

bool Participant::wait_for_data(Duration timeout) {
  return core_->doorbell.wait(timeout);
}
void Participant::wake() {
  core_->doorbell.ring();
}
std::uint64_t Participant::octets_on_air() const {
  return core_->octets_on_air.load();
}

std::uint64_t Participant::bytes_sent() const {
  return core_->bytes_sent.load();
}

}  // namespace lifeline::dds
