#include "deploy/demo/merge_error.hpp"

#include <cmath>
#include <numbers>
#include <set>

namespace lifeline::demo {

MergeError merge_error(const Pose2& T_a_b, const Pose2& T_a_b_true,
                       const Eigen::Vector2d& centre_b) {
  const double angle_rad = normalise_angle(T_a_b.yaw_rad - T_a_b_true.yaw_rad);
  return {.at_centre_m = (T_a_b * centre_b - T_a_b_true * centre_b).norm(),
          .at_origin_m = (T_a_b.translation() - T_a_b_true.translation()).norm(),
          .angle_deg = std::abs(angle_rad) * 180.0 / std::numbers::pi};
}

bool all_in_one_map(const std::vector<std::string>& helmets,
                    const std::vector<std::pair<std::string, std::string>>& merges) {
  if (helmets.empty()) return false;
  std::set<std::string> reached{helmets.front()};
  for (std::size_t before = 0; before != reached.size();) {
    before = reached.size();
    for (const auto& [a, b] : merges) {
      if (reached.contains(a)) reached.insert(b);
      if (reached.contains(b)) reached.insert(a);
    }
  }
  for (const std::string& helmet : helmets) {
    if (!reached.contains(helmet)) return false;
  }
  return true;
}

}  // namespace lifeline::demo
