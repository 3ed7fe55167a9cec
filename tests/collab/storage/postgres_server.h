#pragma once
// A PostgreSQL server for tests and measurements, in a folder of its own and reached through a socket in it
// only.
#include <fcntl.h>
#include <grp.h>
#include <libpq-fe.h>
#include <pwd.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

namespace icome::collab {

/// A connection for what no program of ours does to a database. Owns it.
class PostgresMeddler {
 public:
  explicit PostgresMeddler(const std::string& address) : handle_(PQconnectdb(address.c_str()), PQfinish) {
    PQsetNoticeProcessor(
        handle_.get(), [](void*, const char*) {}, nullptr);
  }
  /// Runs a statement; gives the first column of its first row, empty where there is none.
  std::string run(const std::string& sql) {
    const std::unique_ptr<PGresult, void (*)(PGresult*)> result(PQexec(handle_.get(), sql.c_str()), PQclear);
    const ExecStatusType status = PQresultStatus(result.get());
    if (status != PGRES_TUPLES_OK && status != PGRES_COMMAND_OK)
      throw std::runtime_error(PQerrorMessage(handle_.get()));
    return PQntuples(result.get()) > 0 ? PQgetvalue(result.get(), 0, 0) : "";
  }

 private:
  std::unique_ptr<PGconn, void (*)(PGconn*)> handle_;
};

/// A PostgreSQL server of its own, with fsync on. Owns its folder and its processes, which end with the
/// object, and with this process whatever becomes of it. The thread that starts it must live as long.
class PostgresServer {
 public:
  /// The newest one that Debian's packages have installed; nothing where there is none.
  static std::optional<std::filesystem::path> programs() {
    std::vector<std::filesystem::path> found;
    std::error_code error;
    for (const auto& version : std::filesystem::directory_iterator("/usr/lib/postgresql", error))
      if (std::filesystem::exists(version.path() / "bin" / "initdb")) found.push_back(version.path() / "bin");
    if (found.empty()) return std::nullopt;
    return *std::max_element(found.begin(), found.end());
  }

  explicit PostgresServer(const std::filesystem::path& within) : programs_(programs().value()) {
    std::string pattern = (within / "icome_postgres_XXXXXX").string();
    if (::mkdtemp(pattern.data()) == nullptr) throw std::runtime_error("no folder for PostgreSQL");
    folder_ = pattern;
    // The server refuses to run as the administrator: it gets the user that Debian's package makes.
    if (::geteuid() == 0) {
      const passwd* const user = ::getpwnam("postgres");
      if (user == nullptr) throw std::runtime_error("there is no user postgres");
      user_ = {user->pw_uid, user->pw_gid};
      if (::chown(folder_.c_str(), user_->first, user_->second) != 0)
        throw std::runtime_error("chown failed");
    }
    std::ofstream(folder_ / "password") << kPassword << '\n';
    std::filesystem::permissions(folder_ / "password", std::filesystem::perms(0644));
    const int code = wait_for(begin("initdb", {"-D", data(), "-U", kUser, "--pwfile", folder_ / "password",
                                               "--auth=scram-sha-256", "-E", "UTF8", "--locale=C", "-N"}));
    if (code != 0) throw std::runtime_error("initdb failed:\n" + log());
    start();
  }
  PostgresServer(const PostgresServer&) = delete;
  PostgresServer& operator=(const PostgresServer&) = delete;
  ~PostgresServer() {
    if (::getpid() != owner_) return;  // a copy of the object in a child
    stop();
    std::error_code ignored;
    std::filesystem::remove_all(folder_, ignored);
  }

