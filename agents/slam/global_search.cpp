#include "agents/slam/global_search.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <utility>

namespace lifeline::slam {
namespace {

// Estimated, in steps of SearchWork.
constexpr SearchWork kLookWork = 2;
constexpr SearchWork kOrderWork = 40;  ///< of a node

}  // namespace

void GlobalSearch::clear() {
  field_.clear();
  nodes_ = {};
  stage_ = Stage::done;
}

void GlobalSearch::begin(std::span<const Eigen::Vector2d> points, double yaw_rad, double window_rad,
                         const std::optional<SearchCircle>& circle) {
  found_.clear();
  nodes_.clear();
  circle_ = circle;
  best_ = sure_ = 0;
  next_node_ = 0;
  complete_ = true;
  nodes_left_ = config_.max_nodes;
  stage_ = Stage::done;
  choose_points(points);
  if (points_.empty() || !has_map()) return;
  stage_ = Stage::bounding;
  double lever2_m2 = 0.0;
  for (const Eigen::Vector2d& p : points_) lever2_m2 += p.squaredNorm();
  const double lever_m = std::sqrt(lever2_m2 / static_cast<double>(points_.size()));
  yaw_step_rad_ = std::clamp(1.5 * field_.spacing_m() / lever_m, 0.01, 0.06);
  middle_yaw_rad_ = yaw_rad;
  last_yaw_ = static_cast<int>(std::ceil(std::min(window_rad, M_PI) / yaw_step_rad_));
  next_yaw_ = -last_yaw_;
  among_ = circle ? field_.blocks_around(circle->centre_m, circle->radius_m) : field_.blocks();
}

bool GlobalSearch::advance(SearchWork& work) {
  for (; stage_ == Stage::bounding; ++next_yaw_) {
    if (work <= 0) return false;
    if (next_yaw_ > last_yaw_) {
      order_nodes(work);
      break;
    }
    bound_blocks(next_yaw_, work);
  }
  for (; stage_ == Stage::descending; ++next_node_) {
    if (work <= 0) return false;
    if (next_node_ == nodes_.size() || nodes_left_ <= 0 ||
        nodes_[next_node_].bound < least_score()) {
      finish();
      break;
    }
    const Node& node = nodes_[next_node_];
    if (node.yaw != turned_yaw_) turn_points(node.yaw);
    descend(field_.corner_of(node.block), FitField::kLevels - 1, yaw_of(node.yaw));
    work -= kLookWork * std::exchange(looks_, 0);
  }
  return true;
}

void GlobalSearch::finish() {
  complete_ = complete_ && nodes_left_ > 0;
  std::stable_sort(found_.begin(), found_.end(),
                   [](const auto& a, const auto& b) { return a.agreement > b.agreement; });
  nodes_.clear();
  stage_ = Stage::done;
}

void GlobalSearch::choose_points(std::span<const Eigen::Vector2d> points) {
  const double reach_m = (FitField::kReach - 1) * field_.spacing_m();
  std::vector<Eigen::Vector2d> near;
  for (const Eigen::Vector2d& p : points) {
    if (p.squaredNorm() < reach_m * reach_m) near.push_back(p);
  }
  const std::size_t count = std::min(near.size(), static_cast<std::size_t>(config_.max_points));
  points_.clear();
  for (std::size_t i = 0; i < count; ++i) points_.push_back(near[i * near.size() / count]);
  // So that the first few, which decide whether to go on, stand all around.
  std::vector<Eigen::Vector2d> mixed;
  constexpr std::size_t kStride = 16;
  for (std::size_t first = 0; first < kStride; ++first) {
    for (std::size_t i = first; i < count; i += kStride) mixed.push_back(points_[i]);
  }
  points_ = std::move(mixed);
}

void GlobalSearch::turn_points(int yaw) {
  turned_yaw_ = yaw;
  const double c = std::cos(yaw_of(yaw)) / field_.spacing_m(),
               s = std::sin(yaw_of(yaw)) / field_.spacing_m();
  offsets_.clear();
  for (const Eigen::Vector2d& p : points_) {
    offsets_.push_back({static_cast<std::int32_t>(std::floor(0.5 + c * p.x() - s * p.y())),
                        static_cast<std::int32_t>(std::floor(0.5 + s * p.x() + c * p.y()))});
  }
}

void GlobalSearch::bound_blocks(int yaw, SearchWork& work) {
  turn_points(yaw);
  bounds_.clear();
  field_.bound_blocks(offsets_, among_, least_score(sure_), bounds_, work);
  FitField::BlockBound best{0, 0};
  for (const FitField::BlockBound& bound : bounds_) {
    if (!reaches(field_.corner_of(bound.block), FitField::kBlock)) continue;
    nodes_.push_back({bound.block, bound.bound, static_cast<std::int16_t>(yaw)});
    if (bound.bound > best.bound) best = bound;
  }
  if (best.bound > sure_) dive(field_.corner_of(best.block));
  thin_nodes();
  work -= kLookWork * std::exchange(looks_, 0);
}

/// Follows the best bounds down to a place: what it scores, the best place does at least. So fewer
/// blocks need be kept, and none of those that descend() would come to is missing.
void GlobalSearch::dive(Place corner) {
  for (int level = FitField::kLevels - 1; level > 0; --level) {
    const int half = 1 << (level - 1);
    int best = sure_;
    Place next{-1, -1};
    for (int i = 0; i < 4; ++i) {
      const Place child{corner.column + i % 2 * half, corner.row + i / 2 * half};
      if (level == 1 && !(field_.is_free(child) && reaches(child, 1))) continue;
      const int here = score(level - 1, child, best + 1);
      if (here <= best) continue;
      best = here;
      next = child;
    }
    if (next.column < 0) return;
    corner = next;
    if (level == 1) sure_ = best;
  }
}

/// Forgets nodes that will never be come to: each takes four of nodes_left_ at least.
void GlobalSearch::thin_nodes() {
  const std::size_t most = static_cast<std::size_t>(config_.max_nodes) / 4 + 1;
  if (nodes_.size() < 2 * most) return;
  std::vector<std::int16_t> bounds;
  for (const Node& node : nodes_) bounds.push_back(node.bound);
  const auto last = bounds.begin() + static_cast<std::ptrdiff_t>(most) - 1;
  std::nth_element(bounds.begin(), last, bounds.end(), std::greater<>());
  const int least = std::max<int>(*last, least_score(sure_));
  std::erase_if(nodes_, [&](const Node& node) { return node.bound < least; });
}

void GlobalSearch::order_nodes(SearchWork& work) {
  std::erase_if(nodes_, [&](const Node& node) { return node.bound < least_score(sure_); });
  std::stable_sort(nodes_.begin(), nodes_.end(),
                   [](const Node& a, const Node& b) { return a.bound > b.bound; });
  work -= kOrderWork * static_cast<SearchWork>(nodes_.size());
  stage_ = Stage::descending;
}

/// Whether any of a square of places is in the circle.
bool GlobalSearch::reaches(Place corner, int side) const {
  if (!circle_) return true;
  const Eigen::Vector2d low = field_.centre_of(corner);
  const Eigen::Vector2d high = low.array() + (side - 1) * field_.spacing_m();
  const Eigen::Vector2d nearest = circle_->centre_m.cwiseMax(low).cwiseMin(high);
  return (nearest - circle_->centre_m).norm() <= circle_->radius_m;
}

int GlobalSearch::score(int level, Place corner, int least) {
  constexpr std::size_t kAtOnce = 16;
  int sum = 0;
  for (std::size_t i = 0; i < offsets_.size();) {
    const std::size_t end = std::min(i + kAtOnce, offsets_.size());
    looks_ += static_cast<SearchWork>(end - i);
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

int GlobalSearch::least_score(int best) const {
  const double points = static_cast<double>(points_.size());
  const double min_agreement = circle_ ? circle_->min_agreement : config_.min_agreement;
  return std::max(static_cast<int>(std::ceil(min_agreement * FitField::kFull * points)),
                  best - static_cast<int>(config_.margin * FitField::kFull * points));
}

}  // namespace lifeline::slam
