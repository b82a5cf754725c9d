// Against Cyclone DDS, a second implementation, on types built from the same IDL.

#include <csignal>
#include <cstdio>

#include "tests/integration/dds/probe_samples.hpp"
#include "tests/integration/dds/processes.hpp"

namespace lifeline::test {
namespace {

std::string hex(const std::vector<std::uint8_t>& octets) {
  std::string text;
  char digits[3];
  for (const auto octet : octets) {
    std::snprintf(digits, sizeof digits, "%02x", octet);
    text += digits;
  }
  return text;
}

class Interop : public DdsProcesses {
 protected:
  std::unique_ptr<Program> cyclone_reader(std::size_t tiles, std::size_t directives) {
    return start("lifeline-cyclone-reader", {"--seconds", "30", "--tiles", std::to_string(tiles),
                                             "--directives", std::to_string(directives)});
  }
  /// Starts a sender that breaks the rules, and says what a reader of ours made of it.
  nlohmann::json summary_against(const std::string& what, const std::string& tiles) {
    const auto reader = probe({"collect", "--tiles", tiles, "--seconds", "10"});
    const auto stranger = start("lifeline-cyclone-stranger", {"--what", what, "--seconds", "60"});
    const auto ended = reader->wait(kPatience);
    EXPECT_EQ(ended.status, 0) << what << ": " << ended.output;
    const auto summary = json_lines(ended.output, "event", "summary");
    return summary.empty() ? nlohmann::json{{"keys", -1}, {"refused", -1}} : summary.front();
  }
};

void expect_same_tile(const nlohmann::json& got, const wire::TsdTile& sent) {
  EXPECT_EQ(got.at("protocol_version"), sent.envelope.protocol_version);
  EXPECT_EQ(got.at("mission_id"), sent.envelope.mission_id);
  EXPECT_EQ(got.at("sender_id"), sent.envelope.sender_id);
  EXPECT_EQ(got.at("sequence"), sent.envelope.sequence);
  EXPECT_EQ(got.at("agent_id"), sent.layer.agent_id);
  EXPECT_EQ(got.at("map_id"), sent.layer.map_id);
  EXPECT_EQ(got.at("floor"), sent.layer.floor);
  EXPECT_EQ(got.at("part"), sent.part);
  EXPECT_EQ(got.at("parts"), sent.parts);
  EXPECT_EQ(got.at("revision"), sent.revision);
  EXPECT_EQ(got.at("payload"), hex(sent.payload));
}

void expect_same_member(const nlohmann::json& got, const wire::DirectiveMember& sent) {
  EXPECT_EQ(got.at("agent_id"), sent.layer.agent_id);
  EXPECT_EQ(got.at("map_id"), sent.layer.map_id);
  EXPECT_EQ(got.at("floor"), sent.layer.floor);
  EXPECT_EQ(got.at("group"), sent.group);
  EXPECT_EQ(got.at("cos_q30"), sent.T_common_map.cos_q30);
  EXPECT_EQ(got.at("sin_q30"), sent.T_common_map.sin_q30);
  EXPECT_EQ(got.at("x_um"), sent.T_common_map.x_um);
  EXPECT_EQ(got.at("y_um"), sent.T_common_map.y_um);
  EXPECT_EQ(got.at("covariance"), nlohmann::json(sent.covariance));
  EXPECT_EQ(got.at("quality").get<float>(), sent.quality);
}

/// One message, several fragments, the largest.
class InteropTiles : public Interop, public ::testing::WithParamInterface<std::size_t> {};

TEST_P(InteropTiles, cyclone_dds_gets_exactly_what_was_sent) {
  constexpr std::size_t kTiles = 60;
  const auto writer = publisher({"--id", "alpha", "--tiles", std::to_string(kTiles), "--revisions",
                                 "2", "--size", std::to_string(GetParam())});

  const auto ended = cyclone_reader(kTiles, 0)->wait(kPatience);

  ASSERT_EQ(ended.status, 0) << ended.output;
  const auto tiles = json_lines(ended.output, "topic", "tsd_tile");
  ASSERT_EQ(tiles.size(), kTiles) << ended.output;
  for (const auto& got : tiles) {
    const auto index =
        got.at("tile_y").get<int>() * probe::kTilesPerRow + got.at("tile_x").get<int>();
    expect_same_tile(got, probe::tile("alpha", static_cast<std::uint32_t>(index), 2, GetParam()));
  }
}

INSTANTIATE_TEST_SUITE_P(Sizes, InteropTiles, ::testing::Values(0U, 17U, 700U, 1000U));

TEST_F(Interop, cyclone_dds_gets_the_directive_as_sent) {
  const auto writer = publisher({"--id", "base", "--epoch", "17"});

  const auto ended = cyclone_reader(0, 1)->wait(kPatience);

  ASSERT_EQ(ended.status, 0) << ended.output;
  const auto directives = json_lines(ended.output, "topic", "merge_directive");
  ASSERT_EQ(directives.size(), 1U) << ended.output;
  const auto sent = probe::directive("base", 17);
  EXPECT_EQ(directives[0].at("sender_id"), "base");
  EXPECT_EQ(directives[0].at("directive_mission_id"), sent.mission_id);
  EXPECT_EQ(directives[0].at("epoch"), 17);
  EXPECT_EQ(directives[0].at("own_weight_permille"), sent.own_weight_permille);
  ASSERT_EQ(directives[0].at("members").size(), sent.members.size());
  for (std::size_t i = 0; i < sent.members.size(); ++i) {
    expect_same_member(directives[0].at("members")[i], sent.members[i]);
  }
}

TEST_F(Interop, cyclone_dds_hears_what_is_written_after_it_started) {
  const auto reader = cyclone_reader(5, 1);
  const auto writer = publisher({"--tiles", "5", "--epoch", "1"});

  EXPECT_EQ(reader->wait(kPatience).status, 0);
  EXPECT_EQ(json_lines(reader->output(), "topic", "tsd_tile").size(), 5U);
}

TEST_F(Interop, a_sender_that_breaks_a_bound_is_refused_and_counted) {
  EXPECT_EQ(summary_against("proper", "1").at("refused"), 0);
  for (const auto* what : {"long_name", "long_payload"}) {
    const auto summary = summary_against(what, "1");
    EXPECT_EQ(summary.at("keys"), 1) << what;
    EXPECT_EQ(summary.at("refused"), 1) << what;
  }
}

TEST_F(Interop, a_sample_beyond_its_type_reaches_nobody_and_harms_no_other_sender) {
  const auto stranger =
      start("lifeline-cyclone-stranger", {"--what", "oversized", "--seconds", "60"});
  const auto writer = publisher({"--tiles", "40"});

  const auto ended = probe({"collect", "--tiles", "40"})->wait(kPatience);

  EXPECT_EQ(ended.status, 0) << ended.output;
  EXPECT_EQ(json_lines(ended.output, "sender", "probe").size(), 40U);
  EXPECT_TRUE(json_lines(ended.output, "sender", "stranger").empty());
}

TEST_F(Interop, a_status_that_cannot_be_decoded_ends_no_process) {
  const auto reader = probe({"meet", "--id", "alpha", "--peers", "2", "--seconds", "60"});
  const auto bad = start("lifeline-cyclone-stranger", {"--what", "bad_boolean", "--seconds", "60"});
  const auto peer = probe({"meet", "--id", "bravo", "--peers", "9", "--seconds", "60"});

  // Heard: bravo, and the proper status of the stranger.
  EXPECT_TRUE(reader->wait_for_output("\"event\":\"met\"", kPatience)) << reader->output();
  reader->send(SIGTERM);
  const auto ended = reader->wait(kPatience);
  EXPECT_EQ(ended.status, 0) << ended.output;
  EXPECT_EQ(json_lines(ended.output, "event", "summary").at(0).at("refused"), 1) << ended.output;
}

}  // namespace
}  // namespace lifeline::test
