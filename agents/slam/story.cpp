#include "agents/slam/story.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace lifeline::slam {
namespace {

/// Stories with a common past hold copies of it: equal to the bit.
bool tell_the_same(const Story& a, const Story& b) {
  const Pose2 &pa = a.steps.front().match.T_map_head, &pb = b.steps.front().match.T_map_head;
  return pa.x_m == pb.x_m && pa.y_m == pb.y_m && pa.yaw_rad == pb.yaw_rad;
}

bool end_alike(const Story& a, const Story& b, const StoryConfig& config) {
  const Pose2 apart = a.motion.pose().inverse() * b.motion.pose();
  return apart.translation().norm() < config.same_place_m &&
         std::abs(apart.yaw_rad) < config.same_turn_rad;
}

}  // namespace

void keep_likely(std::vector<Story>& stories, const StoryConfig& config) {
  std::stable_sort(stories.begin(), stories.end(),
                   [](const Story& a, const Story& b) { return a.score > b.score; });
  std::vector<Story> kept;
  for (Story& story : stories) {
    if (!kept.empty() && story.score < kept.front().score - config.hopeless) break;
    const bool is_new = std::none_of(kept.begin(), kept.end(), [&](const Story& other) {
      return end_alike(story, other, config);
    });
    if (is_new) kept.push_back(std::move(story));
    if (kept.size() == static_cast<std::size_t>(config.max_stories)) break;
  }
  stories = std::move(kept);
}

bool agree_on_oldest(const std::vector<Story>& stories) {
  return std::all_of(stories.begin() + 1, stories.end(),
                     [&](const Story& story) { return tell_the_same(story, stories.front()); });
}

void settle_oldest(std::vector<Story>& stories) {
  std::erase_if(stories, [best = stories.front()](const Story& story) {
    return !tell_the_same(story, best);
  });
  for (Story& story : stories) story.steps.erase(story.steps.begin());
}

}  // namespace lifeline::slam
