#include "common/store/record_file.hpp"

#include <algorithm>
#include <csignal>
#include <fstream>
#include <random>

#include <gtest/gtest.h>
#include <sys/wait.h>

#include "common/store/put_aside.hpp"
#include "tests/support/full_disk.hpp"
#include "tests/support/temporary_folder.hpp"

namespace lifeline::store {
namespace {

using std::filesystem::path;

std::string text_of(int number, std::size_t size) {
  std::mt19937 random(static_cast<unsigned>(number));
  std::string text(size, '\0');
  for (char& c : text) c = static_cast<char>(random());
  return text;
}

/// Commits 1 to `commits`, each of three records that change and one that is added.
void write_commits(RecordFile& file, int commits) {
  for (int n = 1; n <= commits; ++n) {
    const std::string number = std::to_string(n);
    ASSERT_TRUE(file.write({{"commit", number},
                            {"a", text_of(n, 900)},
                            {"b", text_of(n + 1000, 1700)},
                            {"added/" + number, number}}));
  }
}

/// Whether the records are those after some commit; which.
std::optional<int> commit_of(const Records& records) {
  if (records.empty()) return 0;
  const int n = std::stoi(records.at("commit"));
  Records expected{
      {"commit", std::to_string(n)}, {"a", text_of(n, 900)}, {"b", text_of(n + 1000, 1700)}};
  for (int i = 1; i <= n; ++i) expected["added/" + std::to_string(i)] = std::to_string(i);
  return records == expected ? std::optional(n) : std::nullopt;
}

std::string octets_of(const path& file) {
  return support::content_of(file);
}

void put(const path& file, std::string_view octets) {
  std::ofstream(file, std::ios::binary | std::ios::trunc) << octets;
}

class RecordFileTest : public testing::Test {
 protected:
  [[nodiscard]] RecordFile opened() const {
    auto file = RecordFile::open(file_);
    EXPECT_TRUE(file.has_value()) << (file ? "" : file.error().text);
    return *std::move(file);
  }
  [[nodiscard]] Records reread() const { return opened().read_all().value(); }

  /// The file and its log as a process that was killed leaves them: the log holds the newest
  /// commits.
  std::pair<std::string, std::string> as_after_a_kill(int commits) {
    RecordFile file = opened();
    write_commits(file, commits);
    return {octets_of(file_), octets_of(log_)};
  }

