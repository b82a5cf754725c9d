#pragma once

#include <memory>
#include <string>
#include <vector>

#include "agents/hud/hud_core.hpp"

namespace lifeline::test {

/// A moment in a building that is drawn, as a HUD shows it.
struct Situation {
  std::string name;
  std::shared_ptr<hud::HudCore> core;  ///< whose map it is
  hud::HudPicture picture;
};

[[nodiscard]] std::vector<Situation> hud_situations();

}  // namespace lifeline::test
