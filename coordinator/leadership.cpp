#include "coordinator/leadership.hpp"

#include <algorithm>

namespace lifeline {

void Leadership::hear(const wire::AgentStatus& status, SteadyTime now) {
  const Name name{status.agent_id, status.envelope.incarnation};
  if (name == own_ || status.role != wire::Role::coordinator) return;
  if (!others_.contains(name) && others_.size() >= kMostOthers) return;
  Part part = Part::follows;
  if (status.state == wire::AgentState::tracking) part = Part::leads;
  if (status.state == wire::AgentState::weak) part = Part::stands_in;
  others_[name] = {part, now};
}

void Leadership::yield(SteadyTime now) {
  leads_ = false;
  since_ = now;
}

bool Leadership::step(SteadyTime now) {
  std::erase_if(others_, [&](const auto& other) {
    return now - other.second.heard_at > config_.silent_after;
  });
  const bool gives_way = std::any_of(others_.begin(), others_.end(), [&](const auto& other) {
    return gives_way_to(other.first, other.second);
  });
  const Duration listen = config_.standby ? config_.standby_listen : config_.listen;
  if (leads_ && gives_way) {
    yield(now);
  } else if (!leads_ && !gives_way && now - since_ >= listen) {
    leads_ = true;
    since_ = now;
  }
  return leads_;
}

bool Leadership::gives_way_to(const Name& name, const Other& other) const {
  if (other.part == Part::follows) return false;
  const bool stands_in = other.part == Part::stands_in;
  if (stands_in != config_.standby) return config_.standby;
  return !leads_ || name < own_;
}

wire::AgentState Leadership::state() const {
  if (!leads_) return wire::AgentState::starting;
  return config_.standby ? wire::AgentState::weak : wire::AgentState::tracking;
}

std::string Leadership::leader() const {
  for (const auto& [name, other] : others_) {
    if (other.part != Part::follows) return name.first;
  }
  return {};
}

}  // namespace lifeline
