#pragma once

#include <algorithm>
#include <optional>

#include "common/base/time.hpp"

namespace lifeline::hud {

/// What one button says.
enum class Press { none, brief, held };

/// One button under a glove: a brief press is one thing, held for two seconds is another. Contacts
/// that bounce, and fingers that slip for a moment, change nothing. One owner, not thread-safe.
class Button {
 public:
  static constexpr Duration kHold = std::chrono::seconds(2);
  /// Released for no longer than this, it was not released.
  static constexpr Duration kBounce = std::chrono::milliseconds(60);
  static constexpr Duration kLongestBrief = std::chrono::seconds(1);
  /// From here on the bar is shown: a brief press is over by then.
  static constexpr Duration kShowAfter = std::chrono::milliseconds(250);

  /// The contact closes or opens; repeats change nothing.
  void set_down(bool down, SteadyTime now) {
    if (down == down_) return;
    down_ = down;
    if (!down) {
      released_at_ = now;
    } else if (!pressed_at_) {
      pressed_at_ = now;
      told_ = false;
    }
  }

  /// What has become of it: each press is told once.
  [[nodiscard]] Press step(SteadyTime now) {
    if (!pressed_at_) return Press::none;
    const SteadyTime until = down_ ? now : released_at_;
    if (!told_ && until - *pressed_at_ >= kHold) {
      told_ = true;
      return Press::held;
    }
    if (down_ || now - released_at_ < kBounce) return Press::none;
    const bool is_brief = !told_ && released_at_ - *pressed_at_ <= kLongestBrief;
    pressed_at_.reset();
    return is_brief ? Press::brief : Press::none;  // let go of in between: thought better of it
  }

  /// How much of a hold is done, 0 to 1; 0 until it is one.
  [[nodiscard]] double held_share(SteadyTime now) const {
    if (!down_ || !pressed_at_ || told_ || now - *pressed_at_ < kShowAfter) return 0.0;
    return std::min(1.0, to_seconds(now - *pressed_at_) / to_seconds(kHold));
  }

 private:
  bool down_ = false;
  bool told_ = false;
  std::optional<SteadyTime> pressed_at_;
  SteadyTime released_at_{};
};

}  // namespace lifeline::hud
