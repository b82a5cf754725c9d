#include "agents/sources/line_reader.hpp"

#include <fstream>
#include <iterator>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/recordings.hpp"

namespace lifeline::sources {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

struct Read {
  std::vector<std::string> lines;
  bool last_complete = true;
  std::string error;
};

Read read_all(const std::string& path) {
  Read read;
  auto reader = LineReader::open(path);
  if (!reader) {
    read.error = reader.error().text;
    return read;
  }
  for (;;) {
    const auto line = reader->next();
    if (!line) {
      read.error = line.error().text;
      return read;
    }
    if (!*line) return read;
    read.lines.emplace_back((*line)->text);
    read.last_complete = (*line)->is_complete;
    EXPECT_EQ(reader->line_number(), read.lines.size());
  }
}

std::string content_of(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

TEST(LineReader, ReadsPlainAndCompressedFilesAlike) {
  const test::RecordingFolder folder;
  const std::string text = "one\n\nthree\n";
  for (const std::string& path : {folder.write("plain", text), folder.write_gz("packed", text)}) {
    const Read read = read_all(path);
    EXPECT_THAT(read.lines, ElementsAre("one", "", "three"));
    EXPECT_TRUE(read.last_complete);
    EXPECT_EQ(read.error, "");
  }
}

TEST(LineReader, MarksALastLineWithoutNewline) {
  const test::RecordingFolder folder;
  const Read read = read_all(folder.write("log", "one\ntwo"));
  EXPECT_THAT(read.lines, ElementsAre("one", "two"));
  EXPECT_FALSE(read.last_complete);
}

TEST(LineReader, FindsNoLineInAnEmptyFile) {
  const test::RecordingFolder folder;
  EXPECT_TRUE(read_all(folder.write("log", "")).lines.empty());
}

TEST(LineReader, ReadsLinesAcrossItsOwnBlocks) {
  const test::RecordingFolder folder;
  std::string text;
  for (int i = 0; i < 50; ++i) text += std::string(static_cast<std::size_t>(997 * i), 'x') + "\n";
  const Read read = read_all(folder.write_gz("log", text));
  ASSERT_EQ(read.lines.size(), 50U);
  for (std::size_t i = 0; i < 50; ++i) EXPECT_EQ(read.lines[i].size(), 997 * i);
}

TEST(LineReader, RefusesALineWithoutEndEvenIfItUnpacksFromLittle) {
  const test::RecordingFolder folder;
  const std::string path = folder.write_gz("bomb", "fine\n" + std::string(20'000'000, 'x'));
  const Read read = read_all(path);
  EXPECT_THAT(read.lines, ElementsAre("fine"));
  EXPECT_EQ(read.error, path + ":2: a line of more than 262144 bytes: this is no text log");
}

TEST(LineReader, NamesAMissingFileAndAFolder) {
  const test::RecordingFolder folder;
  EXPECT_EQ(read_all(folder.path("none")).error, folder.path("none") + ": no such file");
  EXPECT_EQ(read_all(folder.path("")).error, folder.path("") + ": is a folder, not a log");
}

TEST(LineReader, SaysThatACompressedFileIsCutOff) {
  const test::RecordingFolder folder;
  const std::string whole = content_of(folder.write_gz("log.gz", test::carmen_log(180, 5)));
  const std::string path = folder.write("cut.gz", whole.substr(0, whole.size() - 20));
  EXPECT_THAT(read_all(path).error,
              HasSubstr("the compressed file ends early: it is truncated, fetch it again"));
}

TEST(LineReader, SaysThatACompressedFileIsDamaged) {
  const test::RecordingFolder folder;
  std::string whole = content_of(folder.write_gz("log.gz", test::carmen_log(180, 5)));
  whole[whole.size() - 6] = static_cast<char>(whole[whole.size() - 6] ^ 0x55);  // its checksum
  const std::string path = folder.write("bad.gz", whole);
  EXPECT_THAT(read_all(path).error, HasSubstr(path + ":"));
  EXPECT_THAT(read_all(path).error, HasSubstr("cannot be read: "));
}

}  // namespace
}  // namespace lifeline::sources
