#include "common/doctor/check_clock.hpp"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include "tests/support/temporary_folder.hpp"

namespace lifeline::doctor {
namespace {

using std::chrono::hours;
using std::chrono::milliseconds;
using testing::HasSubstr;

ClockState good_clock() {
  return {SystemClock().wall_now(), true, true, milliseconds(3)};
}

TEST(CheckClock, TheKernelIsAsked) {
  const ClockState clock = read_clock();
  EXPECT_LT(std::chrono::abs(clock.now - SystemClock().wall_now()), hours(1));
  EXPECT_GE(clock.max_error.count(), 0);
}

TEST(CheckClock, ASynchronisedClockIsGood) {
  const auto found = check_clock(good_clock(), std::nullopt);
  ASSERT_EQ(found.size(), 2U);
  EXPECT_EQ(found[0].level, Level::ok);
  EXPECT_EQ(found[0].what, "synchronised, off by at most 3.0 ms");
  EXPECT_EQ(found[1].level, Level::ok);
}

TEST(CheckClock, OneThatNobodySetsOrThatIsFarOffIsWarnedOf) {
  ClockState clock = good_clock();
  clock.max_error = milliseconds(250);
  EXPECT_EQ(check_clock(clock, std::nullopt)[0].level, Level::warning);
  clock.is_synchronised = false;
  EXPECT_THAT(check_clock(clock, std::nullopt)[0].advice, HasSubstr("chrony"));
  clock.is_known = false;
  EXPECT_EQ(check_clock(clock, std::nullopt)[0].level, Level::warning);
  EXPECT_EQ(check_clock(clock, std::nullopt, true)[0].level, Level::ok) << "one machine alone";
}

TEST(CheckClock, AFileFromTheFutureShowsThatTheClockWasSetBack) {
  const support::TemporaryFolder folder;
  std::ignore = folder.write("old.state", "x");
  const auto file = folder.write("new.state", "x");
  const ClockState clock = good_clock();
  EXPECT_EQ(check_clock(clock, newest_of({folder.path()}))[1].level, Level::ok);

  const auto ahead =
      std::chrono::duration_cast<std::chrono::seconds>((clock.now + hours(2)).time_since_epoch());
  const timespec times[2] = {{ahead.count(), 0}, {ahead.count(), 0}};
  ASSERT_EQ(utimensat(AT_FDCWD, file.c_str(), times, 0), 0);
  const auto newest = newest_of({folder.path() / "nowhere", folder.path()});
  ASSERT_TRUE(newest);
  EXPECT_EQ(newest->file, file);
  const auto found = check_clock(clock, newest);
  EXPECT_EQ(found[1].level, Level::fault);
  EXPECT_THAT(found[1].what, HasSubstr("new.state"));
}

TEST(CheckClock, PlacesThatAreNotThereTellNothing) {
  EXPECT_FALSE(newest_of({"/nowhere/at/all", "off"}));
}

}  // namespace
}  // namespace lifeline::doctor
