#include "deploy/demo/child_process.hpp"

#include <filesystem>
#include <fstream>
#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

namespace lifeline::demo {
namespace {

using testing::HasSubstr;
using namespace std::chrono_literals;

std::string log_path() {
  const auto* test = testing::UnitTest::GetInstance()->current_test_info();
  return testing::TempDir() + "child_" + test->name() + "." + std::to_string(getpid()) + ".log";
}

std::string content(const std::string& path) {
  std::ostringstream text;
  text << std::ifstream(path).rdbuf();
  return text.str();
}

Result<ChildProcess> shell(const std::string& script) {
  return ChildProcess::start({{"/bin/sh", "-c", script}, log_path()});
}

/// How the child ends, or nothing when it does not within ten seconds.
std::optional<int> wait_for(ChildProcess& child) {
  SignalWatch signals;
  for (int i = 0; i < 1000 && !child.ended(); ++i) (void)signals.wait(10ms);
  return child.ended();
}

/// Also false for a process that has ended but that nobody has asked about yet.
bool is_alive(pid_t pid) {
  const std::string stat = content("/proc/" + std::to_string(pid) + "/stat");
  return !stat.empty() && stat.find(") Z ") == std::string::npos;
}

/// The number that a script wrote into its log, once it has.
pid_t pid_in_log() {
  for (int i = 0; i < 1000; ++i) {
    const std::string text = content(log_path());
    if (text.ends_with('\n')) return static_cast<pid_t>(std::stoi(text));
    usleep(10'000);
  }
  return -1;
}

bool dies(pid_t pid) {
  for (int i = 0; i < 1000 && is_alive(pid); ++i) usleep(10'000);
  return !is_alive(pid);
}

TEST(ChildProcess, tells_its_exit_status) {
  auto child = shell("exit 7");
  ASSERT_TRUE(child);
  EXPECT_EQ(wait_for(*child), 7);
}

TEST(ChildProcess, tells_the_signal_that_ended_it) {
  auto child = shell("kill -TERM $$");
  ASSERT_TRUE(child);
  EXPECT_EQ(wait_for(*child), 128 + SIGTERM);
}

TEST(ChildProcess, writes_both_of_its_outputs_to_its_log) {
  auto child = shell("echo out; echo err >&2");
  ASSERT_TRUE(child);
  ASSERT_EQ(wait_for(*child), 0);
  EXPECT_EQ(content(log_path()), "out\nerr\n");
}

TEST(ChildProcess, ends_when_sent_a_signal_although_we_block_it) {
  const SignalWatch blocks_all;
  auto child = shell("sleep 60");
  ASSERT_TRUE(child);
  EXPECT_FALSE(child->ended());
  child->send(SIGTERM);
  EXPECT_EQ(wait_for(*child), 128 + SIGTERM);
}

TEST(ChildProcess, names_a_program_that_cannot_be_started) {
  const auto child = ChildProcess::start({{"/nowhere/program"}, log_path()});
  ASSERT_FALSE(child);
  EXPECT_THAT(child.error().text, HasSubstr("/nowhere/program"));
  EXPECT_THAT(child.error().text, HasSubstr("No such file"));
}

TEST(ChildProcess, cannot_be_started_without_a_place_for_its_log) {
  const auto child = ChildProcess::start({{"/bin/true"}, "/nowhere/a.log"});
  ASSERT_FALSE(child);
  EXPECT_THAT(child.error().text, HasSubstr("/nowhere/a.log"));
}

TEST(ChildProcess, is_gone_with_what_it_started_when_its_object_goes) {
  pid_t grandchild = -1;
  {
    auto child = shell("sleep 60 & echo $!; wait");
    ASSERT_TRUE(child);
    grandchild = pid_in_log();
    ASSERT_GT(grandchild, 0);
    EXPECT_TRUE(is_alive(grandchild));
  }
  EXPECT_TRUE(dies(grandchild));
}

TEST(ChildProcess, dies_with_us_when_we_are_killed) {
  const ChildCommand sleeper{{"/bin/sh", "-c", "echo $$; exec sleep 60"}, log_path()};
  const pid_t parent = fork();
  if (parent == 0) {
    auto child = ChildProcess::start(sleeper);
    sleep(60);
    _exit(0);
  }
  const pid_t child = pid_in_log();
  const bool lived = child > 0 && is_alive(child);
  kill(parent, SIGKILL);
  waitpid(parent, nullptr, 0);
  ASSERT_TRUE(lived);
  EXPECT_TRUE(dies(child));
}

TEST(SignalWatch, hands_out_a_request_to_stop_instead_of_dying_of_it) {
  SignalWatch signals;
  raise(SIGINT);
  EXPECT_EQ(signals.wait(10s), SignalWatch::Event::asked_to_stop);
}

TEST(SignalWatch, sees_a_child_end) {
  SignalWatch signals;
  auto child = shell("exit 0");
  ASSERT_TRUE(child);
  EXPECT_EQ(signals.wait(10s), SignalWatch::Event::child_ended);
}

TEST(SignalWatch, gives_up_when_the_time_has_passed) {
  SignalWatch signals;
  EXPECT_EQ(signals.wait(1ms), SignalWatch::Event::time_passed);
}

}  // namespace
}  // namespace lifeline::demo
