#include "tests/bench/radio/pose_ages.hpp"

#include <cstddef>

namespace lifeline::bench {

std::vector<double> ages_on_arrival_s(const std::vector<HeardPose>& poses) {
  std::vector<double> ages_s;
  for (const HeardPose& pose : poses) ages_s.push_back(pose.heard_at_s - pose.sent_at_s);
  return ages_s;
}

std::vector<double> ages_shown_s(const std::vector<HeardPose>& poses, double until_s) {
  constexpr double kEach_s = 0.1;
  std::vector<double> ages_s;
  if (poses.empty()) return ages_s;
  std::size_t newest = 0;
  for (double now_s = poses.front().heard_at_s; now_s < until_s; now_s += kEach_s) {
    while (newest + 1 < poses.size() && poses[newest + 1].heard_at_s <= now_s) ++newest;
    ages_s.push_back(now_s - poses[newest].sent_at_s);
  }
  return ages_s;
}

}  // namespace lifeline::bench
