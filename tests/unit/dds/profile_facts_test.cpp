#include "common/dds/profile_facts.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/temporary_folder.hpp"

namespace lifeline::dds {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

const std::filesystem::path kShipped = LIFELINE_SOURCE_DIR "/config/qos";

TEST(ProfileFactsTest, loopback_stays_on_this_machine) {
  const auto facts = read_profile_facts(kShipped / "loopback.xml");
  ASSERT_TRUE(facts) << facts.error().text;
  EXPECT_TRUE(facts->udp);
  EXPECT_FALSE(facts->shared_memory);
  EXPECT_FALSE(facts->multicast_discovery);
  EXPECT_THAT(facts->interfaces, ElementsAre("127.0.0.1"));
  EXPECT_THAT(facts->peers, ElementsAre("127.0.0.1"));
  EXPECT_EQ(facts->peers_range, 48U);
  EXPECT_EQ(facts->receive_buffer_octets, 4'194'304U);
  EXPECT_EQ(facts->max_message_octets, 16'000U);
}

TEST(ProfileFactsTest, wifi_finds_others_by_multicast_on_all_interfaces) {
  const auto facts = read_profile_facts(kShipped / "wifi.xml");
  ASSERT_TRUE(facts) << facts.error().text;
  EXPECT_TRUE(facts->multicast_discovery);
  EXPECT_THAT(facts->interfaces, IsEmpty());
  EXPECT_THAT(facts->peers, IsEmpty());
  EXPECT_EQ(facts->max_message_octets, 1400U);
}

class ChangedProfile : public testing::Test {
 protected:
  /// wifi.xml with a list of peers.
  Result<ProfileFacts> with_peers(const std::string& addresses) {
    std::string text = support::content_of(kShipped / "wifi.xml");
    const std::string end = "</discovery_config>";
    text.insert(text.find(end) + end.size(),
                "<initialPeersList>" + addresses + "</initialPeersList>");
    return read_profile_facts(folder_.write("changed.xml", text));
  }
  static std::string locator(const std::string& address) {
    return "<locator><udpv4><address>" + address + "</address></udpv4></locator>";
  }
  support::TemporaryFolder folder_;
};

TEST_F(ChangedProfile, peers_replace_multicast_unless_they_name_it) {
  const auto unicast = with_peers(locator("10.0.0.10"));
  ASSERT_TRUE(unicast) << unicast.error().text;
  EXPECT_FALSE(unicast->multicast_discovery);
  EXPECT_THAT(unicast->peers, ElementsAre("10.0.0.10"));
  const auto both = with_peers(locator("10.0.0.10") + locator("239.255.0.1"));
  ASSERT_TRUE(both) << both.error().text;
  EXPECT_TRUE(both->multicast_discovery);
  EXPECT_THAT(both->peers, ElementsAre("10.0.0.10"));
}

TEST_F(ChangedProfile, builtin_transports_are_udp_and_shared_memory) {
  std::string text = support::content_of(kShipped / "wifi.xml");
  const std::string off = "<useBuiltinTransports>false", on = "<useBuiltinTransports>true";
  text.replace(text.find(off), off.size(), on);
  const auto facts = read_profile_facts(folder_.write("changed.xml", text));
  ASSERT_TRUE(facts) << facts.error().text;
  EXPECT_TRUE(facts->udp);
  EXPECT_TRUE(facts->shared_memory);
  EXPECT_GT(facts->segment_octets, 0U);
}

TEST_F(ChangedProfile, a_file_that_does_not_load_is_refused) {
  EXPECT_FALSE(read_profile_facts(folder_.path() / "none.xml"));
  EXPECT_FALSE(read_profile_facts(kShipped / "ros2.xml"));
}

}  // namespace
}  // namespace lifeline::dds
