#include "agents/slam/global_search.hpp"

#include <algorithm>
#include <cmath>

namespace lifeline::slam {
namespace {}  // namespace

GlobalSearchResult GlobalSearch::search(std::span<const Eigen::Vector2d> points, double yaw_rad,
                                        double window_rad,
                                        const std::optional<SearchCircle>& circle) {
  found_.clear();
  circle_ = circle;
  best_ = 0;
  complete_ = true;
  nodes_left_ = config_.max_nodes;
  choose_points(points);
  if (points_.empty() || !has_map()) return {};
  double lever2_m2 = 0.0;
  for (const Eigen::Vector2d& p : points_) lever2_m2 += p.squaredNorm();
  const double lever_m = std::sqrt(lever2_m2 / static_cast<double>(points_.size()));
  const double step_rad = std::clamp(1.5 * field_.spacing_m() / lever_m, 0.01, 0.06);
  const int yaws = static_cast<int>(std::ceil(std::min(window_rad, M_PI) / step_rad));
  std::vector<Node> nodes;
  for (int k = -yaws; k <= yaws; ++k) {
    turn_points(yaw_rad + k * step_rad);
    bound_blocks(k, nodes);
  }
  std::stable_sort(nodes.begin(), nodes.end(),
                   [](const Node& a, const Node& b) { return a.bound > b.bound; });
  int turned = yaws + 1;
  for (const Node& node : nodes) {
    if (node.bound < least_score()) break;
    if (node.yaw != turned) turn_points(yaw_rad + node.yaw * step_rad);
    turned = node.yaw;
    descend(node.corner, FitField::kLevels - 1, yaw_rad + node.yaw * step_rad);
    if (nodes_left_ <= 0) break;
  }
  complete_ = complete_ && nodes_left_ > 0;
  std::stable_sort(found_.begin(), found_.end(),
                   [](const auto& a, const auto& b) { return a.agreement > b.agreement; });
  return {found_, complete_};
}

void GlobalSearch::choose_points(std::span<const Eigen::Vector2d> points) {
  const auto most = static_cast<std::size_t>(config_.max_points);
  const std::size_t count = std::min(points.size(), most);
  points_.clear();
  for (std::size_t i = 0; i < count; ++i) points_.push_back(points[i * points.size() / count]);
  // So that the first few, which decide whether to go on, stand all around.
  std::vector<Eigen::Vector2d> mixed;
  constexpr std::size_t kStride = 16;
  for (std::size_t first = 0; first < kStride; ++first) {
    for (std::size_t i = first; i < count; i += kStride) mixed.push_back(points_[i]);
  }
  points_ = std::move(mixed);
}

void GlobalSearch::turn_points(double yaw_rad) {
  const double c = std::cos(yaw_rad) / field_.spacing_m(),
               s = std::sin(yaw_rad) / field_.spacing_m();
  offsets_.clear();
  for (const Eigen::Vector2d& p : points_) {
    offsets_.push_back({static_cast<std::int32_t>(std::floor(0.5 + c * p.x() - s * p.y())),
                        static_cast<std::int32_t>(std::floor(0.5 + s * p.x() + c * p.y()))});
  }
}

void GlobalSearch::bound_blocks(int yaw, std::vector<Node>& nodes) {
  field_.bound_blocks(offsets_, sums_);
  const int least = least_score();
  for (std::size_t block = 0; block < sums_.size(); ++block) {
    if (sums_[block] < least || !field_.has_free_place(block)) continue;
    if (!reaches(field_.corner_of(block), 1 << (FitField::kLevels - 1))) continue;
    nodes.push_back({sums_[block], yaw, field_.corner_of(block)});
  }
}

/// Whether any of a square of places is in the circle.
bool GlobalSearch::reaches(Place corner, int side) const {
  if (!circle_) return true;
  const Eigen::Vector2d low = field_.centre_of(corner);
  const Eigen::Vector2d high = low.array() + (side - 1) * field_.spacing_m();
  const Eigen::Vector2d nearest = circle_->centre_m.cwiseMax(low).cwiseMin(high);
  return (nearest - circle_->centre_m).norm() <= circle_->radius_m;
}

int GlobalSearch::score(int level, Place corner, int least) const {
  constexpr std::size_t kAtOnce = 16;
  int sum = 0;
  for (std::size_t i = 0; i < offsets_.size();) {
    const std::size_t end = std::min(i + kAtOnce, offsets_.size());
    for (; i < end; ++i) {
      const Place cell{corner.column + offsets_[i].column, corner.row + offsets_[i].row};
      if (field_.contains(cell)) sum += field_.fit(level, cell);
    }
    if (sum + FitField::kFull * static_cast<int>(offsets_.size() - i) < least)
      return sum - 1'000'000;
  }
  return sum;
}

void GlobalSearch::descend(Place corner, int level, double yaw_rad) {
  if (level == 0) {
    if (field_.is_free(corner) && reaches(corner, 1))
      note(score(0, corner, least_score()), corner, yaw_rad);
    return;
  }
  const int half = 1 << (level - 1);
  std::array<std::pair<int, Place>, 4> children;
  for (std::size_t i = 0; i < 4; ++i) {
    const Place child{corner.column + (i % 2 == 1 ? half : 0), corner.row + (i > 1 ? half : 0)};
    children[i] = {score(level - 1, child, least_score()), child};
  }
  nodes_left_ -= 4;
  std::stable_sort(children.begin(), children.end(),
                   [](const auto& a, const auto& b) { return a.first > b.first; });
  for (const auto& [bound, child] : children) {
    if (bound < least_score() || nodes_left_ <= 0) break;
    descend(child, level - 1, yaw_rad);
  }
}

void GlobalSearch::note(int score, Place place, double yaw_rad) {
  if (score < least_score()) return;
  best_ = std::max(best_, score);
  const Eigen::Vector2d at_m = field_.centre_of(place);
  const GlobalCandidate here{
      {at_m.x(), at_m.y(), normalise_angle(yaw_rad)},
      static_cast<double>(score) / FitField::kFull / static_cast<double>(points_.size())};
  const auto same = std::find_if(found_.begin(), found_.end(), [&](const GlobalCandidate& other) {
    const Pose2 &a = here.T_map_head, &b = other.T_map_head;
    return (a.translation() - b.translation()).norm() < config_.apart_m &&
           std::abs(normalise_angle(a.yaw_rad - b.yaw_rad)) < config_.apart_rad;
  });
  if (same != found_.end()) {
    if (here.agreement > same->agreement) *same = here;
    return;
  }
  const double hopeless =
      static_cast<double>(least_score()) / FitField::kFull / static_cast<double>(points_.size());
  std::erase_if(found_, [&](const GlobalCandidate& other) { return other.agreement < hopeless; });
  if (found_.size() < config_.max_candidates) {
    found_.push_back(here);
    return;
  }
  complete_ = false;
  const auto worst =
      std::min_element(found_.begin(), found_.end(),
                       [](const auto& a, const auto& b) { return a.agreement < b.agreement; });
  if (here.agreement > worst->agreement) *worst = here;
}

int GlobalSearch::least_score() const {
  const double points = static_cast<double>(points_.size());
  const double min_agreement = circle_ ? circle_->min_agreement : config_.min_agreement;
  return std::max(static_cast<int>(std::ceil(min_agreement * FitField::kFull * points)),
                  best_ - static_cast<int>(config_.margin * FitField::kFull * points));
}

}  // namespace lifeline::slam
