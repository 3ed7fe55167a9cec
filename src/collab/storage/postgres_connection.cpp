#include "collab/storage/postgres_connection.h"

#include <fmt/format.h>
#include <libpq-fe.h>
#include <poll.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <optional>
#include <thread>
#include <vector>

namespace icome::collab {
namespace {

constexpr int kBinary = 1;
constexpr int kMostTries = 4;
constexpr int kOldestPostgres = 130000;  // as libpq counts them
// The others must not wait for a server that stopped in the middle: they take its designs over.
constexpr int kIdleTransactionMilliseconds = 4000;

template <typename Number>
void put_big_endian(char* to, Number number) {
  for (std::size_t i = 0; i < sizeof number; ++i)
    to[i] = char(static_cast<unsigned char>(std::uint64_t(number) >> (8 * (sizeof number - 1 - i))));
}

/// The first line of a message of libpq, without a period at its end.
std::string first_line(const char* message) {
  std::string line(message ? message : "");
  line.resize(std::min(line.find('\n'), line.size()));
  while (!line.empty() && (line.back() == '.' || line.back() == ' ')) line.pop_back();
  return line;
}

/// The address as errors show it: the database, where it is, and nobody's name or password.
std::string shown_place(const PGconn* connection) {
  const auto text = [](const char* it) { return std::string(it ? it : ""); };
  const std::string host = text(PQhost(connection)), port = text(PQport(connection)),
                    name = text(PQdb(connection));
  if (host.starts_with('/')) return fmt::format("postgresql:///{}?host={}&port={}", name, host, port);
  const bool is_ipv6 = host.find(':') != std::string::npos;
  return fmt::format("postgresql://{}{}{}:{}/{}", is_ipv6 ? "[" : "", host, is_ipv6 ? "]" : "", port, name);
}

/// Fails, repeating nothing of it, for an address that libpq would take apart wrongly: it could tell a part
/// of a password for a host or a port.
base::Result<void> check_database_address(const std::string& address) {
  const auto wrong = [](std::string_view why) {
    return base::fail(
        fmt::format("The address of the database {}. Write "
                    "postgresql://USER:PASSWORD@HOST:PORT/DATABASE, and in the user's name and "
                    "the password %40 for @, %2F for /, %3A for :, %25 for %.",
                    why));
  };
  const std::size_t scheme = address.find("://"), at = address.rfind('@');
  const std::size_t begin = scheme == std::string::npos ? 0 : scheme + 3;
  if (at != std::string::npos && address.find_first_of("/?#@ ", begin) < at)
    return wrong("has one of / ? # @ where they cannot be");
  PQconninfoOption* const parts = PQconninfoParse(address.c_str(), nullptr);
  if (parts == nullptr) return wrong("cannot be read");
  PQconninfoFree(parts);
  return {};
}

std::string connecting_sentence(PGconn* connection, const std::string& place) {
  if (PQconnectionNeedsPassword(connection))
    return place + ": wants a password. Write it into the address, into PGPASSWORD or into ~/.pgpass.";
  return fmt::format(
      "{}: cannot be connected to ({}). See whether PostgreSQL runs there, and whether the "
      "address, the user and the password are right.",
      place, first_line(PQerrorMessage(connection)));
}

/// What an error of the database (its SQLSTATE and its own words) means for the person who runs the server.
std::string database_sentence(std::string_view code, const std::string& place, const std::string& words) {
  const auto is_one_of = [&](std::initializer_list<std::string_view> codes) {
    for (const std::string_view it : codes)
      if (code.starts_with(it)) return true;
    return false;
  };
  if (is_one_of({"57014", "55P03"}))
    return place +
           ": somebody kept it locked, or it was too busy, for too long. Nothing was changed; try again.";
  if (is_one_of({"40001", "40P01"}))
    return place + ": too many changed the same at once. Nothing was changed; try again.";
  if (is_one_of({"53100"}))
    return place + ": the database's disk is full. Make room, then try again; what was saved before is safe.";
  if (is_one_of({"25006"}))
    return place +
           ": can only be read, as a copy of another database. Name that one, or make this one the main.";
  if (is_one_of({"42501"}))
    return fmt::format("{}: the user lacks a right ({}). Let the database's owner grant it.", place, words);
  if (is_one_of({"42P07", "42710", "42723"}))
    return place + ": its schema icome is that of another program. Choose another database.";
  if (is_one_of({"3F000", "42P01", "42703", "42883", "XX001", "XX002"}))
    return fmt::format("{}: the store in it is damaged ({}). Restore a backup of the database.", place,
                       words);
  if (is_one_of({"54"}))
    return fmt::format("{}: what should be saved is larger than it takes ({}). Make it smaller.", place,
                       words);
  return fmt::format("{}: the database failed ({}). What was saved before is safe.", place, words);
}

}  // namespace

PostgresValue::PostgresValue(std::int64_t number) { put_big_endian(number_.data(), number); }

PostgresArray::PostgresArray(Of kind) : bytes_(20, '\0') {
  constexpr std::int32_t kOids[] = {20, 25, 17};  // of bigint, text and bytea, the same in every database
  put_big_endian(bytes_.data() + 8, kOids[int(kind)]);
  put_big_endian(bytes_.data() + 16, std::int32_t{1});  // the first index
}

void PostgresArray::add(const PostgresValue& value) {
  char size[4];
  put_big_endian(size, std::int32_t(value.size()));
  bytes_.append(size, sizeof size).append(value.data(), value.size());
  ++count_;
}

PostgresValue PostgresArray::value() {
  put_big_endian(bytes_.data(), std::int32_t{1});  // dimensions
  put_big_endian(bytes_.data() + 12, count_);
  return std::string_view(bytes_);
}

void PostgresRows::Clear::operator()(pg_result* it) const { PQclear(it); }

int PostgresRows::count() const { return result_ ? PQntuples(result_.get()) : 0; }

std::int64_t PostgresRows::integer(int row, int column) const {
  std::uint64_t number = 0;
  const char* const first = PQgetvalue(result_.get(), row, column);
  for (int i = 0; i < PQgetlength(result_.get(), row, column); ++i)
    number = number << 8U | static_cast<unsigned char>(first[i]);
  return std::int64_t(number);
}

std::string PostgresRows::bytes(int row, int column) const {
  return {PQgetvalue(result_.get(), row, column), std::size_t(PQgetlength(result_.get(), row, column))};
}

void PostgresConnection::Finish::operator()(pg_conn* it) const { PQfinish(it); }

base::Result<PostgresConnection> PostgresConnection::open(const std::string& address,
                                                          const PostgresPatience& patience, Begin begin) {
  if (const auto good = check_database_address(address); !good) return tl::unexpected(good.error());
  PostgresConnection connection(address, patience, std::move(begin));
  if (const auto made = connection.connect(); !made) return tl::unexpected(made.error());
  return connection;
}

base::Result<void> PostgresConnection::demand_connected() {
  if (handle_ && has_ended()) handle_.reset();
  return handle_ ? base::Result<void>() : connect();
}

/// Whether the database has hung up since the last call: then nothing is lost by connecting again.
bool PostgresConnection::has_ended() const {
  pollfd waiting{PQsocket(handle_.get()), POLLIN, 0};
  while (::poll(&waiting, 1, 0) > 0)  // its farewell comes before the end
    if (PQconsumeInput(handle_.get()) == 0) return true;
  return PQstatus(handle_.get()) != CONNECTION_OK;
}

base::Result<void> PostgresConnection::connect() {
  const std::string seconds = std::to_string(patience_.connecting / 1000),
                    silence = std::to_string(patience_.silence);
  // What the address says goes before what stands in front of it.
  const char* const keywords[] = {"connect_timeout",
                                  "tcp_user_timeout",
                                  "keepalives_idle",
                                  "keepalives_interval",
                                  "keepalives_count",
                                  "fallback_application_name",
                                  "dbname",
                                  "client_encoding",
                                  nullptr};
  const char* const values[] = {seconds.c_str(), silence.c_str(),  "5",    "2",    "3",
                                "icome",         address_.c_str(), "UTF8", nullptr};
  handle_.reset(PQconnectdbParams(keywords, values, 1));
  is_sent_ = true;
  is_again_ = is_fatal_ = false;
  if (!handle_) return base::fail("There is not enough memory to connect to the database.");
  place_ = shown_place(handle_.get());
  PQsetNoticeProcessor(
      handle_.get(), [](void*, const char*) {}, nullptr);
  const bool is_there = PQstatus(handle_.get()) == CONNECTION_OK;
  auto begun = is_there ? begin_session() : base::fail(connecting_sentence(handle_.get(), place_));
  if (!begun) handle_.reset();
  return begun;
}

base::Result<void> PostgresConnection::begin_session() {
  if (PQserverVersion(handle_.get()) < kOldestPostgres)
    return base::fail(place_ + ": is older than PostgreSQL 13. Use a newer one.");
  const char* const encoding = PQparameterStatus(handle_.get(), "server_encoding");
  if (encoding == nullptr || std::strcmp(encoding, "UTF8") != 0)
    return base::fail(place_ +
                      ": does not keep text as UTF-8. Make a database with: CREATE DATABASE icome "
                      "ENCODING 'UTF8' TEMPLATE template0.");
  if (PQsetnonblocking(handle_.get(), 1) != 0 || PQenterPipelineMode(handle_.get()) != 1)
    return tl::unexpected(lose());
  // A commit is answered when it is on the disk, whatever the database's own settings are. Keepalives let the
  // database end the transactions of a machine that is gone.
  const std::string settings = fmt::format(
      "SELECT set_config(name, value, false) FROM (VALUES ('synchronous_commit', 'on'), "
      "('default_transaction_isolation', 'read committed'), ('statement_timeout', '{0}'), "
      "('lock_timeout', '{0}'), ('idle_in_transaction_session_timeout', '{1}'), ('tcp_keepalives_idle', "
      "'5'), "
      "('tcp_keepalives_interval', '2'), ('tcp_keepalives_count', '3')) AS settings (name, value)",
      patience_.statement, kIdleTransactionMilliseconds);
  if (const auto set = execute(settings.c_str()); !set) return tl::unexpected(set.error());
  return begin_(*this);
}

bool PostgresConnection::should_try_again(int tries) {
  if (!is_again_ || !handle_ || tries >= kMostTries) return false;
  std::this_thread::sleep_for(std::chrono::milliseconds(5 * tries));
  return true;
}

void PostgresConnection::send(const PostgresStatement& statement, std::span<const PostgresValue> values) {
  if (!handle_) return;  // finish() tells
  std::vector<const char*> first;
  std::vector<int> sizes;
  for (const PostgresValue& it : values) {
    first.push_back(it.data());
    sizes.push_back(int(it.size()));
  }
  const std::vector<int> formats(values.size(), kBinary);
  const int sent = PQsendQueryPrepared(handle_.get(), statement.name, int(values.size()), first.data(),
                                       sizes.data(), formats.data(), kBinary);
  is_sent_ = is_sent_ && sent == 1;
}

void PostgresConnection::send_sql(const char* sql) {
  if (!handle_) return;  // finish() tells
  const int sent = PQsendQueryParams(handle_.get(), sql, 0, nullptr, nullptr, nullptr, nullptr, kBinary);
  is_sent_ = is_sent_ && sent == 1;
}

base::Result<PostgresRows> PostgresConnection::execute(const char* sql) {
  send_sql(sql);
  return finish();
}

base::Result<void> PostgresConnection::prepare(std::span<const PostgresStatement> statements) {
  for (const PostgresStatement& it : statements)
    if (handle_) is_sent_ = PQsendPrepare(handle_.get(), it.name, it.sql, 0, nullptr) == 1 && is_sent_;
  if (const auto prepared = finish(); !prepared) return tl::unexpected(prepared.error());
  return {};
}

/// Sends what is queued, and gives the rows of its last statement, or the first problem.
base::Result<PostgresRows> PostgresConnection::finish() {
  is_again_ = is_fatal_ = false;
  if (!handle_ || !is_sent_ || PQpipelineSync(handle_.get()) != 1) return tl::unexpected(lose());
  PostgresRows last;
  std::optional<base::Error> problem;
  for (int ends = 0; ends < 2;) {  // each statement's results have one end, and two would be the connection's
    if (!wait_for_result()) return tl::unexpected(lose());
    PostgresRows rows(PQgetResult(handle_.get()));
    ends = rows.handle() ? 0 : ends + 1;
    switch (PQresultStatus(rows.handle())) {
      case PGRES_PIPELINE_SYNC:
        if (problem) return tl::unexpected(*problem);
        return last;
      case PGRES_TUPLES_OK:
      case PGRES_COMMAND_OK:
        last = std::move(rows);
        break;
      case PGRES_PIPELINE_ABORTED:
        break;
      default:
        if (rows.handle() && !problem) problem = note_problem(rows);
        if (is_fatal_) return tl::unexpected(lose());
    }
  }
  return tl::unexpected(lose());
}

/// Waits until PQgetResult() does not wait; gives false where the database is silent for too long.
bool PostgresConnection::wait_for_result() {
  while (true) {
    const bool has_more = PQflush(handle_.get()) > 0;
    if (PQisBusy(handle_.get()) == 0) return true;
    pollfd waiting{PQsocket(handle_.get()), short(POLLIN | (has_more ? POLLOUT : 0)), 0};
    const int ready = ::poll(&waiting, 1, int(patience_.silence));
    if (ready == 0) return false;
    if (ready < 0 && errno != EINTR) return true;
    const bool is_readable = ready > 0 && (waiting.revents & ~POLLOUT) != 0;
    if (is_readable && PQconsumeInput(handle_.get()) == 0) return true;  // PQgetResult() has the reason
  }
}

base::Error PostgresConnection::note_problem(const PostgresRows& failed) {
  const auto field = [&](int name) {
    const char* const text = PQresultErrorField(failed.handle(), name);
    return std::string(text ? text : "");
  };
  const std::string code = field(PG_DIAG_SQLSTATE), severity = field(PG_DIAG_SEVERITY_NONLOCALIZED);
  is_again_ = code == "40001" || code == "40P01";
  is_fatal_ = code.empty() || severity == "FATAL" || severity == "PANIC";
  return {database_sentence(code, place_, field(PG_DIAG_MESSAGE_PRIMARY))};
}

/// Gives the connection up, and the sentence that says so.
base::Error PostgresConnection::lose() {
  std::string why = handle_ ? first_line(PQerrorMessage(handle_.get())) : "";
  if (why.empty()) why = "it does not answer";
  handle_.reset();
  is_sent_ = true;
  is_fatal_ = true;
  return {fmt::format(
      "{}: the connection to the database was lost ({}). See whether it runs, then try again.", place_, why)};
}

base::Result<void> PostgresConnection::commit() {
  // A timeout while copies of the database are waited for would make a commit count that they do not have.
  send_sql("SET LOCAL statement_timeout = 0");
  const auto committed = execute("COMMIT");
  if (committed) return {};
  if (handle_) return tl::unexpected(committed.error());
  return base::fail(committed.error().message + " Whether the last change was saved is not known.");
}

void PostgresConnection::roll_back() {
  if (!handle_) return;
  const bool is_again = is_again_;
  if (!execute("ROLLBACK")) handle_.reset();  // which ends the transaction, too
  is_again_ = is_again;
}

}  // namespace icome::collab
