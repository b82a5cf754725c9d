// Maps that cannot be matched, as a user would give them to `lifeline-coordinator match`: one clear
// line and exit status 1.

#include <filesystem>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/support/run_program.hpp"
#include "tests/support/temporary_folder.hpp"

namespace lifeline::test {
namespace {

using std::filesystem::path;

// 16 x 16 and 20,000 x 20,000 pixels of grey: the header, and that pixels follow.
const std::string kPngStart = "\x89PNG\r\n\x1a\n";
const std::string kSmallHeader(
    "\x00\x00\x00\x0dIHDR\x00\x00\x00\x10\x00\x00\x00\x10\x08\x00\x00\x00\x00\x3a\x98\xa0\xbd", 25);
const std::string kHugeHeader(
    "\x00\x00\x00\x0dIHDR\x00\x00\x4e\x20\x00\x00\x4e\x20\x08\x00\x00\x00\x00\xc6\x1b\x19\xe5", 25);
const std::string kPixelsBegin("\x00\x00\x01\x00IDAT", 8);

class BadMapsTest : public testing::Test {
 protected:
  path write_yaml(const std::string& image, const std::string& resolution = "0.05",
                  const std::string& origin = "[0.0, 0.0, 0.0]") {
    return folder_.write("map.yaml",
                         "image: " + image + "\nresolution: " + resolution + "\norigin: " + origin +
                             "\nnegate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.196\n");
  }

  void put(const std::string& name, const std::string& content) {
    ASSERT_TRUE(exists(folder_.write(name, content)));
  }

  // A square of `side` pixels.
  void write_pgm(int side, const std::string& pixels) {
    put("map.pgm", "P5\n" + std::to_string(side) + " " + std::to_string(side) + "\n255\n" + pixels);
  }

  // Refused in either place; all of `words` stand in the one line that is printed.
  void expect_refused(const path& bad, const std::vector<std::string>& words) {
    std::string room = "P5\n60 60\n255\n";
    for (int i = 0; i < 3600; ++i) {
      const int column = i % 60, row = i / 60;
      const bool wall = column == 20 || column == 40 || row == 20 || row == 40;
      room += static_cast<char>(wall ? 0 : 254);
    }
    put("good.pgm", room);
    const path good =
        folder_.write("good.yaml",
                      "image: good.pgm\nresolution: 0.05\norigin: [0.0, 0.0, 0.0]\nnegate: 0\n"
                      "occupied_thresh: 0.65\nfree_thresh: 0.196\n");
    for (const auto& [a, b] : {std::pair(bad, good), std::pair(good, bad)}) {
      const Ended ended = run_program({"lifeline-coordinator", "match", a.string(), b.string()},
                                      folder_.path() / "log");
      EXPECT_EQ(ended.status, 1) << ended.output;
      EXPECT_EQ(lines_with(ended.output, ""), 1U) << ended.output;
      for (const std::string& word : words)
        EXPECT_NE(ended.output.find(word), std::string::npos) << word << " in: " << ended.output;
    }
  }

  support::TemporaryFolder folder_;
};

TEST_F(BadMapsTest, WithoutPixels) {
  write_pgm(0, "");
  expect_refused(write_yaml("map.pgm"), {"map.pgm", "without pixels"});
}

TEST_F(BadMapsTest, OfUnknownCellsOnly) {
  write_pgm(50, std::string(2500, '\xcd'));
  expect_refused(write_yaml("map.pgm"), {"map.yaml", "no wall", "50 x 50", "0.0 m2"});
}

TEST_F(BadMapsTest, OfOneCell) {
  write_pgm(1, std::string(1, '\0'));
  expect_refused(write_yaml("map.pgm"), {"map.yaml", "no wall", "1 x 1"});
}

TEST_F(BadMapsTest, BeyondTheLimit) {
  put("map.pgm", "P5\n20000 20000\n255\n");
  expect_refused(write_yaml("map.pgm"), {"map.pgm", "20000 x 20000", "at most", "100000000"});
  put("map.png", kPngStart + kHugeHeader + kPixelsBegin);
  expect_refused(write_yaml("map.png"), {"map.png", "20000 x 20000", "at most", "100000000"});
}

TEST_F(BadMapsTest, OfAnotherResolution) {
  write_pgm(50, std::string(1250, '\xfe') + std::string(50, '\0') + std::string(1200, '\xfe'));
  expect_refused(write_yaml("map.pgm", "0.1"), {"map.yaml", "0.1 m", "0.05 m"});
}

TEST_F(BadMapsTest, WithAnOriginThatIsNoNumber) {
  write_pgm(50, std::string(2500, '\xfe'));
  expect_refused(write_yaml("map.pgm", "0.05", "[.nan, 0.0, 0.0]"), {"map.yaml:3", "origin"});
}

TEST_F(BadMapsTest, WithAPngThatEndsTooEarly) {
  put("map.png", kPngStart + kSmallHeader + kPixelsBegin + "\x78\x01");
  expect_refused(write_yaml("map.png"), {"map.png", "PNG"});
}

}  // namespace
}  // namespace lifeline::test
