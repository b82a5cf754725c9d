#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "agents/hud/hud_options.hpp"
#include "common/base/result.hpp"

namespace lifeline::hud {

/// What people and display tell a window.
enum class WindowEvent { button_down, button_up, closed };

/// The helmet's display (SDL 2). All calls from one thread, which also opened it.
class Window {
 public:
  /// Full screen, or a window of `size`. `key`: the keyboard key that is the button, by SDL's name
  /// ("Space"). unavailable where there is no display; wrong_use where there is no such key.
  [[nodiscard]] static Result<std::unique_ptr<Window>> open(std::optional<Size> size,
                                                            const std::string& key);
  ~Window();
  Window(const Window&) = delete;
  Window& operator=(const Window&) = delete;

  /// To be called last by a thread that opened windows, or tried to: frees what SDL keeps for it.
  static void leave_thread();

  /// How large its pictures are: the display's size, or less where that would cost too much to
  /// draw; the display enlarges them.
  [[nodiscard]] Size picture_size() const { return size_; }
  /// Shows a picture of picture_size(), 0xffRRGGBB row by row.
  [[nodiscard]] Result<void> show(std::span<const std::uint32_t> pixels);
  /// What happened since the last call. Never blocks.
  [[nodiscard]] std::vector<WindowEvent> take_events();
  /// What the display was last given, at picture_size(); for tests.
  [[nodiscard]] Result<std::vector<std::uint32_t>> read_back() const;

 private:
  struct Parts;
  Window(std::unique_ptr<Parts> parts, Size size, int key);
  std::unique_ptr<Parts> parts_;
  Size size_;
  int key_;
};

/// Whether `key` names one: SDL's names, e.g. "Space", "Return", "F1".
[[nodiscard]] Result<int> find_key(const std::string& key);

}  // namespace lifeline::hud
