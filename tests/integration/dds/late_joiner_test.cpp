// State, not history: what a reader gets that starts after the writer has written.

#include <csignal>
#include <set>
#include <utility>

#include "tests/integration/dds/processes.hpp"

namespace lifeline::test {
namespace {

using LateJoiner = DdsProcesses;

TEST_F(LateJoiner, gets_the_newest_sample_of_each_of_100_keys_exactly_once) {
  const auto writer = publisher({"--tiles", "100", "--revisions", "3"});

  const auto ended = probe({"collect", "--tiles", "100"})->wait(kPatience);

  ASSERT_EQ(ended.status, 0) << ended.output;
  const auto tiles = json_lines(ended.output, "topic", "tsd_tile");
  EXPECT_EQ(tiles.size(), 100U);
  std::set<std::pair<int, int>> keys;
  for (const auto& tile : tiles) {
    keys.emplace(tile.at("x"), tile.at("y"));
    EXPECT_EQ(tile.at("revision"), 3);
    EXPECT_TRUE(tile.at("intact").get<bool>());
  }
  EXPECT_EQ(keys.size(), 100U);
  EXPECT_EQ(json_lines(ended.output, "event", "summary").at(0).at("refused"), 0);
}

TEST_F(LateJoiner, gets_tiles_of_the_largest_size_whole) {
  const auto writer = publisher({"--tiles", "12", "--size", "1000", "--epoch", "4"});

  const auto ended = probe({"collect", "--tiles", "12", "--epoch", "4"})->wait(kPatience);

  ASSERT_EQ(ended.status, 0) << ended.output;
  const auto tiles = json_lines(ended.output, "topic", "tsd_tile");
  EXPECT_EQ(tiles.size(), 12U);
  for (const auto& tile : tiles) EXPECT_TRUE(tile.at("intact").get<bool>());
  EXPECT_EQ(json_lines(ended.output, "topic", "merge_directive").size(), 1U);
}

TEST_F(LateJoiner, hears_all_writers_of_the_domain_and_nobody_of_another) {
  const TestDomain other_domain;
  ASSERT_NE(other_domain.id(), domain_.id());
  const auto alpha = publisher({"--tiles", "20", "--id", "alpha"});
  const auto bravo = publisher({"--tiles", "1", "--id", "bravo", "--epoch", "2"});
  Program stranger({"lifeline-dds-probe", "publish", "--domain", other_domain.text(), "--tiles",
                    "5", "--id", "stranger", "--epoch", "9"},
                   folder_.path() / "stranger.log");
  ASSERT_TRUE(stranger.wait_for_output("\"event\":\"written\"", kPatience));

  const auto ended = probe({"collect", "--tiles", "20", "--epoch", "2"})->wait(kPatience);

  ASSERT_EQ(ended.status, 0) << ended.output;
  EXPECT_EQ(json_lines(ended.output, "sender", "alpha").size(), 20U);
  EXPECT_EQ(json_lines(ended.output, "sender", "bravo").size(), 2U);
  EXPECT_TRUE(json_lines(ended.output, "sender", "stranger").empty());
}

TEST_F(LateJoiner, meets_everybody_who_starts_at_once) {
  constexpr std::size_t kParticipants = 10;
  std::vector<std::unique_ptr<Program>> participants;
  for (std::size_t i = 0; i < kParticipants; ++i) {
    participants.push_back(probe({"meet", "--id", "p" + std::to_string(i), "--peers",
                                  std::to_string(kParticipants - 1), "--seconds", "120"}));
  }
  for (const auto& participant : participants) {
    EXPECT_TRUE(participant->wait_for_output("\"event\":\"met\"", kPatience))
        << participant->output();
  }
}

}  // namespace
}  // namespace lifeline::test
