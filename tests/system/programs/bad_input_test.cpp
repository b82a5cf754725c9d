// Bad input, as a user would give it to the real programs: one clear line, exit status 1 or 2, and
// nothing lost.

#include <filesystem>

#include <gtest/gtest.h>

#include "common/grid/occupancy_grid.hpp"
#include "tests/support/run_program.hpp"
#include "tests/support/temporary_folder.hpp"

namespace lifeline::test {
namespace {

using std::filesystem::path;

std::string flaser(int beams, const std::string& range) {
  std::string line = "FLASER " + std::to_string(beams);
  for (int i = 0; i < beams; ++i) line += " " + range;
  return line + " 0 0 0 0 0 0 1.5 host 1.5\n";
}

class BadInputTest : public testing::Test {
 protected:
  path write(const std::string& name, const std::string& content) {
    return folder_.write(name, content);
  }

  // The program must end by itself with `status` and say all of `words` in one line.
  void expect_refused(const std::vector<std::string>& arguments, int status,
                      const std::vector<std::string>& words) {
    const Ended ended = run_program(arguments, folder_.path() / "log");
    EXPECT_EQ(ended.status, status) << ended.output;
    // The demo is run as `lifeline demo`, and speaks under that name.
    const std::string speaker = arguments[0] == "lifeline-demo" ? "lifeline demo" : arguments[0];
    EXPECT_EQ(lines_with(ended.output, speaker + ": "), 1U) << ended.output;
    for (const auto& word : words)
      EXPECT_NE(ended.output.find(word), std::string::npos) << word << " in: " << ended.output;
  }

  void expect_slam_refuses(const std::string& source, int status,
                           const std::vector<std::string>& words) {
    const path trajectory = folder_.path() / "t.tum";
    expect_refused(
        {"lifeline-agent", "slam", "--source", source, "--trajectory", trajectory.string()}, status,
        words);
    EXPECT_FALSE(std::filesystem::exists(trajectory));
  }

  void expect_config_refused(const std::string& yaml, const std::vector<std::string>& words) {
    const path config = write("agent.yaml", yaml);
    expect_refused({"lifeline-agent", "run", "--id", "alpha", "--source", "sim:office", "--config",
                    config.string()},
                   2, words);
  }

  void expect_qos_refused(const path& qos, const std::vector<std::string>& words) {
    for (const auto* program : {"lifeline-agent", "lifeline-coordinator"}) {
      std::vector<std::string> arguments{program, "run", "--qos", qos.string(), "--domain", "77"};
      if (program == std::string("lifeline-agent"))
        arguments.insert(arguments.end(), {"--id", "alpha", "--source", "sim:office"});
      expect_refused(arguments, 1, words);
    }
  }

  path write_map(const std::string& name, const std::string& resolution) {
    std::string pgm = "P5\n40 40\n255\n";
    for (int i = 0; i < 1600; ++i) pgm += static_cast<char>(i % 40 == 5 ? 0 : 254);
    write(name + ".pgm", pgm);
    return write(
        name + ".yaml",
        "image: " + name + ".pgm\nmode: trinary\nresolution: " + resolution +
            "\norigin: [0.0, 0.0, 0.0]\nnegate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.196\n");
  }

