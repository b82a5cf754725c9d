#include "coordinator/export/csv_files.hpp"

#include <cmath>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "common/files/atomic_file.hpp"
#include "common/files/finds_json.hpp"

namespace lifeline {
namespace {

std::string cell(const std::string& text) {
  std::string plain = text;
  if (!plain.empty() && std::string_view("=+-@\t\r").find(plain.front()) != std::string_view::npos)
    plain.insert(0, "'");
  if (plain.find_first_of(",\"\r\n") == std::string::npos) return plain;
  std::string quoted = "\"";
  for (const char c : plain) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + "\"";
}

/// When, twice: since the beginning, and by the clock.
std::string when(const MissionStory& story, Timestamp at) {
  return fmt::format("{:.3f},{}", to_seconds(at - story.first), utc_text(at));
}

std::string paths_csv(const MissionStory& story) {
  std::string csv =
      "time_s,time_utc,helmet,map_id,floor,x_map_m,y_map_m,yaw_map_rad,x_common_m,y_common_m,"
      "yaw_common_rad,trust_percent\r\n";
  for (const HelmetTrack& track : story.tracks) {
    for (std::size_t i = 0; i < track.poses.size(); ++i) {
      const auto& [stamp, pose] = track.poses[i];
      std::string common = ",,";
      if (track.T_common_map) {
        const Pose2 placed = *track.T_common_map * pose;
        common = fmt::format("{:.3f},{:.3f},{:.4f}", placed.x_m, placed.y_m, placed.yaw_rad);
      }
      csv += fmt::format("{},{},{},{},{:.3f},{:.3f},{:.4f},{},{}\r\n", when(story, stamp),
                         cell(track.layer.agent_id.text()), track.layer.map_id.value,
                         track.layer.floor.value, pose.x_m, pose.y_m, pose.yaw_rad, common,
                         track.trust_percent.empty() ? "" : std::to_string(track.trust_percent[i]));
    }
  }
  return csv;
}

std::string detections_csv(const MissionStory& story) {
  std::string csv =
      "kind,state,frame,floor,x_m,y_m,confidence,first_seen_by,first_seen_s,last_seen_by,"
      "last_seen_s,seen_by\r\n";
  for (const auto& find : files::to_json(story.finds)) {
    std::string seen_by;
    for (const auto& id : find.at("seen_by"))
      seen_by += (seen_by.empty() ? "" : " ") + id.get<std::string>();
    const auto &first = find.at("first_seen"), &last = find.at("last_seen");
    csv += fmt::format("{},{},{},{},{:.3f},{:.3f},{:.3f},{},{:.3f},{},{:.3f},{}\r\n",
                       find.at("kind").get<std::string>(), find.at("state").get<std::string>(),
                       cell(find.at("frame").get<std::string>()), find.at("floor").get<int>(),
                       find.at("x_m").get<double>(), find.at("y_m").get<double>(),
                       find.at("confidence").get<double>(), cell(first.at("by").get<std::string>()),
                       first.at("at_s").get<double>(), cell(last.at("by").get<std::string>()),
                       last.at("at_s").get<double>(), cell(seen_by));
  }
  return csv;
}

std::string alerts_csv(const MissionStory& story) {
  std::string csv = "time_s,time_utc,issuer,alert_id,kind,state,subject,text,acknowledged_by\r\n";
  for (const auto& [at, alert] : story.alerts) {
    csv += fmt::format("{},{},{},{},{},{},{},{}\r\n", when(story, at), cell(alert.issuer_id),
                       alert.alert_id, to_string(alert.kind), to_string(alert.state),
                       cell(alert.subject_id), cell(alert.text),
                       cell(fmt::format("{}", fmt::join(alert.acknowledged_by, " "))));
  }
  return csv;
}

std::string merges_csv(const MissionStory& story) {
  std::string csv =
      "time_s,time_utc,a,b,verdict,x_m,y_m,yaw_rad,s_overlapping,acceptance_index,reason\r\n";
  for (const auto& [at, evidence] : story.merges) {
    std::string figures = ",,,,";
    if (!evidence.candidates.empty()) {
      const auto& best = evidence.candidates.front();
      figures = fmt::format("{:.3f},{:.3f},{:.4f},{:.4f},{:.4f}", best.T_a_b.x_m, best.T_a_b.y_m,
                            best.T_a_b.yaw_rad, best.s_overlapping, best.acceptance_index);
    }
    csv += fmt::format("{},{},{},{},{},{}\r\n", when(story, at), cell(to_text(evidence.a)),
                       cell(to_text(evidence.b)), to_string(evidence.verdict), figures,
                       cell(evidence.reason));
  }
  return csv;
}

}  // namespace

Result<void> write_csv_files(const std::filesystem::path& folder, const MissionStory& story) {
  for (const auto& [name, csv] :
       {std::pair("paths.csv", paths_csv(story)),
        std::pair("detections.csv", detections_csv(story)),
        std::pair("alerts.csv", alerts_csv(story)), std::pair("merges.csv", merges_csv(story))}) {
    if (auto written = files::write_file_atomically(folder / name, csv); !written) return written;
  }
  return {};
}

}  // namespace lifeline
