#include "tests/bench/merge/negatives.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <numbers>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "agents/sources/simulator/draw.hpp"
#include "agents/sources/simulator/houseexpo.hpp"
#include "agents/sources/simulator/office.hpp"
#include "common/base/check.hpp"
#include "coordinator/matching/match_maps.hpp"
#include "tests/support/simulated_maps.hpp"

namespace lifeline::bench {
namespace {

using sources::Draw;
using sources::FloorPlan;

enum Kind : std::size_t { other_plan, mirror, apart, symmetric, repeated, kKinds };
constexpr std::array<const char*, kKinds> kKindNames{
    "other plans", "mirrored plans", "apart on one floor", "symmetric floors", "repeated rooms"};
constexpr double kRightNegative_m = 0.5;
constexpr double kRight_rad = 2.0 * std::numbers::pi / 180.0;

/// Maps of one floor. Floors of the same group are the same building, or its mirror image.
struct MappedFloor {
  std::string name;
  Kind own_kind;  ///< of pairs within the floor
  struct View {
    Pose2 T_world_map;
    matching::MapFeatures features;
  };
  std::vector<View> views;
};

std::vector<std::filesystem::path> houseexpo_files(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> files;
  std::error_code none;
  for (const auto& entry : std::filesystem::directory_iterator(folder, none)) {
    if (entry.path().extension() == ".json") files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

FloorPlan office(std::uint64_t seed, Draw& draw) {
  return sources::generate_office({.seed = seed,
                                   .width_m = std::round(draw.between(16.0, 40.0)),
                                   .depth_m = std::round(draw.between(12.0, 26.0))})
      .value();
}

/// Every fourth floor is regular, and some stand early, for short runs; the others are offices and
/// houses by turns.
std::pair<FloorPlan, Kind> draw_plan(std::size_t number,
                                     const std::vector<std::filesystem::path>& houses, Draw& draw) {
  if (number % 8 == 1) {
    return {test::repeated_rooms(3 + draw.below(6), draw.between(2.4, 5.0), draw.between(3.0, 6.0)),
            repeated};
  }
  if (number % 8 == 3) {
    const double oblong_m = draw.chance(0.5) ? 0.0 : draw.between(1.0, 8.0);
    return {test::symmetric_hall(draw.between(4.0, 12.0), draw.between(2.0, 3.8), oblong_m),
            symmetric};
  }
  if (number % 2 == 1 && !houses.empty()) {
    auto house =
        sources::read_houseexpo(houses[(2 * (number / 8) + (number % 8) / 7) % houses.size()]);
    if (house) return {*std::move(house), apart};
  }
  return {office(100 + number, draw), apart};
}

Result<matching::MapFeatures> features_of(const TsdGrid& layer, bool as_picture) {
  if (!as_picture) return matching::build_features(layer);
  const auto picture = to_occupancy(layer);
  if (!picture) return forward_error(picture);
  return matching::build_features(*picture);
}

MappedFloor map_floor(const test::SimulatedFloor& floor, Kind kind, bool as_pictures, Draw& draw) {
  constexpr int kViews = 8;
  MappedFloor mapped{floor.plan().name, kind, {}};
  for (int i = 0; i < kViews; ++i) {
    test::SimulatedView view;
    view.walker = {.seed = 7, .walker = i % 4, .walkers = 4};
    view.from_s = i < 4 ? 0.0 : draw.between(10.0, 60.0);
    view.until_s = view.from_s + draw.between(15.0, 60.0);
    view.T_world_map = {draw.between(-5, 5), draw.between(-5, 5),
                        draw.between(-std::numbers::pi, std::numbers::pi)};
    view.noise_seed = static_cast<std::uint64_t>(draw.below(1 << 30));
    auto features = features_of(floor.map(view), as_pictures);
    if (features) mapped.views.push_back({view.T_world_map, *std::move(features)});
  }
  return mapped;
}

class Tally {
 public:
  Tally(const matching::MatchConfig& config, std::size_t wanted) : config_(config), left_(wanted) {
    for (const char* name : kKindNames) outcome_.kinds.push_back({name});
  }

  [[nodiscard]] bool done() const { return left_ == 0; }
  [[nodiscard]] std::size_t left() const { return left_; }
  [[nodiscard]] std::size_t wrong() const { return outcome_.wrong.size(); }
  [[nodiscard]] NegativesOutcome take() { return std::move(outcome_); }

  /// `T_a_b`: the truth where there is one.
  void match(Kind kind, const MappedFloor& floor_a, std::size_t a, const MappedFloor& floor_b,
             std::size_t b, const std::optional<Pose2>& T_a_b) {
    if (done()) return;
    --left_;
    NegativeKind& counts = outcome_.kinds[kind];
    ++counts.pairs;
    const auto result =
        matching::match_maps(floor_a.views[a].features, floor_b.views[b].features, config_);
    if (!result.accepted()) return;
    if (T_a_b && is_right(result, *T_a_b)) {
      ++counts.accepted_right;
      return;
    }
    ++counts.accepted_wrong;
    outcome_.wrong.push_back({counts.name, fmt::format("{} / {}", short_name(floor_a), a),
                              fmt::format("{} / {}", short_name(floor_b), b),
                              result.reason + how_far_off(result, T_a_b)});
  }

 private:
  static std::string short_name(const MappedFloor& floor) {
    return std::filesystem::path(floor.name).filename().string();
  }

  static std::string how_far_off(const matching::MatchResult& result,
                                 const std::optional<Pose2>& T_a_b) {
    if (!T_a_b) return {};
    const Pose2& found = result.candidates.front().T_a_b;
    const Eigen::Vector2d& p_b = result.overlap_centre_b_m;
    return fmt::format(
        " ({:.2f} m, {:.1f} deg off)", (found * p_b - *T_a_b * p_b).norm(),
        std::abs(normalise_angle(found.yaw_rad - T_a_b->yaw_rad)) * 180.0 / std::numbers::pi);
  }

  static bool is_right(const matching::MatchResult& result, const Pose2& T_a_b) {
    const Pose2& found = result.candidates.front().T_a_b;
    const Eigen::Vector2d& p_b = result.overlap_centre_b_m;
    return (found * p_b - T_a_b * p_b).norm() < kRightNegative_m &&
           std::abs(normalise_angle(found.yaw_rad - T_a_b.yaw_rad)) < kRight_rad;
  }

  matching::MatchConfig config_;
  std::size_t left_;
  NegativesOutcome outcome_;
};

void match_within(const MappedFloor& floor, Tally& tally) {
  for (std::size_t a = 0; a < floor.views.size(); ++a) {
    for (std::size_t b = a + 1; b < floor.views.size(); ++b) {
      const Pose2 T_a_b = floor.views[a].T_world_map.inverse() * floor.views[b].T_world_map;
      tally.match(floor.own_kind, floor, a, floor, b, T_a_b);
    }
  }
}

void match_across(const MappedFloor& one, const MappedFloor& other, Kind kind, Tally& tally) {
  for (std::size_t a = 0; a < one.views.size(); ++a) {
    tally.match(kind, one, a, other, a % other.views.size(), std::nullopt);
  }
}

}  // namespace

NegativesOutcome run_negatives(const NegativesChoice& choice, const matching::MatchConfig& config,
                               const std::function<void(std::size_t, std::size_t)>& tell) {
  constexpr std::size_t kOthers = 12;  // earlier floors that a floor is held against
  const auto houses = houseexpo_files(choice.plans);
  Draw draw(choice.seed);
  Tally tally(config, choice.pairs);
  std::vector<MappedFloor> floors;
  for (std::size_t number = 0; !tally.done(); ++number) {
    auto [plan, kind] = draw_plan(number, houses, draw);
    auto floor = test::SimulatedFloor::make(plan);
    if (!floor) continue;
    MappedFloor mapped = map_floor(*floor, kind, choice.pictures, draw);
    if (mapped.views.empty()) continue;
    match_within(mapped, tally);
    for (const MappedFloor& earlier : floors) match_across(mapped, earlier, other_plan, tally);
    if (kind == apart) {
      if (auto image = test::SimulatedFloor::make(test::mirrored(plan))) {
        const MappedFloor mirror_floor = map_floor(*image, kind, choice.pictures, draw);
        if (!mirror_floor.views.empty()) match_across(mapped, mirror_floor, mirror, tally);
      }
    }
    if (floors.size() == kOthers) floors.erase(floors.begin());
    floors.push_back(std::move(mapped));
    if (tell) tell(choice.pairs - tally.left(), tally.wrong());
  }
  return tally.take();
}

}  // namespace lifeline::bench
