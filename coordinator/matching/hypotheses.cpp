#include "coordinator/matching/hypotheses.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace lifeline::matching {
namespace {

constexpr double kSamePlace_m = 0.5;
constexpr double kSameYaw_rad = 3.0 * std::numbers::pi / 180.0;

}  // namespace

void keep_best(std::vector<Hypothesis>& hypotheses, std::size_t count) {
  std::stable_sort(hypotheses.begin(), hypotheses.end(),
                   [](const auto& x, const auto& y) { return x.score > y.score; });
  if (hypotheses.size() > count) hypotheses.resize(count);
}

void keep_distinct(std::vector<Hypothesis>& hypotheses, const Eigen::Vector2d& p_b) {
  std::vector<Hypothesis> kept;
  for (const Hypothesis& h : hypotheses) {
    const bool distinct = std::none_of(kept.begin(), kept.end(), [&](const Hypothesis& other) {
      return (h.T_a_b * p_b - other.T_a_b * p_b).norm() < kSamePlace_m &&
             std::abs(normalise_angle(h.T_a_b.yaw_rad - other.T_a_b.yaw_rad)) < kSameYaw_rad;
    });
    if (distinct) kept.push_back(h);
  }
  hypotheses = std::move(kept);
}

}  // namespace lifeline::matching
