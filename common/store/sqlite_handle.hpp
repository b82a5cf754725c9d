#pragma once

#include <array>
#include <memory>

#include <sqlite3.h>

namespace lifeline::store {

struct CloseDatabase {
  void operator()(sqlite3* database) const { sqlite3_close(database); }
};
struct FinalizeStatement {
  void operator()(sqlite3_stmt* statement) const { sqlite3_finalize(statement); }
};

/// Own an SQLite connection and a prepared statement. A statement must go before its connection.
using Database = std::unique_ptr<sqlite3, CloseDatabase>;
using Statement = std::unique_ptr<sqlite3_stmt, FinalizeStatement>;

/// What makes a file survive a crash, to be run in this order before anything else. Exclusive
/// before the first access: then the log's index stands in memory of our own, not in a mapped file
/// whose pages a full disk could refuse with a signal. FULL: a commit is on disk when it returns,
/// for the power may go too.
inline constexpr std::array kCrashSafe{"PRAGMA locking_mode = EXCLUSIVE",
                                       "PRAGMA journal_mode = WAL", "PRAGMA synchronous = FULL"};

}  // namespace lifeline::store
