#include "tests/support/fleet.hpp"

#include <algorithm>

#include "agents/sources/open_source.hpp"
#include "common/base/check.hpp"
#include "tests/support/fleet_channels.hpp"

namespace lifeline::test {
Helmet::Helmet(const std::string& id, std::unique_ptr<sensing::ScanSource> source,
               wire::LoopbackBus& bus, const Clock& clock)
    : source_(std::move(source)),
      mapper_({}, {}, {}),
      sharing_(sharing_config(id), helmet_channels(bus), clock) {}

void Helmet::step() {
  if (source_ != nullptr) {
    auto scan = source_->next();
    LIFELINE_CHECK(scan.has_value());
    if (scan->has_value()) {
      mapper_.step(**scan);
    } else {
      source_.reset();
    }
  }
  sharing::HelmetState state = mapper_.state();
  if (finished()) state.state = wire::AgentState::finished;
  sharing_.put(mapper_.take_changed_tiles());
  sharing_.put(std::move(state));
  sharing_.step();
  if (auto peers = sharing_.take_peer_update()) mapper_.apply(*peers);
}

Fleet::Fleet(const std::vector<std::string>& sources, CoordinatorSettings settings) {
  for (std::size_t i = 0; i < sources.size(); ++i) {
    auto source = sources::open_source(sources[i]);
    LIFELINE_CHECK(source.has_value());
    helmets_.push_back(
        std::make_unique<Helmet>("helmet" + std::to_string(i), *std::move(source), bus_, clock_));
  }
  coordinator_ = std::make_unique<Coordinator>(std::move(settings), coordinator_channels(bus_),
                                               worker_, clock_);
}

void Fleet::step() {
  clock_.advance(kTick);
  for (auto& helmet : helmets_) helmet->step();
  coordinator_->step();
}

bool Fleet::finished() const {
  return std::all_of(helmets_.begin(), helmets_.end(),
                     [](const auto& helmet) { return helmet->finished(); });
}

Settlement Fleet::run(Duration deadline) {
  Settlement now = Settlement::working;
  for (Duration passed{}; passed < deadline && now != Settlement::shared; passed += kTick) {
    step();
    if (finished()) now = settlement(*coordinator_, helmets_.size());
  }
  return now;
}

CoordinatorSettings Fleet::default_settings() {
  return {speaker("coordinator"), GridGeometry{}, {}, {}};
}

Pose2 true_T_world_map(const HelmetMapper& mapper) {
  return mapper.truth().front().pose * mapper.trajectory().front().pose.inverse();
}

Pose2 true_T_a_b(const HelmetMapper& a, const HelmetMapper& b) {
  return true_T_world_map(a).inverse() * true_T_world_map(b);
}

}  // namespace lifeline::test
