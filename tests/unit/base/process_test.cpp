// What a process has of its surroundings: configuration folder, signals, log, command line.

#include <csignal>
#include <cstdlib>
#include <thread>

#include <gmock/gmock.h>

#include "common/base/config_folder.hpp"
#include "common/base/log.hpp"
#include "common/base/stop_signal.hpp"
#include "common/cli/command_line.hpp"
#include "tests/support/temporary_folder.hpp"

namespace lifeline {
namespace {

using ::testing::HasSubstr;

class ConfigFolder : public ::testing::Test {
 protected:
  ~ConfigFolder() override { ::unsetenv("LIFELINE_CONFIG"); }
};

TEST_F(ConfigFolder, IsTheOneThatWasChosen) {
  const support::TemporaryFolder folder;
  ::setenv("LIFELINE_CONFIG", folder.path().c_str(), 1);
  EXPECT_EQ(config_folder().value(), folder.path());
}

TEST_F(ConfigFolder, AChosenOneThatIsNotThereIsNamed) {
  ::setenv("LIFELINE_CONFIG", "/no/such", 1);
  const auto folder = config_folder();
  ASSERT_FALSE(folder);
  EXPECT_EQ(folder.error().text, "LIFELINE_CONFIG=/no/such: no such folder");
}

TEST(StopSignal, AsksTheProgramToFinish) {
  watch_stop_signals();
  EXPECT_FALSE(stop_requested());
  std::raise(SIGTERM);
  EXPECT_TRUE(stop_requested());
}

TEST(Log, TakesALevelByNameAndInfoForAnyOther) {
  const auto before = spdlog::default_logger();
  set_up_log("test", "warn");
  EXPECT_EQ(spdlog::default_logger()->level(), spdlog::level::warn);
  set_up_log("test", "nonsense");
  EXPECT_EQ(spdlog::default_logger()->level(), spdlog::level::info);
  EXPECT_EQ(spdlog::default_logger()->name(), "test");
  spdlog::set_default_logger(before);
}

TEST(Log, LeavesOutWhatAQuietThreadSaysAgainButNoErrors) {
  const auto before = spdlog::default_logger();
  ::testing::internal::CaptureStderr();
  set_up_log("test", "info");
  std::jthread([] {
    const QuietLog quiet;
    spdlog::warn("played again");
    spdlog::error("went wrong");
  }).join();
  spdlog::info("said by others");
  spdlog::set_default_logger(before);
  const std::string said = ::testing::internal::GetCapturedStderr();
  EXPECT_THAT(said, ::testing::Not(HasSubstr("played again")));
  EXPECT_THAT(said, HasSubstr("went wrong"));
  EXPECT_THAT(said, HasSubstr("said by others"));
}

int parse(std::vector<const char*> words) {
  CLI::App app("a program", "prog");
  int status = 7;
  app.add_subcommand("go", "goes");
  return cli::parse_command_line(app, static_cast<int>(words.size()),
                                 const_cast<char**>(words.data()), status);
}

TEST(CommandLine, AnswersTheExitStatus) {
  EXPECT_EQ(parse({"prog", "go"}), 7);
  ::testing::internal::CaptureStdout();
  EXPECT_EQ(parse({"prog", "--help"}), 0);
  EXPECT_THAT(::testing::internal::GetCapturedStdout(), HasSubstr("a program"));
}

TEST(CommandLine, WrongUseIsTwoWithOneLine) {
  ::testing::internal::CaptureStderr();
  EXPECT_EQ(parse({"prog", "fly"}), 2);
  const std::string said = ::testing::internal::GetCapturedStderr();
  EXPECT_THAT(said, HasSubstr("see --help"));
  EXPECT_EQ(std::count(said.begin(), said.end(), '\n'), 1) << said;
}

}  // namespace
}  // namespace lifeline
