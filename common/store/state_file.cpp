#include "common/store/state_file.hpp"

#include <utility>

#include <fmt/format.h>

#include "common/base/log.hpp"
#include "common/store/put_aside.hpp"
#include "common/wire/tile_codec.hpp"
#include "idl/state.pb.h"

namespace lifeline::store {
namespace {

constexpr std::uint32_t kFormatVersion = 1;
constexpr const char* kHeader = "header";
constexpr const char* kStarts = "starts";
constexpr int kKeptIncarnations = 16;
constexpr Duration kBeatInterval = std::chrono::seconds(1);

/// Why a state is not gone on from; `name` becomes part of the file's new name.
struct Refusal {
  std::string name;
  std::string reason;
};

template <typename Message>
std::optional<Message> parse(const Records& records, const char* key) {
  const auto found = records.find(key);
  Message message;
  if (found == records.end() || !message.ParseFromString(found->second)) return std::nullopt;
  return message;
}

proto::StateHeader header_of(const StateIdentity& identity) {
  proto::StateHeader header;
  header.set_format_version(kFormatVersion);
  header.set_role(identity.role);
  header.set_id(identity.id);
  header.set_mission_id(identity.mission_id);
  header.set_cell_size_um(wire::to_micrometres(identity.geometry.cell_size_m));
  header.set_truncation_um(wire::to_micrometres(identity.geometry.truncation_m));
  return header;
}

Duration away(const proto::StateStarts& starts, Timestamp now) {
  // A clock that went back says nothing.
  return std::max(Duration{}, now - Timestamp(Duration(starts.written_at_ns())));
}

std::optional<Refusal> compare(const proto::StateHeader& held, const proto::StateHeader& own) {
  if (held.format_version() != own.format_version()) {
    return Refusal{"other-release", fmt::format("is of format {}, this release writes {}",
                                                held.format_version(), own.format_version())};
  }
  if (held.role() != own.role() || held.id() != own.id()) {
    return Refusal{"other-owner", fmt::format("belongs to {} '{}'", held.role(), held.id())};
  }
  if (held.mission_id() != own.mission_id()) {
    return Refusal{"other-mission", fmt::format("belongs to mission '{}', this one is '{}'",
                                                held.mission_id(), own.mission_id())};
  }
  if (held.cell_size_um() != own.cell_size_um() || held.truncation_um() != own.truncation_um()) {
    return Refusal{"other-grid",
                   fmt::format("holds cells of {} um with a truncation of {} um; grid.cell_size_m "
                               "or grid.truncation_m has changed",
                               held.cell_size_um(), held.truncation_um())};
  }
  return std::nullopt;
}

std::optional<Refusal> judge(const Records& records, const StateIdentity& identity,
                             const ResumeLimits& limits, Timestamp now) {
  if (records.empty()) return std::nullopt;
  const auto header = parse<proto::StateHeader>(records, kHeader);
  const auto starts = parse<proto::StateStarts>(records, kStarts);
  if (!header || !starts) return Refusal{"damaged", "lacks its first records"};
  if (auto other = compare(*header, header_of(identity))) return other;
  if (starts->unproven() >= limits.unproven) {
    return Refusal{"crashed", fmt::format("{} starts in a row ended within {:.0f} s",
                                          starts->unproven(), to_seconds(kProvenAfter))};
  }
  if (const Duration since = away(*starts, now); since > limits.oldest) {
    return Refusal{"old",
                   fmt::format("was last written {:.1f} h ago, more than the {:.1f} h of "
                               "storage.resume_within_h",
                               to_seconds(since) / 3600.0, to_seconds(limits.oldest) / 3600.0)};
  }
  return std::nullopt;
}

Result<void> set_aside(const std::filesystem::path& file, const Refusal& refusal) {
  auto aside = put_aside(file, refusal.name);
  if (!aside) return forward_error(aside);
  spdlog::warn("{}: {}; it is kept as {}, and a new state begins", file.string(), refusal.reason,
               aside->filename().string());
  return {};
}

FileResult<OpenState> count_start(RecordFile file, Records records, const StateIdentity& identity,
                                  Timestamp now) {
  OpenState opened{std::move(file), std::move(records), 1, now, {}};
  proto::StateStarts starts;
  if (auto held = parse<proto::StateStarts>(opened.records, kStarts)) {
    starts = *std::move(held);
    opened.away = away(starts, now);
  }
  opened.start_number = starts.number() + 1;
  starts.set_number(opened.start_number);
  starts.set_unproven(starts.unproven() + 1);
  starts.set_written_at_ns(now.time_since_epoch().count());
  starts.add_incarnations(identity.incarnation);
  auto& kept = *starts.mutable_incarnations();
  if (kept.size() > kKeptIncarnations) kept.erase(kept.begin());
  // Whether there was anything before: the two records of a start alone are no state.
  opened.records.erase(kHeader);
  opened.records.erase(kStarts);
  const std::string text = starts.SerializeAsString();
  auto written =
      opened.file.write({{kHeader, header_of(identity).SerializeAsString()}, {kStarts, text}});
  if (!written) return tl::unexpected(written.error());
  opened.records[kStarts] = text;
  return opened;
}

/// One try; a refusal that putting the file aside may cure comes as FileProblem::damaged.
FileResult<OpenState> try_open(const std::filesystem::path& path, const StateIdentity& identity,
                               const ResumeLimits& limits, Timestamp now, Refusal& refusal) {
  refusal = {"damaged", ""};
  auto file = RecordFile::open(path);
  if (!file) return tl::unexpected(file.error());
  auto records = file->read_all();
  if (!records) return tl::unexpected(records.error());
  if (auto refused = judge(*records, identity, limits, now)) {
    refusal = *std::move(refused);
    return tl::unexpected(FileFailure{FileProblem::damaged, refusal.reason});
  }
  return count_start(*std::move(file), *std::move(records), identity, now);
}

}  // namespace

Result<std::optional<OpenState>> open_state(const std::filesystem::path& folder,
                                            const StateIdentity& identity,
                                            const ResumeLimits& limits, Timestamp now) {
  const std::filesystem::path path = folder / (identity.id + ".state");
  Refusal refusal;
  auto opened = try_open(path, identity, limits, now, refusal);
  if (!opened && opened.error().problem == FileProblem::damaged) {
    if (refusal.reason.empty()) refusal.reason = opened.error().text;
    if (auto moved = set_aside(path, refusal); !moved) {
      opened = tl::unexpected(FileFailure{FileProblem::refused, moved.error().text});
    } else {
      opened = try_open(path, identity, limits, now, refusal);
    }
  }
  if (opened) return std::optional(*std::move(opened));
  if (opened.error().problem == FileProblem::in_use) {
    return fail(ErrorCode::unavailable, "{}", opened.error().text);
  }
  spdlog::error("{} -- nothing is kept on disk: a restart begins anew", opened.error().text);
  return std::optional<OpenState>();
}

Result<std::optional<OpenState>> begin_anew(OpenState unsound, const std::filesystem::path& folder,
                                            const StateIdentity& identity,
                                            const std::string& reason, Timestamp now) {
  const std::filesystem::path path = unsound.file.path();
  { const RecordFile closed = std::move(unsound.file); }
  if (auto moved = set_aside(path, {"damaged", "is damaged: " + reason}); !moved) {
    spdlog::error("{} -- nothing is kept on disk: a restart begins anew", moved.error().text);
    return std::optional<OpenState>();
  }
  return open_state(folder, identity, {}, now);
}

StateBeat::StateBeat(RecordStore& store, const Records& records, SteadyTime now)
    : store_(store), starts_(records.at(kStarts)), started_(now) {}

void StateBeat::step(SteadyTime now, Timestamp wall_now) {
  if (now < due_) return;
  due_ = now + kBeatInterval;
  proven_ = proven_ || now - started_ >= kProvenAfter;
  write(wall_now);
}

void StateBeat::finish(Timestamp wall_now) {
  proven_ = true;
  write(wall_now);
}

void StateBeat::write(Timestamp wall_now) {
  proto::StateStarts starts;
  if (!starts.ParseFromString(starts_)) return;  // it was read before
  starts.set_written_at_ns(wall_now.time_since_epoch().count());
  if (proven_) starts.set_unproven(0);
  store_.put(kStarts, starts.SerializeAsString());
}

}  // namespace lifeline::store
