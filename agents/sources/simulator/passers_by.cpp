#include "agents/sources/simulator/passers_by.hpp"

#include "agents/sources/simulator/draw.hpp"

namespace lifeline::sources {

PassersBy::PassersBy(const FreeSpace& space, int count, std::uint64_t seed) {
  walks_.reserve(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i) {
    walks_.emplace_back(space, WalkerNumber{.seed = stir(seed, 0), .walker = i});
  }
}

void PassersBy::advance(double t_s, const Eigen::Vector2d& p_world) {
  places_.clear();
  for (Walk& walk : walks_) {
    const Eigen::Vector2d p = walk.pose_at(t_s).translation();
    if ((p - p_world).norm() >= kMakeWayM) places_.push_back(p);
  }
}

}  // namespace lifeline::sources
