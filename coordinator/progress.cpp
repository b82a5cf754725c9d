#include "coordinator/progress.hpp"

#include <fmt/format.h>

namespace lifeline {
namespace {

std::string position(const wire::AgentStatus& status, const Coordinator& coordinator) {
  const auto agent_id = AgentId::parse(status.agent_id);
  if (!agent_id) return "";
  const auto path =
      coordinator.paths().find({*agent_id, MapId{status.map_id}, Floor{status.floor}});
  if (path == coordinator.paths().end() || path->second.empty()) return "";
  return fmt::format(" at ({:.1f}, {:.1f})", path->second.back().x(), path->second.back().y());
}

}  // namespace

const char* describe(wire::AgentState state) {
  switch (state) {
    case wire::AgentState::starting:
      return "starting";
    case wire::AgentState::tracking:
      return "tracking";
    case wire::AgentState::weak:
      return "weak";
    case wire::AgentState::lost:
      return "lost its place";
    case wire::AgentState::finished:
      return "finished";
  }
  return "in an unknown state";
}

std::string describe(const sharing::Roster::Entry& helmet, const Coordinator& coordinator,
                     SteadyTime now) {
  const auto& status = helmet.status;
  std::string text =
      fmt::format("{} {} scans {:.0f} m2{} {}", status.agent_id, status.scans, status.explored_m2,
                  position(status, coordinator), describe(status.state));
  if (sharing::Roster::presence(helmet, now) != sharing::Presence::fresh) {
    text += fmt::format(", silent for {:.0f} s", to_seconds(now - helmet.heard_at));
  }
  if (helmet.contested) text += ", id used twice";
  return text;
}

void ProgressPrinter::step(const Coordinator& coordinator, SteadyTime now) {
  print_matches(coordinator);
  if (now < helmets_due_) return;
  helmets_due_ = now + std::chrono::seconds(1);
  print_helmets(coordinator, now);
}

void ProgressPrinter::print_matches(const Coordinator& coordinator) {
  for (const auto& [pair, record] : coordinator.newest_matches()) {
    const auto printed = printed_.find(pair);
    if (printed != printed_.end() && printed->second == record.at) continue;
    printed_[pair] = record.at;
    fmt::print(out_, "{:6.1f} s  {} + {}: {}: {}\n", to_seconds(record.at), to_string(pair.a),
               to_string(pair.b), matching::to_string(record.result.verdict), record.result.reason);
  }
  std::fflush(out_);
}

void ProgressPrinter::print_helmets(const Coordinator& coordinator, SteadyTime now) {
  std::string line;
  for (const auto& [id, entry] : coordinator.roster().entries()) {
    if (entry.status.role != wire::Role::helmet) continue;
    line += (line.empty() ? "" : " | ") + describe(entry, coordinator, now);
  }
  if (line.empty()) line = "nobody heard yet";
  if (const auto finds = coordinator.detections(); !finds.empty()) {
    line += fmt::format(" | {} find{}", finds.size(), finds.size() == 1 ? "" : "s");
  }
  fmt::print(out_, "{:6.1f} s  {}\n", to_seconds(now - started_), line);
  std::fflush(out_);
}

}  // namespace lifeline
