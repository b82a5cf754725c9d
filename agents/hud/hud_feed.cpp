#include "agents/hud/hud_feed.hpp"

#include "common/base/log.hpp"

namespace lifeline::hud {
namespace {

// As often as SLAM hands over.
constexpr Duration kFactsInterval = std::chrono::milliseconds(100);

Result<void> follow(const HudCommand& command, sharing::HelmetSharing& helmet) {
  switch (command.kind) {
    case HudCommand::Kind::mayday:
      return helmet.raise_mayday("");
    case HudCommand::Kind::all_well:
      return helmet.cancel_mayday();
    case HudCommand::Kind::answer:
      break;
  }
  return helmet.answer(command.alert);
}

}  // namespace

void HudFeed::attach(sharing::HelmetSharing& helmet) {
  if (hud_ == nullptr) return;
  advice_ = std::make_shared<SearchAdvice>(helmet.map().store().geometry().cell_size_m);
  helmet.set_map_listener([advice = advice_](TileIndex tile) { advice->mark(tile); });
}

void HudFeed::step(sharing::HelmetSharing& helmet, SteadyTime now) {
  if (hud_ == nullptr) return;
  if (advice_ != nullptr) advice_->step(helmet, now);
  bool acted = false;
  for (const HudCommand& command : hud_->take_commands()) {
    if (auto done = follow(command, helmet); !done) spdlog::warn("{}", done.error().text);
    acted = true;
  }
  if (now < facts_due_ && !acted) return;
  facts_due_ = now + kFactsInterval;
  // A lidar that is silent makes no newer map, however often its state is told.
  if (helmet.state().scans != scans_) mapped_at_ = now;
  scans_ = helmet.state().scans;
  HudFacts facts = collect_facts(helmet, mapped_at_);
  if (advice_ != nullptr) facts.search = advice_->facts();
  hud_->put(std::move(facts));
}

}  // namespace lifeline::hud
