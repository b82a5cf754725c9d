#include "tests/support/fleet.hpp"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "common/base/sha256.hpp"

namespace lifeline::test {
namespace {

std::vector<std::string> office_walkers(int walkers, const std::string& options) {
  std::vector<std::string> sources;
  for (int i = 0; i < walkers; ++i) {
    sources.push_back("sim:office?walkers=" + std::to_string(walkers) +
                      "&walker=" + std::to_string(i) + options);
  }
  return sources;
}

constexpr Duration kDeadline = std::chrono::minutes(5);

class FleetTest : public testing::Test {
 protected:
  static void expect_one_map(const Fleet& fleet) {
    const auto own = fleet.coordinator().common_map().sha256();
    for (const auto& helmet : fleet.helmets()) {
      EXPECT_EQ(to_hex(helmet->sharing().map().common_map_sha256()), to_hex(own));
    }
  }

  static void expect_merges_right(const Fleet& fleet) {
    ASSERT_FALSE(fleet.coordinator().accepted_matches().empty());
    for (const auto& record : fleet.coordinator().accepted_matches()) {
      const auto mapper_of = [&](const LayerKey& layer) -> const HelmetMapper& {
        return fleet.helmets()[static_cast<std::size_t>(layer.agent_id.text().back() - '0')]
            ->mapper();
      };
      const Pose2 truth = true_T_a_b(mapper_of(record.pair.a), mapper_of(record.pair.b));
      const Pose2& found = record.result.candidates.front().T_a_b;
      const Eigen::Vector2d& centre = record.result.overlap_centre_b_m;
      EXPECT_LT((found * centre - truth * centre).norm(), 0.10)
          << to_seconds(record.at) << " s: " << record.result.reason;
      EXPECT_LT(std::abs(normalise_angle(found.yaw_rad - truth.yaw_rad)), std::numbers::pi / 180.0);
    }
  }
};

TEST_F(FleetTest, TwoHelmetsAndTheCoordinatorEndWithOneMap) {
  Fleet fleet(office_walkers(2, "&duration=100&beams=400&seed=1"));
  EXPECT_EQ(fleet.run(kDeadline), Settlement::shared);
  expect_one_map(fleet);
  expect_merges_right(fleet);
}

TEST_F(FleetTest, TheSameInputsGiveTheSameBits) {
  const auto sources = office_walkers(2, "&duration=60&beams=200&seed=2");
  Fleet first(sources), second(sources);
  EXPECT_EQ(first.run(kDeadline), second.run(kDeadline));
  EXPECT_EQ(to_hex(first.coordinator().common_map().sha256()),
            to_hex(second.coordinator().common_map().sha256()));
  EXPECT_EQ(first.coordinator().directive().epoch, second.coordinator().directive().epoch);
}

TEST_F(FleetTest, WithoutACoordinatorsMergeEveryHelmetMapsOnAlone) {
  auto settings = Fleet::default_settings();
  settings.schedule.min_explored_percent = 100.0;  // Eq. 11 never holds
  Fleet fleet(office_walkers(2, "&duration=20&beams=200&seed=1"), settings);
  EXPECT_EQ(fleet.run(std::chrono::seconds(40)), Settlement::apart);
  for (const auto& helmet : fleet.helmets()) {
    EXPECT_FALSE(helmet->sharing().map().shares());
    EXPECT_GT(helmet->mapper().layer().tile_count(), 4U);
  }
}

}  // namespace
}  // namespace lifeline::test
