// A fleet of real programs, and somebody in its domain who floods, lies, repeats old samples or
// stands still: the others end with the same map, and the logs say who it was.

#include <atomic>
#include <chrono>
#include <random>
#include <thread>

#include "common/dds/open_channel.hpp"
#include "tests/support/killed_fleet.hpp"
#include "tests/support/sharing_samples.hpp"

namespace lifeline::test {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

const std::string kWalk = "sim:office?walkers=2&rate=x8&beams=400&seed=1&duration=60&walker=";

/// Somebody in the mission's domain, in this process.
class Stranger {
 public:
  Stranger(const TestDomain& domain, const std::string& qos, std::string mission)
      : mission_(std::move(mission)),
        participant_(dds::Participant::create({domain.id(), qos, "stranger"}).value()) {
    Result<void> all;
    dds::open_outbox(*participant_, tiles_out_, all);
    dds::open_inbox(*participant_, tiles_in_, all);
    EXPECT_TRUE(all) << all.error().text;
  }

  void say(wire::TsdTile sample, const std::string& sender) {
    sample.envelope = envelope(sender, ++said_);
    sample.envelope.mission_id = mission_;
    EXPECT_TRUE(tiles_out_->put(sample));
  }
  /// What it has heard since the last call.
  std::vector<wire::TsdTile> hear() { return tiles_in_->take(); }
  /// Waits for something to hear.
  void wait() { (void)participant_->wait_for_data(seconds(1)); }

 private:
  std::string mission_;
  std::unique_ptr<dds::Participant> participant_;
  std::unique_ptr<wire::Outbox<wire::TsdTile>> tiles_out_;
  std::unique_ptr<wire::Inbox<wire::TsdTile>> tiles_in_;
  std::uint64_t said_ = 0;
};

class Faults : public KilledFleet {
 protected:
  void start_fleet() {
    start(
        "coordinator",
        {"lifeline-coordinator", "run", "--until-settled", "--expect", "2", "--time-limit", "200"},
        false);
    start_helmet("alpha", kWalk + "0");
    start_helmet("bravo", kWalk + "1");
  }
  Stranger stranger() { return {domain_, qos(), mission()}; }
  /// Alpha, bravo and the coordinator end with one map, and nobody restarted or lost a scan over
  /// it.
  void expect_settled() {
    const Ended settled = program("coordinator").wait(kLong);
    ASSERT_EQ(settled.status, 0) << settled.output;
    const auto report = read("coordinator", "coordinator.json");
    for (const char* name : {"alpha", "bravo"}) {
      const auto helmet = stop(name);
      EXPECT_EQ(helmet.at("common_map_sha256"), report.at("common_map_sha256")) << name;
      EXPECT_EQ(helmet.at("map_id"), 1) << name;
      EXPECT_GE(helmet.at("scans").get<int>() + helmet.at("scans_dropped").get<int>(), 600) << name;
    }
  }
};

TEST_F(Faults, AHelmetThatFloodsIsNamedAndHarmsNobody) {
  Stranger mallory = stranger();
  start_fleet();
  std::jthread flood([&](const std::stop_token& stop) {
    std::mt19937 random(5);
    const QuantisedTile cells = small_tile(random);
    auto next = std::chrono::steady_clock::now();
    for (std::uint64_t revision = 1; !stop.stop_requested(); ++revision) {
      const auto at = static_cast<std::int32_t>(revision % 100);
      mallory.say(tile_sample(layer("mallory"), {at % 10, at / 10}, revision, cells), "mallory");
      std::this_thread::sleep_until(next += milliseconds(1));
    }
  });
  for (const char* name : {"alpha", "bravo", "coordinator"})
    expect(name, "mallory floods tsd_tile");
  expect("alpha", "last scan");
  flood.request_stop();
  flood.join();
  expect_settled();
}

TEST_F(Faults, TilesThatCannotBeReadAreCountedAndReplaceNothing) {
  Stranger mallory = stranger();
  start_fleet();
  expect("alpha", "follows directive");
  std::mt19937 random(6);
  // In alpha's name and newer than all that alpha has: neither may be believed.
  for (int i = 0; i < 300; ++i) {
    wire::TsdTile sample;
    sample.layer = {"alpha", 1, 0};
    sample.tile_x = static_cast<std::int32_t>(random() % 8) - 4;
    sample.tile_y = static_cast<std::int32_t>(random() % 8) - 4;
    sample.revision = std::uint64_t{1} << 60U;
    sample.payload.resize(random() % 1000);
    for (auto& octet : sample.payload) octet = static_cast<std::uint8_t>(random());
    mallory.say(sample, "mallory");
  }
  for (const char* name : {"bravo", "coordinator"}) expect(name, "tsd_tile: refused a sample");
  expect_settled();
}

TEST_F(Faults, OldTilesReplayedLaterChangeNothing) {
  Stranger mallory = stranger();
  start_fleet();
  std::vector<wire::TsdTile> recorded;
  const auto until = std::chrono::steady_clock::now() + kLong;
  while (recorded.size() < 30 && std::chrono::steady_clock::now() < until) {
    mallory.wait();
    for (auto& sample : mallory.hear()) recorded.push_back(std::move(sample));
  }
  ASSERT_GE(recorded.size(), 30U);
  expect("alpha", "follows directive");
  expect("alpha", "last scan");
  for (const auto& sample : recorded) mallory.say(sample, sample.layer.agent_id);
  expect_settled();
}

TEST_F(Faults, AHelmetFrozenForThreeSecondsCatchesUp) {
  start_fleet();
  expect("alpha", "follows directive");
  program("bravo").send(SIGSTOP);
  std::this_thread::sleep_for(seconds(3));  // the fault itself
  program("bravo").send(SIGCONT);
  expect_settled();
}

}  // namespace
}  // namespace lifeline::test
