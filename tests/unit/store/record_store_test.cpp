#include "common/store/record_store.hpp"

#include <atomic>
#include <csignal>
#include <future>
#include <random>
#include <thread>

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include "common/store/write_ahead_outbox.hpp"
#include "tests/support/full_disk.hpp"
#include "tests/support/temporary_folder.hpp"

namespace lifeline::store {
namespace {

using std::filesystem::path;

constexpr auto kPatience = std::chrono::seconds(30);

class RecordStoreTest : public testing::Test {
 protected:
  [[nodiscard]] RecordFile opened() const { return RecordFile::open(file_).value(); }
  [[nodiscard]] Records reread() const { return opened().read_all().value(); }
  static bool wait_until(const std::function<bool()>& done) {
    const auto deadline = std::chrono::steady_clock::now() + kPatience;
    while (!done() && std::chrono::steady_clock::now() < deadline) {
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    return done();
  }

  support::TemporaryFolder folder_;
  path file_ = folder_.path() / "alpha.state";
};

TEST_F(RecordStoreTest, WritesTheNewestContentOfEachRecord) {
  {
    RecordStore store(opened());
    for (int i = 0; i < 1000; ++i) store.put("a", std::to_string(i));
    store.put("b", "once");
    store.put("gone", "soon");
    store.flush();
    EXPECT_EQ(store.settled(), store.newest());
    store.put("gone", [] { return std::nullopt; });
  }
  EXPECT_EQ(reread(), (Records{{"a", "999"}, {"b", "once"}}));
}

TEST_F(RecordStoreTest, NobodyWaitsForASlowDisk) {
  // A content that is not made yet holds the writer up, as a disk would.
  std::promise<void> gate;
  auto passed = gate.get_future().share();
  {
    RecordStore store(opened());
    store.put("slow", [passed] {
      passed.wait();
      return std::optional<std::string>("s");
    });
    for (int i = 0; i < 100; ++i) store.put(std::to_string(i), "x");
    EXPECT_LT(store.settled(), store.newest());
    gate.set_value();
    EXPECT_TRUE(wait_until([&] { return store.settled() == store.newest(); }));
  }
  EXPECT_EQ(reread().size(), 101U);
}

TEST_F(RecordStoreTest, AFullDiskIsToldAndTheMissionGoesOnUntilThereIsRoomAgain) {
  RecordStoreConfig config;
  config.commit_interval = std::chrono::milliseconds(1);
  config.retry_interval = std::chrono::milliseconds(5);
  std::mt19937 random(3);
  std::string large(400'000, '\0');
  for (char& c : large) c = static_cast<char>(random());
  {
    RecordStore store(opened(), config);
    store.put("before", "1");
    store.flush();
    {
      const lifeline::test::FullDisk full(50'000);
      store.put("large", large);
      ASSERT_TRUE(wait_until([&] { return !store.works(); }));
      const auto ticket = store.put("large too", "2");
      EXPECT_EQ(store.settled(), ticket) << "nobody waits for a disk that refuses";
      store.put("before", "3");
    }
    ASSERT_TRUE(wait_until([&] { return store.works(); }));
  }
  EXPECT_EQ(reread(), (Records{{"before", "3"}, {"large", large}, {"large too", "2"}}));
}

class Counted final : public wire::Outbox<int> {
 public:
  Counted(std::vector<int>& sent, const bool& refuses) : sent_(sent), refuses_(refuses) {}
  Result<void> put(const int& message) override {
    if (refuses_) return fail(ErrorCode::unavailable, "not now");
    sent_.push_back(message);
    return {};
  }
  bool has_reader() const override { return true; }

 private:
  std::vector<int>& sent_;
  const bool& refuses_;
};

TEST_F(RecordStoreTest, SamplesLeaveInOrderOnceTheyAreOnDisk) {
  std::promise<void> gate;
  auto passed = gate.get_future().share();
  std::vector<int> sent;
  bool refuses = false;
  RecordStore store(opened());
  WriteAheadOutbox<int> outbox(std::make_unique<Counted>(sent, refuses), store,
                               [&](const int& message) {
                                 return store.put("tile", [passed, message] {
                                   passed.wait();
                                   return std::optional(std::to_string(message));
                                 });
                               });
  for (int i = 1; i <= 3; ++i) ASSERT_TRUE(outbox.put(i));
  outbox.pump();
  EXPECT_TRUE(sent.empty());
  gate.set_value();
  ASSERT_TRUE(wait_until([&] { return store.settled() == store.newest(); }));
  refuses = true;
  outbox.pump();
  EXPECT_TRUE(sent.empty());
  refuses = false;
  outbox.pump();
  EXPECT_EQ(sent, (std::vector{1, 2, 3}));
}

/// Writes records 1, 2, 3 ... and tells through `pipe_end` how many are settled, until killed.
[[noreturn]] void write_for_ever(const path& file, int pipe_end) {
  RecordStoreConfig config;
  config.commit_interval = std::chrono::milliseconds(2);
  RecordStore store(RecordFile::open(file).value(), config);
  std::uint32_t told = 0;
  for (std::uint32_t n = 1;; ++n) {
    store.put("r/" + std::to_string(n), std::string(n % 700, static_cast<char>('a' + n % 26)));
    auto settled = static_cast<std::uint32_t>(store.settled());
    // No more than the disk takes: the records would become too many.
    while (n - settled > 40) settled = static_cast<std::uint32_t>(store.settled());
    if (settled == told) continue;
    told = settled;
    if (::write(pipe_end, &told, sizeof told) != sizeof told) _exit(1);
  }
}

TEST_F(RecordStoreTest, KilledAtAnyMomentItLosesNothingThatWasAcknowledged) {
  std::mt19937 random(17);
  std::size_t acknowledged_in_all = 0;
  for (int round = 0; round < 25; ++round) {
    const path file = folder_.path() / (std::to_string(round) + ".state");
    int ends[2];
    ASSERT_EQ(pipe(ends), 0);
    const pid_t child = fork();
    if (child == 0) {
      ::close(ends[0]);
      write_for_ever(file, ends[1]);
    }
    ::close(ends[1]);
    std::uint32_t acknowledged = 0;
    const auto wanted = 1 + random() % 12;
    for (std::size_t told = 0; told < wanted; ++told) {
      ASSERT_EQ(::read(ends[0], &acknowledged, sizeof acknowledged), sizeof acknowledged);
    }
    // Not at the acknowledgement alone: anywhere in what follows it.
    std::this_thread::sleep_for(std::chrono::microseconds(random() % 3000));
    kill(child, SIGKILL);
    waitpid(child, nullptr, 0);
    while (::read(ends[0], &acknowledged, sizeof acknowledged) == sizeof acknowledged) {
    }
    ::close(ends[0]);
    auto opened = RecordFile::open(file);
    ASSERT_TRUE(opened) << opened.error().text;
    const auto records = opened->read_all();
    ASSERT_TRUE(records) << records.error().text;
    ASSERT_GE(records->size(), acknowledged);
    for (std::uint32_t n = 1; n <= records->size(); ++n) {
      ASSERT_EQ(records->at("r/" + std::to_string(n)),
                std::string(n % 700, static_cast<char>('a' + n % 26)))
          << "of " << records->size() << ", " << acknowledged << " acknowledged";
    }
    acknowledged_in_all += acknowledged;
  }
  RecordProperty("acknowledged", static_cast<int>(acknowledged_in_all));
  EXPECT_GT(acknowledged_in_all, 100U);
}

}  // namespace
}  // namespace lifeline::store
