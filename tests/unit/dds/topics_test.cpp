#include "common/dds/topics.hpp"

#include <set>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace lifeline::dds {
namespace {

template <typename Visit>
void for_each_topic(Visit visit) {
  std::apply([&](const auto&... topics) { (visit(topics), ...); }, kTopics);
}

TEST(Topics, each_message_has_one_under_its_documented_name) {
  std::vector<std::string> names;
  for_each_topic([&](const auto& topic) { names.emplace_back(topic.name); });
  EXPECT_EQ(names, (std::vector<std::string>{"lifeline/pose", "lifeline/scan", "lifeline/tsd_tile",
                                             "lifeline/tile_request", "lifeline/tile_copy",
                                             "lifeline/merge_directive", "lifeline/directive_copy",
                                             "lifeline/merge_evidence", "lifeline/agent_status",
                                             "lifeline/detection", "lifeline/alert"}));
  EXPECT_EQ(topic_of<wire::TsdTile>().name, "lifeline/tsd_tile");
}

TEST(Topics, no_two_share_a_type_or_profile) {
  std::set<std::string_view> types, profiles;
  std::size_t count = 0, standbys = 0;
  for_each_topic([&](const auto& topic) {
    ++count;
    types.insert(topic.type);
    profiles.insert(topic.writer_profile);
    profiles.insert(topic.reader_profile);
    if (topic.standby_profile.empty()) return;
    ++standbys;
    profiles.insert(topic.standby_profile);
  });
  EXPECT_EQ(types.size(), count);
  EXPECT_EQ(profiles.size(), 2 * count + standbys);
  EXPECT_EQ(standbys, 1U);
}

}  // namespace
}  // namespace lifeline::dds