  support::TemporaryFolder folder_;
};

TEST_F(BadInputTest, MissingLog) {
  expect_slam_refuses("carmen:" + (folder_.path() / "nowhere.log").string(), 1, {"nowhere.log"});
}

TEST_F(BadInputTest, TruncatedLog) {
  const std::string whole = flaser(180, "2.5") + flaser(180, "2.5");
  const path log = write("cut.log", whole.substr(0, whole.size() - 700));
  expect_slam_refuses("carmen:" + log.string(), 1, {"cut.log:2"});
}

TEST_F(BadInputTest, TruncatedCompressedLog) {
  const path log =
      write("cut.log.gz", std::string("\x1f\x8b\x08\x00\x00\x00\x00\x00\x00\x03\x4b", 11));
  expect_slam_refuses("carmen:" + log.string(), 1, {"cut.log.gz"});
}

TEST_F(BadInputTest, LogWithoutScans) {
  const path log = write("empty.log", "# nothing here\nODOM 0 0 0 0 0 0 1.0 host 1.0\n");
  expect_slam_refuses("carmen:" + log.string(), 1, {"empty.log", "scan"});
}

TEST_F(BadInputTest, WrongBeamCount) {
  const path log = write("beams.log", flaser(180, "2.5") + flaser(77, "2.5"));
  expect_slam_refuses("carmen:" + log.string(), 1, {"beams.log", "77"});
}

TEST_F(BadInputTest, NotANumberAsRange) {
  const path log = write("nan.log", flaser(180, "nan"));
  expect_slam_refuses("carmen:" + log.string(), 1, {"nan.log:1"});
}

TEST_F(BadInputTest, EmptyBag) {
  std::filesystem::create_directory(folder_.path() / "bag");
  expect_slam_refuses("rosbag2:" + (folder_.path() / "bag").string(), 1, {"bag"});
}

TEST_F(BadInputTest, UnknownKindOfSource) {
  expect_slam_refuses("sonar:x", 2, {"sonar", "carmen"});
}

TEST_F(BadInputTest, UnknownOptionOfSource) {
  const path log = write("good.log", flaser(180, "2.5"));
  expect_slam_refuses("carmen:" + log.string() + "?form=3", 2, {"form", "from"});
}

TEST_F(BadInputTest, UnknownKeyInTheConfiguration) {
  expect_config_refused("slam:\n  macher: direct\n", {"agent.yaml:2:3", "macher", "matcher"});
}

TEST_F(BadInputTest, WrongTypeInTheConfiguration) {
  expect_config_refused("slam:\n  max_range_m: far\n", {"agent.yaml:2:", "max_range_m"});
}

TEST_F(BadInputTest, ValueOutOfRangeInTheConfiguration) {
  expect_config_refused("grid:\n  cell_size_m: 3\n", {"agent.yaml:2:", "cell_size_m", "0.1"});
}

TEST_F(BadInputTest, YamlThatIsNone) {
  expect_config_refused("slam: [1, 2\n", {"agent.yaml:"});
}

TEST_F(BadInputTest, MissingQosProfiles) {
  expect_qos_refused(folder_.path() / "none.xml", {"none.xml"});
}

TEST_F(BadInputTest, MalformedQosProfiles) {
  expect_qos_refused(write("bad.xml", "<?xml version=\"1.0\"?><dds><profiles><participant"),
                     {"bad.xml"});
}

TEST_F(BadInputTest, ReportFolderThatCannotBeWritten) {
  const path file = write("file", "not a folder");
  const std::string report = (file / "report").string();
  expect_refused(
      {"lifeline-agent", "run", "--id", "alpha", "--source", "sim:office", "--report", report}, 1,
      {report});
  expect_refused({"lifeline-coordinator", "run", "--report", report}, 1, {report});
  expect_refused({"lifeline-demo", "--report", report}, 1, {report});
}

TEST_F(BadInputTest, DashboardAddressThatIsNone) {
  expect_refused({"lifeline-coordinator", "run", "--dashboard", "8642"}, 2,
                 {"'8642'", "127.0.0.1:8642", "off"});
}

TEST_F(BadInputTest, DashboardPortThatIsNotOurs) {
  // An address of documentation's own (RFC 5737): no machine has it.
  expect_refused({"lifeline-coordinator", "run", "--domain", "77", "--dashboard", "192.0.2.1:8642"},
                 1, {"192.0.2.1:8642", "--dashboard"});
}

TEST_F(BadInputTest, AgentIdThatIsNone) {
  expect_refused({"lifeline-agent", "run", "--id", "al pha", "--source", "sim:office"}, 2,
                 {"agent id"});
}

TEST_F(BadInputTest, MapsOfDifferentCellSize) {
  const path a = write_map("a", "0.05"), b = write_map("b", "0.10");
  expect_refused({"lifeline-coordinator", "match", a.string(), b.string()}, 1, {"cell"});
}

TEST_F(BadInputTest, MissingMap) {
  const path a = write_map("a", "0.05");
  expect_refused(
      {"lifeline-coordinator", "match", a.string(), (folder_.path() / "no.yaml").string()}, 1,
      {"no.yaml"});
}

}  // namespace
}  // namespace lifeline::test
