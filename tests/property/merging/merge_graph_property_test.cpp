// Random graphs of merges against slow reference code: all subsets of edges, and a plain
// Gauss-Newton with numeric derivatives.
#include <algorithm>
#include <cmath>
#include <random>
#include <set>

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <gtest/gtest.h>

#include "coordinator/merging/consistent_edges.hpp"
#include "coordinator/merging/refine_places.hpp"
#include "tests/support/sharing_samples.hpp"

namespace lifeline::merging {
namespace {

/// True places of some layers, and edges between them of which some are grossly wrong.
struct RandomGraph {
  std::vector<LayerKey> layers;
  std::vector<Pose2> truth;
  EdgeMap edges;
  std::set<LayerPair> wrong;
};

class Dice {
 public:
  explicit Dice(unsigned seed) : random_(seed) {}
  double between(double low, double high) {
    return low + (high - low) * static_cast<double>(random_()) / 4294967295.0;
  }
  bool chance(double probability) { return between(0, 1) < probability; }
  Pose2 pose(double reach_m) {
    return {between(-reach_m, reach_m), between(-reach_m, reach_m), between(-3, 3)};
  }

 private:
  std::mt19937 random_;
};

RandomGraph random_graph(unsigned seed, int layers, std::size_t most_edges, double wrong_share) {
  Dice dice(seed);
  RandomGraph graph;
  for (int i = 0; i < layers; ++i) {
    graph.layers.push_back(test::layer(std::string(1, static_cast<char>('a' + i))));
    graph.truth.push_back(dice.pose(20));
  }
  for (std::size_t a = 0; a < graph.layers.size(); ++a) {
    for (std::size_t b = a + 1; b < graph.layers.size(); ++b) {
      if (graph.edges.size() == most_edges || dice.chance(0.25)) continue;
      const LayerPair pair{graph.layers[a], graph.layers[b]};
      MergeEdge edge{graph.truth[a].inverse() * graph.truth[b],
                     Eigen::Matrix3d::Identity() * 1e-5,
                     dice.between(0.3, 0.9),
                     {dice.between(-5, 5), dice.between(-5, 5)},
                     false};
      // Noise at the middle of the overlap, as matching has it.
      const Pose2 T_b_centre{edge.overlap_centre_b_m.x(), edge.overlap_centre_b_m.y(), 0};
      Pose2 noise{dice.between(-0.02, 0.02), dice.between(-0.02, 0.02), dice.between(-2e-3, 2e-3)};
      if (dice.chance(wrong_share)) {
        noise = dice.pose(6);
        noise.x_m += noise.x_m < 0 ? -2 : 2;
        graph.wrong.insert(pair);
      }
      edge.T_a_b = edge.T_a_b * T_b_centre * noise * T_b_centre.inverse();
      graph.edges.emplace(pair, edge);
    }
  }
  return graph;
}

std::size_t number(const RandomGraph& graph, const LayerKey& layer) {
  return static_cast<std::size_t>(std::find(graph.layers.begin(), graph.layers.end(), layer) -
                                  graph.layers.begin());
}

std::vector<PlaceEdge> place_edges(const RandomGraph& graph, const std::vector<LayerPair>& chosen) {
  std::vector<PlaceEdge> edges;
  for (const LayerPair& pair : chosen) {
    const MergeEdge& edge = graph.edges.at(pair);
    edges.push_back(
        {number(graph, pair.a), number(graph, pair.b), edge.T_a_b, believed_covariance(edge)});
  }
  return edges;
}

/// Gauss-Newton with numeric derivatives; the first of each component stays where it starts.
struct Reference {
  std::vector<Pose2> places;
  double cost = 0.0;  ///< sum of squared errors in standard deviations
  Eigen::MatrixXd information;
};

Eigen::VectorXd errors(const std::vector<Pose2>& places, const std::vector<PlaceEdge>& edges) {
  Eigen::VectorXd all(3 * static_cast<Eigen::Index>(edges.size()));
  for (std::size_t i = 0; i < edges.size(); ++i) {
    const Pose2 T_a_b = places[edges[i].a].inverse() * places[edges[i].b];
    const Eigen::Vector3d error{T_a_b.x_m - edges[i].T_a_b.x_m, T_a_b.y_m - edges[i].T_a_b.y_m,
                                normalise_angle(T_a_b.yaw_rad - edges[i].T_a_b.yaw_rad)};
    const Eigen::Matrix3d information = edges[i].covariance.inverse();
    all.segment<3>(3 * static_cast<Eigen::Index>(i)) = information.llt().matrixU() * error;
  }
  return all;
}

Reference solve_slowly(std::vector<Pose2> places, const std::vector<PlaceEdge>& edges,
                       const std::set<std::size_t>& fixed) {
  Reference reference;
  std::vector<std::size_t> free;
  for (std::size_t i = 0; i < places.size(); ++i) {
    if (!fixed.contains(i)) free.push_back(i);
  }
  const auto unknowns = 3 * static_cast<Eigen::Index>(free.size());
  const auto moved = [&](std::vector<Pose2> from, const Eigen::VectorXd& step) {
    for (std::size_t i = 0; i < free.size(); ++i) {
      Pose2& pose = from[free[i]];
      const auto at = 3 * static_cast<Eigen::Index>(i);
      pose = {pose.x_m + step(at), pose.y_m + step(at + 1),
              normalise_angle(pose.yaw_rad + step(at + 2))};
    }
    return from;
  };
  for (int iteration = 0; iteration < 15; ++iteration) {
    Eigen::MatrixXd jacobian(3 * static_cast<Eigen::Index>(edges.size()), unknowns);
    for (Eigen::Index i = 0; i < unknowns; ++i) {
      const Eigen::VectorXd step = Eigen::VectorXd::Unit(unknowns, i) * 1e-6;
      jacobian.col(i) =
          (errors(moved(places, step), edges) - errors(moved(places, -step), edges)) / 2e-6;
    }
    reference.information = jacobian.transpose() * jacobian;
    const Eigen::VectorXd gradient = jacobian.transpose() * errors(places, edges);
    places = moved(places, -reference.information.ldlt().solve(gradient));
  }
  reference.places = places;
  reference.cost = errors(places, edges).squaredNorm();
  return reference;
}

/// Does one set of places satisfy all of these edges? Starting from what a chain of them says.
bool is_consistent(const RandomGraph& graph, const std::vector<LayerPair>& chosen) {
  std::vector<Pose2> places(graph.layers.size());
  std::set<std::size_t> placed, fixed;
  std::size_t cycles = 0;
  std::vector<bool> used(chosen.size(), false);
  for (std::size_t root = 0; root < places.size(); ++root) {
    if (!placed.insert(root).second) continue;
    fixed.insert(root);
    for (bool grew = true; grew;) {
      grew = false;
      for (std::size_t i = 0; i < chosen.size(); ++i) {
        const std::size_t a = number(graph, chosen[i].a), b = number(graph, chosen[i].b);
        if (used[i] || placed.contains(a) == placed.contains(b)) continue;
        const Pose2& T_a_b = graph.edges.at(chosen[i]).T_a_b;
        if (placed.contains(a)) {
          places[b] = places[a] * T_a_b;
        } else {
          places[a] = places[b] * T_a_b.inverse();
        }
        placed.insert(a);
        placed.insert(b);
        used[i] = grew = true;
      }
    }
  }
  cycles = static_cast<std::size_t>(std::count(used.begin(), used.end(), false));
  if (cycles == 0) return true;
  return solve_slowly(places, place_edges(graph, chosen), fixed).cost <=
         kMaxSquaredDistance * static_cast<double>(cycles);
}

double heaviest_consistent_weight(const RandomGraph& graph) {
  std::vector<LayerPair> pairs;
  for (const auto& [pair, edge] : graph.edges) pairs.push_back(pair);
  std::vector<std::pair<double, unsigned>> subsets;
  for (unsigned bits = 0; bits < (1U << pairs.size()); ++bits) {
    double weight = 0.0;
    for (std::size_t i = 0; i < pairs.size(); ++i)
      weight += (bits >> i & 1U) != 0 ? graph.edges.at(pairs[i]).quality : 0.0;
    subsets.emplace_back(-weight, bits);
  }
  std::sort(subsets.begin(), subsets.end());
  for (const auto& [weight, bits] : subsets) {
    std::vector<LayerPair> chosen;
    for (std::size_t i = 0; i < pairs.size(); ++i) {
      if ((bits >> i & 1U) != 0) chosen.push_back(pairs[i]);
    }
    if (is_consistent(graph, chosen)) return -weight;
  }
  return 0.0;
}

TEST(ConsistentEdgesProperty, AreTheHeaviestOfAllSubsets) {
  for (unsigned seed = 1; seed <= 150; ++seed) {
    const RandomGraph graph = random_graph(seed, 3 + static_cast<int>(seed % 3), 8, 0.35);
    const ConsistentEdges found = find_consistent_edges(graph.edges);
    EXPECT_NEAR(found.weight, heaviest_consistent_weight(graph), 1e-9) << "seed " << seed;
    EXPECT_EQ(found.chosen.size() + found.left_out.size(), graph.edges.size());
  }
}

TEST(ConsistentEdgesProperty, WeighNoLessThanAllRightEdgesOfTenHelmets) {
  std::size_t right = 0, lost = 0;
  for (unsigned seed = 1; seed <= 40; ++seed) {
    const RandomGraph graph = random_graph(1000 + seed, 10, 45, 0.25);
    const ConsistentEdges found = find_consistent_edges(graph.edges);
    double right_weight = 0.0;
    for (const auto& [pair, edge] : graph.edges)
      right_weight += graph.wrong.contains(pair) ? 0.0 : edge.quality;
    EXPECT_GE(found.weight, right_weight - 1e-9) << "seed " << seed;
    right += graph.edges.size() - graph.wrong.size();
    for (const auto& out : found.left_out) lost += graph.wrong.contains(out.pair) ? 0U : 1U;
  }
  // Where a helmet has few right edges, a heavier wrong one may win: there doubts.hpp decides.
  EXPECT_LT(lost, right / 50);
}

TEST(ConsistentEdgesProperty, AWithdrawnEdgeLeavesNoTrace) {
  for (unsigned seed = 1; seed <= 40; ++seed) {
    const RandomGraph graph = random_graph(2000 + seed, 6, 15, 0.2);
    MergeGraph one, other;
    for (const auto& [pair, edge] : graph.edges) {
      if (!graph.wrong.contains(pair)) one.set_edge(pair, edge);
      other.set_edge(pair, edge);
    }
    (void)other.plan();
    for (const LayerPair& pair : graph.wrong) other.withdraw(pair);
    const MergePlan plan = one.plan(), again = other.plan();
    ASSERT_EQ(plan.groups.size(), again.groups.size());
    for (std::size_t group = 0; group < plan.groups.size(); ++group) {
      ASSERT_EQ(plan.groups[group].size(), again.groups[group].size());
      for (std::size_t i = 0; i < plan.groups[group].size(); ++i) {
        EXPECT_EQ(plan.groups[group][i].T_common_map.x_m, again.groups[group][i].T_common_map.x_m);
        EXPECT_EQ(plan.groups[group][i].covariance, again.groups[group][i].covariance);
      }
    }
  }
}

TEST(RefinePlacesProperty, GiveWhatSlowLeastSquaresGive) {
  for (unsigned seed = 1; seed <= 60; ++seed) {
    const RandomGraph graph = random_graph(3000 + seed, 3 + static_cast<int>(seed % 5), 20, 0.0);
    const ConsistentEdges found = find_consistent_edges(graph.edges);
    if (found.forest.edges.size() + 1 != graph.layers.size()) continue;  // not all in one group
    std::vector<Pose2> start;
    for (const LayerKey& layer : graph.layers)
      start.push_back(found.forest.places.at(graph.layers.front()).T_root_map.inverse() *
                      found.forest.places.at(layer).T_root_map);
    const auto edges = place_edges(graph, found.chosen);
    const RefinedPlaces fast = refine_places(start, edges);
    const Reference slow = solve_slowly(start, edges, {0});
    const Eigen::MatrixXd covariance = slow.information.inverse();
    for (std::size_t i = 1; i < start.size(); ++i) {
      const Pose2 off = slow.places[i].inverse() * fast.T_common_map[i];
      EXPECT_LT(off.translation().norm(), 1e-4) << "seed " << seed;
      EXPECT_LT(std::abs(off.yaw_rad), 1e-5) << "seed " << seed;
      const auto at = 3 * static_cast<Eigen::Index>(i - 1);
      const Eigen::Matrix3d expected = covariance.block<3, 3>(at, at);
      EXPECT_LT((fast.covariance[i] - expected).norm(), 1e-3 * expected.norm()) << "seed " << seed;
    }
  }
}

TEST(RefinePlacesProperty, AreNearerToTheTruthThanAChainOfEdges) {
  double chained_m = 0.0, refined_m = 0.0;
  for (unsigned seed = 1; seed <= 40; ++seed) {
    const RandomGraph graph = random_graph(4000 + seed, 8, 28, 0.0);
    const ConsistentEdges found = find_consistent_edges(graph.edges);
    std::vector<Pose2> start;
    for (const LayerKey& layer : graph.layers)
      start.push_back(found.forest.places.at(graph.layers.front()).T_root_map.inverse() *
                      found.forest.places.at(layer).T_root_map);
    const RefinedPlaces refined = refine_places(start, place_edges(graph, found.chosen));
    for (std::size_t i = 1; i < start.size(); ++i) {
      const Pose2 truth = graph.truth.front().inverse() * graph.truth[i];
      chained_m += (start[i].translation() - truth.translation()).norm();
      refined_m += (refined.T_common_map[i].translation() - truth.translation()).norm();
    }
  }
  EXPECT_LT(refined_m, 0.8 * chained_m);
}

}  // namespace
}  // namespace lifeline::merging
