#include "common/dds/qos_profiles.hpp"

#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <tinyxml2.h>

#include "common/dds/fastdds_version.hpp"
#include "common/dds/topics.hpp"

namespace lifeline::dds {
namespace {

/// What stands in a `kind` element of some policy.
constexpr std::array<std::string_view, 18> kKinds{"KEEP_LAST",
                                                  "KEEP_ALL",
                                                  "VOLATILE",
                                                  "TRANSIENT_LOCAL",
                                                  "TRANSIENT",
                                                  "PERSISTENT",
                                                  "BEST_EFFORT",
                                                  "RELIABLE",
                                                  "AUTOMATIC",
                                                  "MANUAL_BY_TOPIC",
                                                  "MANUAL_BY_PARTICIPANT",
                                                  "SHARED",
                                                  "EXCLUSIVE",
                                                  "SYNCHRONOUS",
                                                  "ASYNCHRONOUS",
                                                  "ON",
                                                  "OFF",
                                                  "AUTO"};

/// Calls `visit` on `element`, its siblings and all below them.
template <typename Visit>
void for_each_element(const tinyxml2::XMLElement* element, Visit& visit) {
  for (; element != nullptr; element = element->NextSiblingElement()) {
    visit(*element);
    for_each_element(element->FirstChildElement(), visit);
  }
}

/// The element that Fast DDS complains about: "... Name: foo", "<foo> ...", or "Node 'kind' ...".
bool is_meant(const tinyxml2::XMLElement& element, std::string_view complaint) {
  const std::string_view name = element.Name();
  if (complaint.starts_with("Node 'kind'")) {
    const auto* text = element.GetText();
    return name == "kind" &&
           (text == nullptr || std::find(kKinds.begin(), kKinds.end(), text) == kKinds.end());
  }
  return complaint.ends_with(fmt::format("Name: {}", name)) ||
         complaint.starts_with(fmt::format("<{}>", name));
}

/// Fast DDS gives no line: it is known where only one element can be meant.
std::optional<int> line_of_complaint(const tinyxml2::XMLDocument& document,
                                     std::string_view complaint) {
  std::vector<int> lines;
  auto visit = [&](const tinyxml2::XMLElement& element) {
    if (is_meant(element, complaint)) lines.push_back(element.GetLineNum());
  };
  for_each_element(document.RootElement(), visit);
  return lines.size() == 1 ? std::optional(lines.front()) : std::nullopt;
}

Result<void> parse(const std::filesystem::path& file, tinyxml2::XMLDocument& document) {
  std::error_code error;
  if (!std::filesystem::exists(file, error)) {
    return fail(ErrorCode::not_found,
                "{}: no such QoS profile file; config/qos/ holds the shipped ones", file.string());
  }
  if (!std::filesystem::is_regular_file(file, error)) {
    return fail(ErrorCode::bad_data, "{}: not a file; a QoS profile file is needed", file.string());
  }
  if (document.LoadFile(file.c_str()) != tinyxml2::XML_SUCCESS) {
    return fail(ErrorCode::bad_data, "{}:{}: malformed XML ({})", file.string(),
                document.ErrorLineNum(), document.ErrorName());
  }
  return {};
}

Result<void> require(bool present, const std::filesystem::path& file, std::string_view kind,
                     std::string_view profile) {
  if (present) return {};
  return fail(ErrorCode::bad_data, "{}: {} profile '{}' is missing", file.string(), kind, profile);
}

Result<void> require_all(const ProfileNames& names, const std::filesystem::path& file) {
  auto result =
      require(xml::has_participant(names.participant), file, "participant", names.participant);
  for (const std::string& name : names.writers) {
    if (result) result = require(xml::has_writer(name), file, "publisher", name);
  }
  for (const std::string& name : names.readers) {
    if (result) result = require(xml::has_reader(name), file, "subscriber", name);
  }
  return result;
}

ProfileNames names_of_topics() {
  ProfileNames names;
  names.participant = kParticipantProfile;
  const auto add = [&](const auto& topic) {
    for (const auto name : {topic.writer_profile, topic.standby_profile}) {
      if (!name.empty()) names.writers.emplace_back(name);
    }
    names.readers.emplace_back(topic.reader_profile);
  };
  std::apply([&](const auto&... topics) { (add(topics), ...); }, kTopics);
  return names;
}

}  // namespace

std::mutex& profiles_mutex() {
  static std::mutex mutex;
  return mutex;
}

const ProfileNames& mission_profiles() {
  static const ProfileNames names = names_of_topics();
  return names;
}

Result<void> load_qos_profiles(const std::filesystem::path& file, const ProfileNames& names,
                               const LogCapture& capture) {
  tinyxml2::XMLDocument document;
  if (const auto parsed = parse(file, document); !parsed) return parsed;
  xml::forget_profiles();
  const auto code =
      fast::DomainParticipantFactory::get_instance()->load_XML_profiles_file(file.string());
  const auto errors = capture.errors();
  // A profile name used twice is logged, but the call still says OK.
  if (!is_ok(code) || !errors.empty()) {
    const std::string reason = errors.empty() ? "no profiles in it" : errors.front();
    const auto line = line_of_complaint(document, reason);
    return fail(ErrorCode::bad_data, "{}{}: {}", file.string(),
                line ? fmt::format(":{}", *line) : "", reason);
  }
  return require_all(names, file);
}

}  // namespace lifeline::dds
