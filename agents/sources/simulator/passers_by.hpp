#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "agents/sources/simulator/free_space.hpp"
#include "agents/sources/simulator/walk.hpp"

namespace lifeline::sources {

/// Other people in the building, who walk about it on ways of their own and pay no heed to doors.
/// They make way for the walker: closer than kMakeWayM none is.
class PassersBy {
 public:
  static constexpr int kMost = 16;
  static constexpr double kMakeWayM = 0.7;

  /// `space` has to outlive them. The same numbers give the same people.
  PassersBy(const FreeSpace& space, int count, std::uint64_t seed);

  /// Moves time on, never backwards; the walker is at `p_world`.
  void advance(double t_s, const Eigen::Vector2d& p_world);
  /// Where they are now, world frame, metres.
  [[nodiscard]] std::span<const Eigen::Vector2d> places() const { return places_; }

 private:
  std::vector<Walk> walks_;
  std::vector<Eigen::Vector2d> places_;
};

}  // namespace lifeline::sources
