#include "common/dds/qos_profiles.hpp"

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include "common/dds/participant.hpp"

namespace lifeline::dds {
namespace {

const std::filesystem::path kShippedProfiles = LIFELINE_SOURCE_DIR "/config/qos";

std::string read(const std::filesystem::path& file) {
  std::ifstream in(file);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// A folder of the test's own, with a changed copy of loopback.xml.
class QosProfiles : public ::testing::Test {
 protected:
  QosProfiles()
      : folder_(std::filesystem::temp_directory_path() /
                ("lifeline-qos-" + std::to_string(getpid()))),
        file_(folder_ / "qos.xml") {
    std::filesystem::create_directories(folder_);
  }
  ~QosProfiles() override { std::filesystem::remove_all(folder_); }

  void write(const std::string& text) const { std::ofstream(file_) << text; }

  /// loopback.xml with the first `from` after `after` replaced by `to`.
  void write_changed(const std::string& after, const std::string& from,
                     const std::string& to) const {
    auto text = read(kShippedProfiles / "loopback.xml");
    const auto start = text.find(after);
    ASSERT_NE(start, std::string::npos);
    const auto at = text.find(from, start);
    ASSERT_NE(at, std::string::npos);
    write(text.replace(at, from.size(), to));
  }

  /// What a participant says that is asked to use the file; "" when it starts.
  [[nodiscard]] std::string refusal() const { return refusal_of(file_); }
  [[nodiscard]] static std::string refusal_of(const std::filesystem::path& file) {
    const auto participant =
        Participant::create({.domain_id = 41, .qos_profiles = file, .name = "test"});
    return participant ? "" : participant.error().text;
  }

  /// As refusal(), the file's path cut off the front.
  [[nodiscard]] std::string reason() const {
    const auto text = refusal();
    const auto path = file_.string();
    return text.starts_with(path) ? text.substr(path.size()) : "not about the file: " + text;
  }

  const std::filesystem::path folder_, file_;
};

/// What a file of that name is for.
ProfileNames names_of(const std::filesystem::path& file) {
  if (!file.filename().string().starts_with("ros2")) return mission_profiles();
  return {"ros2_participant",
          {"ros2_map_writer", "ros2_stream_writer"},
          {"ros2_scan_reader", "ros2_imu_reader"}};
}

Result<void> load(const std::filesystem::path& file) {
  route_middleware_log();
  const std::lock_guard lock(profiles_mutex());
  const LogCapture capture;
  return load_qos_profiles(file, names_of(file), capture);
}

TEST_F(QosProfiles, the_shipped_files_load) {
  for (const auto& entry : std::filesystem::directory_iterator(kShippedProfiles)) {
    const auto loaded = load(entry.path());
    EXPECT_TRUE(loaded) << loaded.error().text;
  }
}

TEST_F(QosProfiles, a_file_for_ros2_is_none_for_a_mission) {
  EXPECT_EQ(refusal_of(kShippedProfiles / "ros2.xml"),
            (kShippedProfiles / "ros2.xml").string() +
                ": participant profile 'lifeline_participant' is missing");
}

TEST_F(QosProfiles, a_participant_starts_on_loopback_xml) {
  EXPECT_EQ(refusal_of(kShippedProfiles / "loopback.xml"), "");
}

TEST_F(QosProfiles, files_follow_each_other_in_one_process) {
  EXPECT_TRUE(load(kShippedProfiles / "loopback.xml"));
  EXPECT_TRUE(load(kShippedProfiles / "wifi.xml"));
  write("<dds>");
  EXPECT_FALSE(load(file_));
  EXPECT_TRUE(load(kShippedProfiles / "loopback.xml"));
  EXPECT_TRUE(load(kShippedProfiles / "loopback.xml"));
}

TEST_F(QosProfiles, a_missing_file_is_named) {
  EXPECT_EQ(reason(), ": no such QoS profile file; config/qos/ holds the shipped ones");
}

TEST_F(QosProfiles, a_folder_is_no_file) {
  EXPECT_EQ(refusal_of(folder_), folder_.string() + ": not a file; a QoS profile file is needed");
}

TEST_F(QosProfiles, malformed_xml_is_named_with_its_line) {
  write_changed("profile_name=\"scan_writer\"", "</publisher>", "</publishr>");
  EXPECT_THAT(reason(), ::testing::MatchesRegex(":[0-9]+: malformed XML \\(XML_ERROR_"
                                                "MISMATCHED_ELEMENT\\)"));
}

TEST_F(QosProfiles, an_empty_file_is_refused) {
  write("");
  EXPECT_EQ(reason(), ":0: malformed XML (XML_ERROR_EMPTY_DOCUMENT)");
}

TEST_F(QosProfiles, a_truncated_file_is_refused) {
  const auto whole = read(kShippedProfiles / "loopback.xml");
  for (const double share : {0.1, 0.5, 0.9, 0.999}) {
    write(whole.substr(0, static_cast<std::size_t>(static_cast<double>(whole.size()) * share)));
    EXPECT_THAT(reason(), ::testing::MatchesRegex(":[0-9]+: malformed XML .*")) << share;
  }
}

TEST_F(QosProfiles, xml_without_profiles_is_refused) {
  write("<?xml version=\"1.0\"?>\n<html><body/></html>\n");
  EXPECT_EQ(reason(), ": Not found root tag");
}

TEST_F(QosProfiles, an_unknown_element_is_named_with_its_line) {
  write_changed("profile_name=\"tsd_tile_writer\"", "<qos>", "<qos><durabilty/>");
  EXPECT_THAT(reason(),
              ::testing::MatchesRegex(
                  ":[0-9]+: Invalid element found into 'writerQosPoliciesType'. Name: durabilty"));
}

TEST_F(QosProfiles, a_bad_value_is_refused) {
  write_changed("profile_name=\"tsd_tile_writer\"", "TRANSIENT_LOCAL", "TRANSIENT_LOCALLY");
  EXPECT_THAT(reason(), ::testing::MatchesRegex(":[0-9]+: Node 'kind' with bad content"));
}

TEST_F(QosProfiles, a_number_that_is_none_is_refused) {
  write_changed("transport_descriptor", "<maxMessageSize>16000", "<maxMessageSize>many");
  EXPECT_THAT(reason(), ::testing::MatchesRegex(":[0-9]+: <maxMessageSize> getXMLUint XML_ERROR!"));
}

TEST_F(QosProfiles, a_transport_that_is_not_described_is_refused) {
  write_changed("<userTransports>", "lifeline_udp", "lifeline_tcp");
  EXPECT_EQ(reason(), ": Transport Node not found. Given ID: lifeline_tcp");
}

TEST_F(QosProfiles, a_missing_profile_is_named) {
  write_changed("<participant ", "lifeline_participant", "another");
  EXPECT_EQ(reason(), ": participant profile 'lifeline_participant' is missing");
  write_changed("<dds", "\"alert_writer\"", "\"another\"");
  EXPECT_EQ(reason(), ": publisher profile 'alert_writer' is missing");
  write_changed("<dds", "\"merge_directive_standby_writer\"", "\"another\"");
  EXPECT_EQ(reason(), ": publisher profile 'merge_directive_standby_writer' is missing");
  write_changed("<dds", "\"pose_reader\"", "\"another\"");
  EXPECT_EQ(reason(), ": subscriber profile 'pose_reader' is missing");
}

TEST_F(QosProfiles, a_profile_name_used_twice_is_refused) {
  write_changed("<dds", "\"alert_writer\"", "\"detection_writer\"");
  EXPECT_EQ(reason(),
            ": Error adding profile 'detection_writer' from file '" + file_.string() + "'");
}

TEST_F(QosProfiles, a_domain_that_does_not_exist_is_wrong_use) {
  const auto participant = Participant::create(
      {.domain_id = 233, .qos_profiles = kShippedProfiles / "loopback.xml", .name = ""});
  ASSERT_FALSE(participant);
  EXPECT_EQ(participant.error().code, ErrorCode::wrong_use);
  EXPECT_EQ(participant.error().text, "domain 233 does not exist; DDS has domains 0 to 232");
}

}  // namespace
}  // namespace lifeline::dds
