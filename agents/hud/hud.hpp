#pragma once

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "agents/hud/button_pipe.hpp"
#include "agents/hud/hud_core.hpp"
#include "agents/hud/hud_options.hpp"
#include "agents/hud/pen.hpp"
#include "agents/hud/window.hpp"

namespace lifeline::hud {

/// A helmet's HUD: a thread of its own, 30 pictures a second on the display. Who puts never waits
/// for it longer than a copy takes, and of each thing it sees only the newest. A display that is
/// not there is looked for again; the helmet goes on without it.
class Hud {
 public:
  /// An error where an option cannot be met, ever: no such key, no such folder, no such button.
  [[nodiscard]] static Result<std::unique_ptr<Hud>> start(const HudOptions& options,
                                                          double cell_size_m, const Path& earlier);
  ~Hud();

  void put(const sharing::MapTiles& own);
  void put(const sharing::PeerUpdate& peers);
  void put(HudFacts facts);
  [[nodiscard]] std::vector<HudCommand> take_commands();
  /// On the display, so far.
  [[nodiscard]] std::uint64_t pictures_shown() const { return pictures_shown_; }

 private:
  Hud(HudOptions options, std::optional<ButtonPipe> button, double cell_size_m,
      const Path& earlier);
  void run(const std::stop_token& stop);
  void take_in(SteadyTime now);
  void find_display(SteadyTime now);
  void hear_buttons(SteadyTime now);
  void draw(const HudPicture& picture, SteadyTime now);
  void write_png();

  const HudOptions options_;
  // The HUD's thread.
  HudCore core_;
  std::optional<ButtonPipe> button_;
  std::unique_ptr<Window> window_;
  std::unique_ptr<Pen> pen_;
  SteadyTime display_due_{}, png_due_{};
  bool told_no_display_ = false, told_no_png_ = false, closed_ = false;
  // Both sides'.
  std::atomic<std::uint64_t> pictures_shown_ = 0;
  std::mutex mutex_;
  std::condition_variable_any wake_;
  std::map<TileIndex, std::shared_ptr<const QuantisedTile>> own_;
  std::map<TileIndex, std::shared_ptr<const TsdTile>> peers_;
  std::optional<HudFacts> facts_;
  std::vector<HudCommand> commands_;
  std::jthread thread_;  // last: joined before what it uses goes away
};

}  // namespace lifeline::hud
