// A helmet's process is killed at any moment. Whatever had left it by then, its state knows:
// checked against what came out of the process.

#include <algorithm>
#include <csignal>
#include <cstring>
#include <map>
#include <random>
#include <thread>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include "agents/sources/open_source.hpp"
#include "agents/storage/helmet_storage.hpp"
#include "common/base/sha256.hpp"
#include "common/wire/loopback.hpp"
#include "common/wire/tile_codec.hpp"
#include "tests/support/fleet_channels.hpp"
#include "tests/support/full_disk.hpp"
#include "tests/support/temporary_folder.hpp"

namespace lifeline::test {
namespace {

const GridGeometry kGrid{};
/// After a walk, for the tiles that still wait.
constexpr std::chrono::milliseconds kMoment(20);
constexpr std::size_t kNoRoom = 4000;  ///< less than a page
constexpr double kWalkS = 15.0;
constexpr Duration kRest = std::chrono::milliseconds(300);

store::StateIdentity killed_identity() {
  return {"helmet", "alpha", kMission, kGrid, 7};
}

/// A part of a tile that left the process.
struct Left {
  std::int32_t x, y;
  std::uint64_t revision;
  std::uint8_t part, parts;
  std::uint16_t size;
  std::array<std::uint8_t, 32> sha256;
};

Left left_of(const wire::TsdTile& sample) {
  Left left{};
  left.x = sample.tile_x;
  left.y = sample.tile_y;
  left.revision = sample.revision;
  left.part = sample.part;
  left.parts = sample.parts;
  left.size = static_cast<std::uint16_t>(sample.payload.size());
  left.sha256 = Sha256().add(sample.payload).finish();
  return left;
}

class PipeOutbox final : public wire::Outbox<wire::TsdTile> {
 public:
  explicit PipeOutbox(int end) : end_(end) {}
  Result<void> put(const wire::TsdTile& sample) override {
    const Left left = left_of(sample);
    if (::write(end_, &left, sizeof left) != sizeof left) _exit(1);
    return {};
  }
  bool has_reader() const override { return true; }

 private:
  int end_;
};

/// Maps and shares until it is killed; its tiles go into a pipe, which is closed when the walk is
/// over and no more of them come.
[[noreturn]] void walk(const std::filesystem::path& folder, int end, double from_s,
                       std::size_t room) {
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);  // no helmet outlives a test that is stopped
  const SystemClock clock;
  // Not to the end of the tour: a helmet that stays lost searches with every scan.
  const std::string source = fmt::format(
      "sim:office?beams=200&seed=2&walk_seed=3&from={}&duration={}", from_s, from_s + kWalkS);
  wire::LoopbackBus bus;
  store::RecordStoreConfig records;
  records.give_up_after = std::chrono::hours(1);  // a busy machine's disk is slow, not broken
  auto storage =
      HelmetStorage::open(folder, killed_identity(), Floor{0}, {}, clock, records).value();
  const LayerKey layer{AgentId::parse("alpha").value(), MapId{1}, Floor{0}};
  storage->begin(layer);
  sharing::HelmetChannels channels = helmet_channels(bus);
  channels.tile = std::make_unique<PipeOutbox>(end);
  storage->attach(channels);
  sharing::HelmetSharingConfig config = sharing_config("alpha");
  config.publisher.hold_back = {std::chrono::milliseconds(5), 0.0, 0.0, 0.0};
  config.budget_bit_s = 100'000'000;
  sharing::HelmetSharing sharing(config, std::move(channels), clock);
  HelmetMapper mapper({}, kGrid, {});
  if (!storage->attach(sharing)) _exit(2);
  if (storage->memory().mapper) mapper.resume(*std::move(storage->memory().mapper));
  const auto keep = storage->keep();
  const FullDisk full(room);
  auto scans = sources::open_source(source).value();
  for (SteadyTime ended{}; ended == SteadyTime{} || clock.steady_now() - ended < kRest;) {
    const auto scan = scans->next();
    if (scan && *scan) {
      mapper.step(**scan);
    } else if (ended == SteadyTime{}) {
      ended = clock.steady_now();
    }
    keep(mapper, mapper.state());
    sharing.put(mapper.take_changed_tiles());
    sharing.put(mapper.state());
    sharing.step();
    storage->step(sharing);
  }
  ::close(end);
  for (;;) ::pause();
}

class KilledHelmet : public testing::Test {
 protected:
  /// Lets a helmet walk until what came out is `enough` (or the walk is over) and some moment more,
  /// and kills it.
  template <typename Enough>
  void walk_and_kill(Enough enough, std::chrono::microseconds moment, double from_s,
                     std::size_t room = RLIM_INFINITY) {
    int ends[2];
    ASSERT_EQ(pipe(ends), 0);
    const pid_t child = fork();
    if (child == 0) {
      ::close(ends[0]);
      walk(folder_.path(), ends[1], from_s, room);
    }
    ::close(ends[1]);
    while (!enough() && hear(ends[0])) {
    }
    std::this_thread::sleep_for(moment);
    ::kill(child, SIGKILL);
    waitpid(child, nullptr, 0);
    while (hear(ends[0])) {
    }
    ::close(ends[0]);
  }

  /// Whether so many parts came out since.
  static auto parts(std::size_t wanted) {
    return [wanted]() mutable { return wanted-- == 0; };
  }

