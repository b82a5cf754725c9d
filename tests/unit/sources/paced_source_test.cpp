#include "agents/sources/paced_source.hpp"

#include <deque>
#include <thread>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace lifeline::sources {
namespace {

using std::chrono::milliseconds;
using ::testing::ElementsAre;

constexpr Duration kTiny = std::chrono::microseconds(10);

/// Gives scans at the stamps it is told, then an error or the end.
class ListedSource final : public sensing::ScanSource {
 public:
  explicit ListedSource(std::deque<Duration> stamps, bool fails = false)
      : stamps_(std::move(stamps)), fails_(fails) {}

  Result<std::optional<sensing::RawScan>> next() override {
    if (stamps_.empty() && fails_) return fail(ErrorCode::bad_data, "broken");
    if (stamps_.empty()) return std::nullopt;
    sensing::RawScan scan;
    scan.stamp = Timestamp(stamps_.front());
    stamps_.pop_front();
    return scan;
  }

 private:
  std::deque<Duration> stamps_;
  bool fails_;
};

/// A paced source on a clock that only waiting moves.
class PacedSourceTest : public ::testing::Test {
 protected:
  PacedSource paced(std::deque<Duration> stamps, SourcePace pace, bool fails = false) {
    return {std::make_unique<ListedSource>(std::move(stamps), fails), pace, clock_,
            [this](Duration duration) {
              if (stopped_) return false;
              waits_.push_back(std::chrono::round<milliseconds>(duration));
              clock_.advance(duration);
              return true;
            }};
  }
  static bool gives_scan(PacedSource& source) {
    const auto scan = source.next();
    return scan && *scan;
  }

  ManualClock clock_;
  std::vector<milliseconds> waits_;
  bool stopped_ = false;
};

TEST_F(PacedSourceTest, HandsScansOnAtTheirRecordedDistances) {
  auto source = paced({milliseconds(5000), milliseconds(5100), milliseconds(5400)}, kRealTime);
  while (gives_scan(source)) {
  }
  EXPECT_THAT(waits_, ElementsAre(milliseconds(100), milliseconds(300)));
}

TEST_F(PacedSourceTest, PlaysNTimesAsFast) {
  auto source = paced({milliseconds(0), milliseconds(100), milliseconds(400)}, SourcePace{4.0});
  while (gives_scan(source)) {
  }
  EXPECT_THAT(waits_, ElementsAre(milliseconds(25), milliseconds(75)));
}

TEST_F(PacedSourceTest, CatchesUpWithATakerThatWasSlow) {
  auto source =
      paced({milliseconds(0), milliseconds(100), milliseconds(200), milliseconds(300)}, kRealTime);
  EXPECT_TRUE(gives_scan(source));
  clock_.advance(milliseconds(250));
  EXPECT_TRUE(gives_scan(source));
  EXPECT_TRUE(gives_scan(source));
  EXPECT_THAT(waits_, ElementsAre());
  EXPECT_TRUE(gives_scan(source));
  EXPECT_THAT(waits_, ElementsAre(milliseconds(50)));
}

TEST_F(PacedSourceTest, DoesNotWaitForAStampThatGoesBack) {
  auto source = paced({milliseconds(1000), milliseconds(900), milliseconds(1100)}, kRealTime);
  while (gives_scan(source)) {
  }
  EXPECT_THAT(waits_, ElementsAre(milliseconds(100)));
}

TEST_F(PacedSourceTest, WaitsOutAGapOfYearsInPieces) {
  auto source = paced({Duration{0}, std::chrono::hours(5)}, SourcePace{0.5});
  while (gives_scan(source)) {
  }
  EXPECT_GE(waits_.size(), 10U);
  EXPECT_LE(waits_.size(), 11U);  // what rounding leaves may take one more
  for (const auto wait : waits_) EXPECT_LE(wait, std::chrono::hours(1));
}

TEST_F(PacedSourceTest, EndsWhenAWaitIsCutShort) {
  auto source = paced({milliseconds(0), milliseconds(100)}, kRealTime);
  EXPECT_TRUE(gives_scan(source));
  stopped_ = true;
  const auto scan = source.next();
  ASSERT_TRUE(scan);
  EXPECT_FALSE(*scan);
}

TEST_F(PacedSourceTest, HandsErrorsOnAtOnce) {
  auto source = paced({milliseconds(0)}, kRealTime, true);
  EXPECT_TRUE(gives_scan(source));
  const auto scan = source.next();
  ASSERT_FALSE(scan);
  EXPECT_EQ(scan.error().text, "broken");
}

TEST(SourcePace, IsReadFromItsOption) {
  EXPECT_EQ(parse_source_pace("real"), kRealTime);
  EXPECT_EQ(parse_source_pace("max"), kUnpaced);
  EXPECT_EQ(parse_source_pace("x2.5"), SourcePace{2.5});
  EXPECT_EQ(parse_source_pace("x0.01"), SourcePace{0.01});
}

TEST(SourcePace, RefusesWhatIsNoPace) {
  for (const std::string text :
       {"", "fast", "2", "x", "x0", "x-1", "xnan", "xinf", "x1001", "x2s", "X2"}) {
    const auto pace = parse_source_pace(text);
    ASSERT_FALSE(pace) << text;
    EXPECT_EQ(pace.error().code, ErrorCode::wrong_use);
    EXPECT_EQ(pace.error().text, "rate=" + text +
                                     " is none of: real, max, xN (N times as fast as recorded, "
                                     "0.01 to 1000)");
  }
}

TEST(StoppableWait, LastsItsTimeAndSaysSo) {
  const std::stop_source stop;
  EXPECT_TRUE(stoppable_wait(stop.get_token())(kTiny));
  EXPECT_TRUE(stoppable_wait({})(kTiny));
}

TEST(StoppableWait, IsCutShortByARequestBeforeOrDuringIt) {
  std::stop_source stop;
  const Wait wait = stoppable_wait(stop.get_token());
  std::jthread stopper([&] { stop.request_stop(); });
  EXPECT_FALSE(wait(std::chrono::hours(1)));
  EXPECT_FALSE(wait(std::chrono::hours(1)));
}

}  // namespace
}  // namespace lifeline::sources
