#pragma once

#include <memory>

#include "agents/hud/hud.hpp"
#include "agents/hud/search_advice.hpp"

namespace lifeline::hud {

/// Between a helmet's sharing half and its HUD: tells the HUD what there is to see, and does what
/// its wearer asks for. Used by the sharing thread.
class HudFeed {
 public:
  /// Without a HUD it does nothing.
  explicit HudFeed(std::unique_ptr<Hud> hud) : hud_(std::move(hud)) {}

  /// Hears of what changes on the helmet's common map. Before the helmet's first step.
  void attach(sharing::HelmetSharing& helmet);

  template <typename Cells>
  void pass(const Cells& cells) {
    if (hud_ != nullptr) hud_->put(cells);
  }
  void step(sharing::HelmetSharing& helmet, SteadyTime now);

 private:
  std::unique_ptr<Hud> hud_;
  std::shared_ptr<SearchAdvice> advice_;  ///< the helmet tells it of its map
  SteadyTime facts_due_{};
  std::optional<SteadyTime> mapped_at_;
  std::uint64_t scans_ = 0;
};

}  // namespace lifeline::hud
