#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "common/base/result.hpp"
#include "common/store/sqlite_handle.hpp"

namespace lifeline::bag {

/// One .db3 file of a rosbag2 recording, to be read; from anywhere. Opened read-only, and as
/// immutable where no write-ahead log stands beside it: a bag on a read-only medium plays, and one
/// whose recorder was killed is read with all that its log holds.
class BagFile {
 public:
  /// not_found, bad_data (no such database, or damaged), unavailable (the system refused).
  [[nodiscard]] static Result<BagFile> open(const std::string& file);

  [[nodiscard]] Result<store::Statement> prepare(std::string_view sql) const;
  /// True on a row, false at the end.
  [[nodiscard]] Result<bool> step(sqlite3_stmt* statement) const;
  [[nodiscard]] const std::string& name() const { return name_; }

 private:
  BagFile(std::string name, store::Database database)
      : name_(std::move(name)), database_(std::move(database)) {}
  [[nodiscard]] Result<void> check_tables() const;

  std::string name_;
  store::Database database_;
};

/// Empty where the column holds nothing.
[[nodiscard]] std::string column_text(sqlite3_stmt* row, int column);

struct Topic {
  std::string name;
  std::string type;  ///< `sensor_msgs/msg/LaserScan`
};

/// The file's topics in the order of their ids. unsupported for topics that are not in CDR.
[[nodiscard]] Result<std::vector<Topic>> topics_of(const BagFile& file);

/// `files` in the order of their first messages.
[[nodiscard]] Result<std::vector<std::string>> by_time(const std::vector<std::string>& files);

/// The files of a folder whose names end so, in the order of their names.
[[nodiscard]] std::vector<std::string> files_ending(const std::string& folder,
                                                    std::string_view ending);

}  // namespace lifeline::bag
