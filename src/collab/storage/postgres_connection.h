#pragma once
#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>

#include "base/result.h"

struct pg_conn;
struct pg_result;

namespace icome::collab {

/// How long a database is waited for.
struct PostgresPatience {
  std::int64_t connecting = 5'000;  // ms for each of its addresses; whole seconds count, 2 at least
  std::int64_t statement = 10'000;  // ms that a statement takes at most, waiting for others included
  std::int64_t silence = 15'000;    // ms in which not a byte comes or goes; above `statement`
};

/// A statement that is prepared once for each connection. Its parameters are $1, $2, ...
struct PostgresStatement {
  const char* name;
  const char* sql;
};

/// A parameter of a statement in PostgreSQL's binary form: a number (bigint), or text, bytes or an array,
/// which are borrowed. Implicit, so that statements are called as functions are.
class PostgresValue {
 public:
  PostgresValue(std::int64_t number);
  PostgresValue(std::uint64_t number) : PostgresValue(std::int64_t(number)) {}
  PostgresValue(std::string_view bytes) : bytes_(bytes), is_number_(false) {}
  PostgresValue(const std::string& bytes) : PostgresValue(std::string_view(bytes)) {}

  const char* data() const { return is_number_ ? number_.data() : bytes_.empty() ? "" : bytes_.data(); }
  std::size_t size() const { return is_number_ ? number_.size() : bytes_.size(); }

 private:
  std::array<char, 8> number_ = {};
  std::string_view bytes_ = {};
  bool is_number_ = true;
};

/// An array in PostgreSQL's binary form, so that one statement writes many rows. Owns its bytes.
class PostgresArray {
 public:
  enum class Of { Numbers, Texts, Bytes };
  explicit PostgresArray(Of kind);

  void add(const PostgresValue& value);
  std::int32_t count() const { return count_; }
  /// As a parameter, which ends with the next change of the array.
  PostgresValue value();

 private:
  std::string bytes_;
  std::int32_t count_ = 0;
};

/// The rows that a statement gave. Owns them.
class PostgresRows {
 public:
  explicit PostgresRows(pg_result* result = nullptr) : result_(result) {}

  pg_result* handle() const { return result_.get(); }
  int count() const;
  // Columns from 0, of a row that is there.
  std::int64_t integer(int row, int column) const;  // of a bigint
  std::uint64_t natural(int row, int column) const { return std::uint64_t(integer(row, column)); }
  std::string bytes(int row, int column) const;  // of text and bytes

 private:
  struct Clear {
    void operator()(pg_result* it) const;
  };
  std::unique_ptr<pg_result, Clear> result_;
};

/// A connection to a PostgreSQL database. Owns it, and makes another one where it was lost: the call that it
/// was lost in fails, the next one connects. Statements are queued, and go to the database together with the
/// next one that is run, so that they share its way there and back. Errors are sentences that name the
/// database, never a password.
class PostgresConnection {
 public:
  /// Runs on each new connection, before anything else does.
  using Begin = std::function<base::Result<void>(PostgresConnection&)>;

  /// Connects to an address "postgresql://...".
  static base::Result<PostgresConnection> open(const std::string& address, const PostgresPatience& patience,
                                               Begin begin);

  /// The address without user and password.
  const std::string& place() const { return place_; }

  /// Sends a statement with the next one that is run; also that one fails if this one does.
  template <typename... Values>
  void queue(const PostgresStatement& statement, const Values&... values) {
    const std::array<PostgresValue, sizeof...(Values)> list = {PostgresValue(values)...};
    send(statement, list);
  }
  /// Runs a statement that was prepared, outside of a transaction as one by itself.
  template <typename... Values>
  base::Result<PostgresRows> run(const PostgresStatement& statement, const Values&... values) {
    queue(statement, values...);
    return finish();
  }
  /// Runs one that was not, and has no parameters.
  base::Result<PostgresRows> execute(const char* sql);
  base::Result<void> prepare(std::span<const PostgresStatement> statements);

  /// Runs `work`, which gives a Result, on a connection that is there. It may be called again, where the
  /// database asks for that.
  template <typename Work>
  auto connected(Work&& work) -> decltype(work()) {
    for (int tries = 1;; ++tries) {
      if (const auto there = demand_connected(); !there) return tl::unexpected(there.error());
      auto result = work();
      if (result || !should_try_again(tries)) return result;
    }
  }
  /// Runs `work`, as connected() does, as one transaction that `begin` starts; what it changed is taken back
  /// where it fails. A connection that is lost during the commit leaves open whether it was, and the sentence
  /// says so.
  template <typename Work>
  auto transact(const char* begin, Work&& work) -> decltype(work()) {
    return connected([&]() -> decltype(work()) {
      send_sql(begin);
      auto result = work();
      if (result) {
        const auto committed = commit();
        if (committed) return result;
        result = tl::unexpected(committed.error());
      }
      roll_back();
      return result;
    });
  }

 private:
  struct Finish {
    void operator()(pg_conn* it) const;
  };
  PostgresConnection(std::string address, PostgresPatience patience, Begin begin)
      : address_(std::move(address)), patience_(patience), begin_(std::move(begin)) {}

  base::Result<void> demand_connected();
  base::Result<void> connect();
  base::Result<void> begin_session();
  bool has_ended() const;
  bool should_try_again(int tries);

  void send(const PostgresStatement& statement, std::span<const PostgresValue> values);
  void send_sql(const char* sql);
  base::Result<PostgresRows> finish();
  bool wait_for_result();
  base::Error note_problem(const PostgresRows& failed);
  base::Error lose();
  base::Result<void> commit();
  void roll_back();

  std::string address_;
  PostgresPatience patience_;
  Begin begin_;
  std::string place_;
  std::unique_ptr<pg_conn, Finish> handle_;  // null: not connected
  bool is_sent_ = true;                      // all that was queued
  bool is_again_ = false;                    // the last problem goes away when the work is done again
  bool is_fatal_ = false;                    // ... has ended the connection
};

}  // namespace icome::collab