  /// Starts it, again after kill() in the same folder, and waits until it answers.
  void start() {
    const std::string address = this->address("postgres");
    for (int i = 0; i < 3000; ++i) {
      // It gives up where processes that were killed have not quite gone yet.
      if (server_ == 0 || ::waitpid(server_, nullptr, WNOHANG) != 0)
        server_ = begin("postgres", {"-D", data(), "-k", folder_, "-c", "listen_addresses=", "-c", "fsync=on",
                                     "-c", "shared_buffers=32MB", "-c", "max_connections=40"});
      if (PQping(address.c_str()) == PQPING_OK) return;
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    throw std::runtime_error("PostgreSQL does not start:\n" + log());
  }

  /// Ends all its processes at once, as a loss of power does (but for what the system has not written yet).
  void kill() {
    if (server_ == 0) return;
    ::kill(server_, SIGSTOP);  // so that it makes no others meanwhile
    signal(SIGKILL);
    ::waitpid(server_, nullptr, 0);
    server_ = 0;
  }
  /// Sends a signal to all its processes.
  void signal(int number) {
    for (const pid_t child : children()) ::kill(child, number);
    ::kill(server_, number);  // last: without it, its children would not be known as such
  }

  /// The address of one of its databases, with another password if asked for.
  std::string address(const std::string& database, const std::string& password = kPassword) const {
    return "postgresql://" + std::string(kUser) + ":" + password + "@/" + database +
           "?host=" + folder_.string();
  }
  /// The address of a database that is made for it, empty.
  std::string fresh_database() {
    const std::string name = "fresh_" + std::to_string(++databases_);
    PostgresMeddler(address("postgres")).run("CREATE DATABASE " + name);
    return address(name);
  }
  const std::filesystem::path& folder() const { return folder_; }

 private:
  /// Ends it such that it leaves nothing in the system's shared memory.
  void stop() {
    if (server_ == 0) return;
    ::kill(server_, SIGINT);  // "fast shutdown" to PostgreSQL
    for (int i = 0; i < 1000; ++i) {
      if (::waitpid(server_, nullptr, WNOHANG) != 0) return;
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    kill();
  }

  static constexpr const char* kUser = "icome";
  static constexpr const char* kPassword = "correct-horse";

  std::string data() const { return folder_ / "data"; }
  std::string log() const {
    std::ifstream file(folder_ / "log");
    return {std::istreambuf_iterator<char>(file), {}};
  }

  /// Starts one of its programs, as its user, whose output goes to the log.
  pid_t begin(const std::string& program, std::vector<std::string> arguments) {
    const std::string path = programs_ / program, log = folder_ / "log";
    arguments.insert(arguments.begin(), path);
    std::vector<char*> pointers;
    for (std::string& it : arguments) pointers.push_back(it.data());
    pointers.push_back(nullptr);
    const pid_t child = ::fork();
    if (child != 0) return child;
    if (user_ &&
        (::setgroups(0, nullptr) != 0 || ::setgid(user_->second) != 0 || ::setuid(user_->first) != 0))
      ::_exit(126);
    ::prctl(PR_SET_PDEATHSIG, SIGQUIT);  // "immediate shutdown" to PostgreSQL
    const int output = ::open(log.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0600);
    if (::chdir(folder_.c_str()) != 0 || ::dup2(output, 1) < 0 || ::dup2(output, 2) < 0) ::_exit(126);
    ::execv(path.c_str(), pointers.data());
    ::_exit(127);
  }
  static int wait_for(pid_t child) {
    int status = 0;
    ::waitpid(child, &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }

  /// The processes whose parent the server is, by the fourth field of their /proc/PID/stat.
  std::vector<pid_t> children() const {
    std::vector<pid_t> found;
    std::error_code error;
    for (const auto& entry : std::filesystem::directory_iterator("/proc", error)) {
      const std::string name = entry.path().filename();
      if (name.find_first_not_of("0123456789") != std::string::npos) continue;
      std::ifstream file(entry.path() / "stat");
      std::string text;
      std::getline(file, text);
      const std::size_t behind = text.rfind(')');  // of the program's name, in which anything may be
      if (behind == std::string::npos || behind + 4 >= text.size()) continue;
      if (std::atoi(text.c_str() + behind + 4) == server_) found.push_back(std::atoi(name.c_str()));
    }
    return found;
  }

  std::filesystem::path programs_, folder_;
  std::optional<std::pair<uid_t, gid_t>> user_;
  pid_t owner_ = ::getpid();
  pid_t server_ = 0;
  int databases_ = 0;
};

}  // namespace icome::collab
