#include "agents/helmet_threads.hpp"

#include <chrono>
#include <numbers>
#include <set>
#include <thread>

#include <gtest/gtest.h>

#include "common/base/result.hpp"

namespace lifeline {
namespace {

constexpr std::chrono::seconds kDeadline{60};

/// A square room, seen `scans` times; then the end, an error, or silence until told to stop.
class RoomSource final : public sensing::ScanSource {
 public:
  enum class After { end, error, wait };
  RoomSource(int scans, After after, std::shared_ptr<std::atomic<bool>> stop = nullptr)
      : left_(scans), after_(after), stop_(std::move(stop)) {}

  [[nodiscard]] Result<std::optional<sensing::RawScan>> next() override {
    if (left_-- > 0) return room();
    if (after_ == After::error) return fail(ErrorCode::unavailable, "the lidar was unplugged");
    const auto give_up = std::chrono::steady_clock::now() + kDeadline;
    while (after_ == After::wait && !*stop_ && std::chrono::steady_clock::now() < give_up) {
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    return std::nullopt;
  }

 private:
  sensing::RawScan room() {
    sensing::RawScan scan;
    scan.stamp = Timestamp(std::chrono::milliseconds(100) * ++given_);
    scan.angle_step_rad = std::numbers::pi / 90.0;
    scan.range_max_m = 30.0;
    for (int i = 0; i < 180; ++i) {
      const double angle = i * scan.angle_step_rad;
      scan.ranges_m.push_back(
          static_cast<float>(3.0 / std::max(std::abs(std::cos(angle)), std::abs(std::sin(angle)))));
    }
    return scan;
  }

  int left_, given_ = 0;
  After after_;
  std::shared_ptr<std::atomic<bool>> stop_;
};

/// What the sharing thread does: empties the mailbox and hands peers' cells over.
struct Sharing {
  Mailbox mailbox;
  std::set<TileIndex> tiles;
  std::optional<sharing::HelmetState> last;

  void exchange() {
    if (auto mapped = mailbox.take_mapped()) {
      for (const auto& [tile, cells] : mapped->tiles) tiles.insert(tile);
      last = mapped->state;
    }
    const auto foreign = std::make_shared<TsdTile>();
    foreign->fill({TsdCell::kTsdOne, TsdCell::kWeightOne});
    sharing::PeerUpdate update;
    update.tiles.emplace_back(TileIndex{20, 20}, foreign);
    update.own_weight = 0.6;
    mailbox.put_peers(update);
  }
  [[nodiscard]] bool run_until_finished(const HelmetThreads& threads) {
    const auto give_up = std::chrono::steady_clock::now() + kDeadline;
    while (!threads.finished() && std::chrono::steady_clock::now() < give_up) {
      exchange();
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    exchange();
    return threads.finished();
  }
};

TEST(HelmetThreads, EveryScanIsMappedAndEveryTileHandedOver) {
  HelmetMapper mapper({}, {}, {});
  Sharing sharing;
  HelmetThreads threads(std::make_unique<RoomSource>(60, RoomSource::After::end), Overflow::wait,
                        mapper, sharing.mailbox);
  ASSERT_TRUE(sharing.run_until_finished(threads));
  threads.stop();
  EXPECT_EQ(mapper.trajectory().size(), 60U);
  EXPECT_EQ(threads.scans_dropped(), 0U);
  EXPECT_FALSE(threads.source_error());
  for (const TileIndex tile : mapper.layer().tiles()) EXPECT_TRUE(sharing.tiles.contains(tile));
  EXPECT_FALSE(sharing.tiles.contains({20, 20}));  // the peer's stays the peer's
  ASSERT_TRUE(sharing.last);
  EXPECT_EQ(sharing.last->state, wire::AgentState::finished);
}

TEST(HelmetThreads, AFailingSourceIsReportedAndWhatItGaveIsMapped) {
  HelmetMapper mapper({}, {}, {});
  Sharing sharing;
  HelmetThreads threads(std::make_unique<RoomSource>(5, RoomSource::After::error), Overflow::wait,
                        mapper, sharing.mailbox);
  ASSERT_TRUE(sharing.run_until_finished(threads));
  threads.stop();
  ASSERT_TRUE(threads.source_error());
  EXPECT_EQ(threads.source_error()->text, "the lidar was unplugged");
  EXPECT_EQ(mapper.trajectory().size(), 5U);
}

TEST(HelmetThreads, ScansTooFastForTheMapperAreDroppedAndCounted) {
  HelmetMapper mapper({}, {}, {});
  Sharing sharing;
  HelmetThreads threads(std::make_unique<RoomSource>(200, RoomSource::After::end),
                        Overflow::drop_oldest, mapper, sharing.mailbox);
  ASSERT_TRUE(sharing.run_until_finished(threads));
  threads.stop();
  EXPECT_EQ(mapper.trajectory().size() + threads.scans_dropped(), 200U);
}

TEST(HelmetThreads, StopEndsBothInTheMidstOfTheScans) {
  for (const int wait_ms : {0, 5, 50}) {
    const auto stop = std::make_shared<std::atomic<bool>>(false);
    HelmetMapper mapper({}, {}, {});
    Sharing sharing;
    HelmetThreads threads(std::make_unique<RoomSource>(30, RoomSource::After::wait, stop),
                          Overflow::wait, mapper, sharing.mailbox);
    std::this_thread::sleep_for(std::chrono::milliseconds(wait_ms));
    *stop = true;
    threads.stop();
    threads.stop();  // again does no harm
    EXPECT_LE(mapper.trajectory().size(), 30U);
    EXPECT_TRUE(threads.finished());
  }
}

}  // namespace
}  // namespace lifeline