  [[nodiscard]] std::uint64_t largest_revision() const {
    std::uint64_t largest = 0;
    for (const auto& [tile, revision] : newest_) largest = std::max(largest, revision);
    return largest;
  }

  bool hear(int end) {
    Left left{};
    if (::read(end, &left, sizeof left) != sizeof left) return false;
    const auto [known, is_new] =
        left_.emplace(std::tuple(left.x, left.y, left.revision, left.part), left);
    EXPECT_TRUE(is_new ||
                (known->second.sha256 == left.sha256 && known->second.parts == left.parts))
        << "two contents of tile " << left.x << "/" << left.y << " share revision "
        << left.revision;
    auto& newest = newest_[{left.x, left.y}];
    newest = std::max(newest, left.revision);
    return true;
  }

  /// So many short lives in a row would be taken for the state's fault.
  void prove() {
    const SystemClock clock;
    (void)HelmetStorage::open(folder_.path(), killed_identity(), Floor{0}, {}, clock).value();
  }

  /// A start in good order, too.
  [[nodiscard]] std::uint64_t largest_kept_revision() const {
    const SystemClock clock;
    const auto storage =
        HelmetStorage::open(folder_.path(), killed_identity(), Floor{0}, {}, clock).value();
    std::uint64_t largest = 0;
    for (const auto& [tile, kept] : storage->memory().sharing.layers.begin()->second) {
      largest = std::max(largest, kept.revision.value);
    }
    return largest;
  }

  /// All that left is known to the state, and the layer is no older.
  void check_state() {
    const SystemClock clock;
    auto opened = store::open_state(folder_.path(), killed_identity(), {}, clock.wall_now());
    ASSERT_TRUE(opened && *opened);
    const auto memory =
        read_helmet_memory((*opened)->records, {(*opened)->start_number, (*opened)->opened_at},
                           killed_identity(), Floor{0});
    ASSERT_TRUE(memory) << memory.error().text;
    ASSERT_EQ(memory->map, MapId{1});
    ASSERT_TRUE(memory->mapper || newest_.empty());
    if (newest_.empty()) return;
    const auto& own = memory->sharing.layers.begin()->second;
    for (const auto& [tile, revision] : newest_) {
      const auto kept = own.find(TileIndex{tile.first, tile.second});
      ASSERT_NE(kept, own.end());
      ASSERT_GE(kept->second.revision.value, revision);
      check_payload(tile, kept->second);
      check_layer(kept->first, kept->second, memory->mapper->layer);
    }
  }

  void check_payload(std::pair<int, int> tile, const sharing::KeptTile& kept) {
    const auto parts = wire::split_payload(kept.payload);
    for (std::size_t part = 0; part < parts.size(); ++part) {
      const auto left = left_.find({tile.first, tile.second, kept.revision.value, part});
      if (left == left_.end()) continue;  // was on disk, but had not left yet
      EXPECT_EQ(left->second.sha256, Sha256().add(parts[part]).finish());
    }
  }

  static void check_layer(TileIndex tile, const sharing::KeptTile& kept, const TsdGrid& layer) {
    const TsdTile* cells = layer.find(tile);
    ASSERT_NE(cells, nullptr);
    for (std::size_t i = 0; i < cells->size(); ++i) {
      ASSERT_TRUE((*kept.cells)[i].weight == 0 || (*cells)[i].known())
          << "others know a cell that the layer has lost";
    }
  }

  support::TemporaryFolder folder_;
  std::map<std::tuple<std::int32_t, std::int32_t, std::uint64_t, std::uint8_t>, Left> left_;
  std::map<std::pair<std::int32_t, std::int32_t>, std::uint64_t> newest_;
};

TEST_F(KilledHelmet, KnowsAllThatHadLeftItAndNeverGivesARevisionTwice) {
  std::mt19937 random(23);
  for (int round = 0; round < 12; ++round) {
    // Now and then before anything has left.
    const std::size_t wanted = round % 4 == 1 ? 0 : 1 + random() % 400;
    walk_and_kill(parts(wanted), std::chrono::microseconds(random() % 60'000),
                  static_cast<double>(random() % 20));
    ASSERT_FALSE(HasFatalFailure()) << round;
    check_state();
    ASSERT_FALSE(HasFatalFailure()) << round;
    prove();
  }
  EXPECT_GT(newest_.size(), 10U);
  RecordProperty("parts", static_cast<int>(left_.size()));
}

TEST_F(KilledHelmet, GivesNoRevisionTwiceThoughTheDiskWasFullWhenItWasKilled) {
  walk_and_kill(parts(300), {}, 0.0);
  const std::uint64_t kept = largest_kept_revision();
  walk_and_kill([&] { return largest_revision() > kept; }, kMoment, 1.0, kNoRoom);
  ASSERT_FALSE(HasFatalFailure());
  const std::uint64_t told = largest_revision();
  EXPECT_LT(largest_kept_revision(), told) << "the disk did not refuse";
  // What left while the disk refused, the state need not know (docs/decisions/0601).
  newest_.clear();
  walk_and_kill([&] { return largest_revision() > told; }, kMoment, 1.0);
  ASSERT_FALSE(HasFatalFailure());
  EXPECT_GT(largest_revision(), told);
  check_state();
}

}  // namespace
}  // namespace lifeline::test
