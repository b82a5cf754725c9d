// A helmet that does not hear another one, which hears it.
#include <algorithm>
#include <string>

#include <gtest/gtest.h>

#include "tests/bench/radio/radio_fleet.hpp"
#include "tests/bench/radio/radio_net.hpp"
#include "tests/support/temporary_folder.hpp"

namespace lifeline::bench {
namespace {

using std::chrono::seconds;

constexpr Duration kPatience = seconds(120);

bool hears(const RadioFleet& fleet, const std::string& who, const std::string& whom) {
  const auto status = fleet.heard().find(who);
  return status != fleet.heard().end() &&
         std::ranges::find(status->second.peers_heard, whom) != status->second.peers_heard.end();
}

TEST(OneWayPair, IsNamedSharesOneMapByOthersAndIsWholeAgainAfterwards) {
  support::TemporaryFolder folder;
  auto net = RadioNet::make(6);
  if (!net) GTEST_SKIP() << net.error().text;
  RadioFleet::Options options;
  options.programs = LIFELINE_BINARY_DIR "/bin";
  options.qos = LIFELINE_SOURCE_DIR "/config/qos/wifi.xml";
  options.folder = folder.path();
  options.helmets = 3;
  options.walk_s = 40.0;
  auto fleet = RadioFleet::start(*net, options);
  ASSERT_TRUE(fleet) << fleet.error().text;
  ASSERT_TRUE(fleet->until([](const auto& f) { return f.all_hear_all(); }, kPatience));

  const int alpha = RadioFleet::host_of(0), bravo = RadioFleet::host_of(1);
  ASSERT_TRUE(net->cut(bravo, alpha));
  ASSERT_TRUE(fleet->until([](const auto& f) { return !hears(f, "alpha", "bravo"); }, kPatience));
  const auto is_named = [&](const auto&) {
    return support::content_of(folder.path() / "alpha.log").find("alpha does not hear bravo") !=
           std::string::npos;
  };
  ASSERT_TRUE(fleet->until(is_named, kPatience));
  ASSERT_TRUE(
      fleet->until([](const auto& f) { return f.all_finished() && f.all_equal(); }, kPatience));
  EXPECT_FALSE(hears(*fleet, "alpha", "bravo"));

  ASSERT_TRUE(net->restore(alpha));
  EXPECT_TRUE(fleet->until([](const auto& f) { return f.all_hear_all(); }, kPatience));
  EXPECT_TRUE(fleet->until([](const auto& f) { return f.all_equal(); }, kPatience));
}

}  // namespace
}  // namespace lifeline::bench
