#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "common/base/config_folder.hpp"
#include "common/dds/channel.hpp"

namespace lifeline::dds {

/// Opens one end of a topic into `end`; the first failure of several is kept in `all`, and then no
/// further end is opened.
template <typename Message>
void open_outbox(Participant& participant, std::unique_ptr<wire::Outbox<Message>>& end,
                 Result<void>& all, Standing standing = Standing::primary) {
  if (!all) return;
  auto made = make_outbox<Message>(participant, standing);
  if (made) {
    end = *std::move(made);
  } else {
    all = forward_error(made);
  }
}

template <typename Message>
void open_inbox(Participant& participant, std::unique_ptr<wire::Inbox<Message>>& end,
                Result<void>& all) {
  if (!all) return;
  auto made = make_inbox<Message>(participant);
  if (made) {
    end = *std::move(made);
  } else {
    all = forward_error(made);
  }
}

/// Opens the four ends by which missing tiles are asked for and sent again
/// (sharing::ExchangeChannels).
template <typename Exchange>
void open_exchange(Participant& participant, Exchange& exchange, Result<void>& all) {
  open_outbox(participant, exchange.ask, all);
  open_inbox(participant, exchange.asked, all);
  open_outbox(participant, exchange.send, all);
  open_inbox(participant, exchange.sent, all);
}

/// Which QoS file a program takes: the one given on its command line; else the one its
/// configuration names, beside that file; else the one of that name in the shipped configuration
/// folder.
[[nodiscard]] inline Result<std::filesystem::path> qos_file(
    const std::optional<std::filesystem::path>& given,
    const std::optional<std::filesystem::path>& config_file, const std::string& named) {
  if (given) return *given;
  const std::filesystem::path path(named);
  if (path.is_absolute()) return path;
  if (config_file) return config_file->parent_path() / path;
  auto folder = config_folder();
  if (!folder) return folder;
  return *folder / path;
}

}  // namespace lifeline::dds
