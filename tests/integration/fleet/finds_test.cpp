// Victims and tags that several helmets see stand in everybody's list once, where they truly are.

#include <gtest/gtest.h>

#include "agents/sources/simulator/simulated_source.hpp"
#include "tests/support/fleet.hpp"

namespace lifeline::test {
namespace {

std::string walker(int number, const std::string& options) {
  return "sim:office?walkers=2&beams=400&duration=100&walker=" + std::to_string(number) + options;
}

/// Everything published has arrived: the news of a find wait up to a second.
void settle(Fleet& fleet) {
  for (int i = 0; i < 15; ++i) fleet.step();
}

/// Where an entry of the common frame truly lies, by the helmet whose frame is the common one.
Eigen::Vector2d in_world(const Fleet& fleet, const sharing::FleetDetection& entry) {
  const std::string lead = fleet.coordinator().directive().members.front().layer.agent_id;
  const auto& helmet = fleet.helmets()[static_cast<std::size_t>(lead.back() - '0')];
  return true_T_world_map(helmet->mapper()) * Eigen::Vector2d(entry.x_m, entry.y_m);
}

class FindsTest : public ::testing::TestWithParam<int> {};

TEST_P(FindsTest, EachStandsInEverybodysListOnceWithinHalfAMetre) {
  const std::string options = "&victims=4&tags=2&seed=" + std::to_string(GetParam());
  Fleet fleet({walker(0, options), walker(1, options)});
  ASSERT_EQ(fleet.run(std::chrono::minutes(5)), Settlement::shared);
  settle(fleet);
  const auto truth = sources::load_finds(sources::parse_source_spec(walker(0, options)).value());
  ASSERT_TRUE(truth);
  ASSERT_EQ(truth->size(), 6U);

  const auto list = fleet.coordinator().detections();
  for (const auto& helmet : fleet.helmets()) EXPECT_EQ(helmet->sharing().detections(), list);
  ASSERT_EQ(list.size(), truth->size());
  int seen_by_both = 0;
  for (const auto& find : *truth) {
    const auto kind = find.kind == sensing::SightedKind::victim ? wire::DetectionKind::victim
                                                                : wire::DetectionKind::uwb_tag;
    int entries = 0;
    for (const auto& entry : list) {
      if (entry.kind != kind || (in_world(fleet, entry) - find.p_world).norm() > 0.5) continue;
      ++entries;
      EXPECT_EQ(entry.group, std::uint16_t{0});
      EXPECT_GT(entry.confidence, 0.5);
      EXPECT_LE(entry.first.at_ns, entry.last.at_ns);
      seen_by_both += entry.seen_by.size() == 2 ? 1 : 0;
    }
    EXPECT_EQ(entries, 1) << find.p_world.transpose();
  }
  EXPECT_GE(seen_by_both, 1);
}

INSTANTIATE_TEST_SUITE_P(Seeds, FindsTest, ::testing::Values(1, 2, 3));

TEST(UnmergedFindsTest, StandInTheListInTheFrameOfWhoSawThem) {
  auto settings = Fleet::default_settings();
  settings.schedule.min_explored_percent = 100.0;  // nobody is merged
  const std::string options = "&victims=4&seed=1";
  Fleet fleet({walker(0, options), walker(1, options)}, settings);
  EXPECT_EQ(fleet.run(std::chrono::seconds(120)), Settlement::apart);
  const auto list = fleet.coordinator().detections();
  for (const auto& helmet : fleet.helmets()) EXPECT_EQ(helmet->sharing().detections(), list);
  EXPECT_GT(list.size(), 4U);  // those that both saw stand there twice
  for (const auto& entry : list) {
    EXPECT_EQ(entry.group, std::nullopt);
    EXPECT_EQ(entry.seen_by, std::vector<std::string>{entry.layer.agent_id.text()});
  }
}

}  // namespace
}  // namespace lifeline::test
