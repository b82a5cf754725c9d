#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "common/base/result.hpp"

namespace lifeline::hud {

/// Pixels across and down.
struct Size {
  int width = 0;
  int height = 0;
  bool operator==(const Size&) const = default;
};

/// "800x480"; from 160x96 to 3840x2160.
[[nodiscard]] Result<Size> parse_size(const std::string& text);

/// What a HUD is shown on, and by what it hears its wearer.
struct HudOptions {
  bool display = false;
  std::optional<Size> size;   ///< of a window; full screen without. Of the PNG: 800 x 480 without
  std::string key = "Space";  ///< the button, by SDL's name of the key
  std::optional<std::filesystem::path> png;     ///< rewritten each second
  std::optional<std::filesystem::path> button;  ///< see ButtonPipe

  [[nodiscard]] bool wanted() const { return display || png || button; }
};

}  // namespace lifeline::hud