  support::TemporaryFolder folder_;
  path file_ = folder_.path() / "sub/alpha.state";
  path log_ = folder_.path() / "sub/alpha.state-wal";
};

TEST_F(RecordFileTest, KeepsWhatWasWritten) {
  const std::string any = text_of(1, 5000);
  ASSERT_TRUE(opened().write({{"a", any}, {"b", "2"}, {"c", ""}}));
  ASSERT_TRUE(opened().write({{"b", "3"}, {"a", std::nullopt}, {"never there", std::nullopt}}));
  EXPECT_EQ(reread(), (Records{{"b", "3"}, {"c", ""}}));
}

TEST_F(RecordFileTest, IsNotOpenedTwiceAndNamesWhoHoldsIt) {
  const RecordFile first = opened();
  const auto second = RecordFile::open(file_);
  ASSERT_FALSE(second);
  EXPECT_EQ(second.error().problem, FileProblem::in_use);
  EXPECT_NE(second.error().text.find("process " + std::to_string(getpid())), std::string::npos)
      << second.error().text;
}

TEST_F(RecordFileTest, IsFreeAgainOnceItsProcessWasKilled) {
  int pipe_ends[2];
  ASSERT_EQ(pipe(pipe_ends), 0);
  const pid_t child = fork();
  if (child == 0) {
    const RecordFile file = opened();
    [[maybe_unused]] const auto told = ::write(pipe_ends[1], "x", 1);
    for (;;) pause();
  }
  char told = 0;
  ASSERT_EQ(::read(pipe_ends[0], &told, 1), 1);
  EXPECT_EQ(RecordFile::open(file_).error().problem, FileProblem::in_use);
  kill(child, SIGKILL);
  waitpid(child, nullptr, 0);
  EXPECT_TRUE(RecordFile::open(file_).has_value());
}

TEST_F(RecordFileTest, ALogCutAtAnyOctetGivesAPrefixOfTheCommits) {
  const auto [main, log] = as_after_a_kill(6);
  ASSERT_GT(log.size(), 6U * 3000U);
  int longest = 0, shortest = 100;
  for (std::size_t cut = 0; cut <= log.size(); cut += (cut < 4200 ? 41 : 359)) {
    put(file_, main);
    put(log_, std::string_view(log).substr(0, cut));
    const auto commit = commit_of(reread());
    ASSERT_TRUE(commit) << "cut at " << cut;
    ASSERT_GE(*commit, longest) << "cut at " << cut;
    longest = std::max(longest, *commit);
    shortest = std::min(shortest, *commit);
  }
  EXPECT_EQ(shortest, 0);
  put(file_, main);
  put(log_, log);
  EXPECT_EQ(commit_of(reread()), 6);
}

TEST_F(RecordFileTest, AnOctetThatFellOverInTheLogCostsTheCommitsAfterItAtMost) {
  const auto [main, log] = as_after_a_kill(6);
  for (std::size_t at = 0; at < log.size(); at += 617) {
    std::string broken = log;
    broken[at] = static_cast<char>(broken[at] ^ 0x41);
    put(file_, main);
    put(log_, broken);
    ASSERT_TRUE(commit_of(reread())) << "at " << at;
  }
}

TEST_F(RecordFileTest, AFileCutAnywhereIsWholeOrNamedAsDamaged) {
  {
    auto file = opened();
    write_commits(file, 12);
  }
  const std::string main = octets_of(file_);
  std::size_t damaged = 0;
  for (std::size_t cut = 1; cut <= main.size(); cut += (cut < 200 ? 7 : 331)) {
    put(file_, std::string_view(main).substr(0, cut));
    std::filesystem::remove(log_);
    const auto file = RecordFile::open(file_);
    const auto records = file ? file->read_all() : tl::unexpected(file.error());
    if (records) {
      ASSERT_TRUE(commit_of(*records)) << "cut at " << cut;
      continue;
    }
    ASSERT_EQ(records.error().problem, FileProblem::damaged) << records.error().text;
    ASSERT_EQ(records.error().text.find('\n'), std::string::npos);
    ++damaged;
  }
  EXPECT_GT(damaged, 20U);
}

TEST_F(RecordFileTest, ABitThatFellOverIsNoticed) {
  {
    auto file = opened();
    write_commits(file, 12);
  }
  const std::string main = octets_of(file_);
  std::mt19937 random(5);
  std::size_t damaged = 0;
  for (int round = 0; round < 300; ++round) {
    std::string broken = main;
    const std::size_t at = random() % broken.size();
    broken[at] = static_cast<char>(broken[at] ^ (1 << (random() % 8)));
    put(file_, broken);
    std::filesystem::remove(log_);
    const auto file = RecordFile::open(file_);
    const auto records = file ? file->read_all() : tl::unexpected(file.error());
    // A bit of an unused octet harms nobody.
    if (records) {
      ASSERT_EQ(commit_of(*records), 12) << "at " << at;
    } else {
      ASSERT_EQ(records.error().problem, FileProblem::damaged) << records.error().text;
      ++damaged;
    }
  }
  EXPECT_GT(damaged, 40U);
}

TEST_F(RecordFileTest, WhatIsNoStateFileIsDamaged) {
  std::filesystem::create_directories(file_.parent_path());
  const std::vector<std::string> contents = {"not a database at all, but long enough to be read\n",
                                             std::string(5000, 'x'), std::string(100, '\0')};
  for (const std::string& content : contents) {
    put(file_, content);
    const auto file = RecordFile::open(file_);
    ASSERT_FALSE(file) << content.substr(0, 20);
    EXPECT_EQ(file.error().problem, FileProblem::damaged) << file.error().text;
  }
}

TEST_F(RecordFileTest, AFolderThatIsNoneIsRefused) {
  put(folder_.path() / "file", "x");
  const auto file = RecordFile::open(folder_.path() / "file/alpha.state");
  ASSERT_FALSE(file);
  EXPECT_EQ(file.error().problem, FileProblem::refused);
}

TEST_F(RecordFileTest, AFullDiskLeavesTheFileAsItWasAndWritableLater) {
  RecordFile file = opened();
  write_commits(file, 3);
  {
    const lifeline::test::FullDisk full(60'000);
    const auto written = file.write({{"commit", "4"}, {"large", text_of(9, 300'000)}});
    ASSERT_FALSE(written);
    EXPECT_EQ(written.error().problem, FileProblem::refused) << written.error().text;
    EXPECT_EQ(commit_of(file.read_all().value()), 3);
  }
  ASSERT_TRUE(file.write(
      {{"commit", "4"}, {"a", text_of(4, 900)}, {"b", text_of(1004, 1700)}, {"added/4", "4"}}));
  EXPECT_EQ(commit_of(file.read_all().value()), 4);
}

TEST_F(RecordFileTest, IsPutAsideUnderAFreeNameWithItsLog) {
  const auto [main, log] = as_after_a_kill(2);
  for (int n = 1; n <= kMostAside + 2; ++n) {
    put(file_, main);
    put(log_, log);
    const auto aside = put_aside(file_, "damaged");
    ASSERT_TRUE(aside) << aside.error().text;
    EXPECT_EQ(aside->filename(), "alpha.state.damaged-" + std::to_string(std::min(n, kMostAside)));
    EXPECT_TRUE(std::filesystem::exists(aside->string() + "-wal"));
    EXPECT_FALSE(std::filesystem::exists(file_));
  }
  EXPECT_TRUE(reread().empty());
}

}  // namespace
}  // namespace lifeline::store
