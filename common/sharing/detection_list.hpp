#pragma once

#include <cstddef>
#include <map>
#include <vector>

#include "common/base/result.hpp"
#include "common/sharing/fleet_detection.hpp"

namespace lifeline::sharing {

/// Everybody's detections, the own ones included, and the fleet's list that they make under the
/// directive in force. State as with tiles: of each detection the newest revision, whatever came in
/// what order and how often. One owner, not thread-safe.
class DetectionList {
 public:
  /// Of more, those with the lowest ids stay, so that everybody keeps the same.
  static constexpr std::size_t kMostPerHelmet = 64;
  static constexpr std::size_t kMost = 1024;

  /// Takes in a detection whose envelope was accepted (or one of our own). True: it changed what is
  /// held; false: it is an older revision, or a repeat. An error (a number that is not finite, out
  /// of range, one too many) changes nothing.
  ///
  /// One that its own helmet did not send is a *ruling* on it: somebody else confirms it, dismisses
  /// it, or (`reported`) takes that back. Its revision counts the rulings; the newest one's state
  /// stands whatever the helmet says later, and the rest of it only until the helmet is heard.
  [[nodiscard]] Result<bool> apply(const wire::Detection& detection);

  /// From now on layers lie where this directive says, which check_directive() and the epoch's
  /// order have accepted.
  void follow(const wire::MergeDirective& directive);

  /// The fleet's list (associate()), with what was ruled.
  [[nodiscard]] std::vector<FleetDetection> list() const;
  [[nodiscard]] const std::map<DetectionKey, wire::Detection>& held() const { return held_; }
  [[nodiscard]] const std::map<DetectionKey, wire::Detection>& rulings() const { return rulings_; }

 private:
  using Held = std::map<DetectionKey, wire::Detection>;
  [[nodiscard]] static Result<bool> take_in(Held& held, const wire::Detection& detection);

  Held held_;
  Held rulings_;
  std::map<LayerKey, GroupPlace> places_;
};

}  // namespace lifeline::sharing
