#pragma once

#include <string>

#include "agents/hud/hud_facts.hpp"

namespace lifeline::test {

/// A helmet that knows where it is and hears its command; `now` is any time.
inline hud::HudFacts sound_facts(SteadyTime now) {
  hud::HudFacts facts;
  facts.id = "alpha";
  facts.state.state = wire::AgentState::tracking;
  facts.state.trust_percent = 95;
  facts.mapped_at = now;
  facts.command_at = facts.mate_at = facts.shared_at = now;
  return facts;
}

inline hud::AlertFacts open_alert(wire::AlertKind kind, const std::string& issuer,
                                  const std::string& about = "") {
  hud::AlertFacts alert;
  alert.key = {issuer, 1};
  alert.kind = kind;
  alert.about = about;
  return alert;
}

}  // namespace lifeline::test
