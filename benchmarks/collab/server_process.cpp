#include "server_process.h"

#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <fstream>
#include <iterator>
#include <sstream>

#include "collab/client/joining.h"
#include "collab/server/token.h"
#include "collab/storage/sqlite_op_log.h"
#include "collab/storage/store_folder.h"

namespace icome::benchmarks {

using namespace collab;

BenchFolder::BenchFolder(const std::filesystem::path& within) {
  std::string pattern = (within / "icome_bench_XXXXXX").string();
  if (::mkdtemp(pattern.data()) == nullptr) std::exit(1);
  path_ = pattern;
}
BenchFolder::~BenchFolder() { std::filesystem::remove_all(path_); }

ServerProcess::ServerProcess(std::filesystem::path program, std::filesystem::path store, int port)
    : store_(std::move(store)) {
  int out[2];
  if (::pipe(out) != 0) std::exit(1);
  const std::string listen = fmt::format("127.0.0.1:{}", port);
  process_ = ::fork();
  if (process_ == 0) {
    ::prctl(PR_SET_PDEATHSIG, SIGTERM);  // also where the benchmark gives up
    ::dup2(out[1], STDOUT_FILENO);
    ::execl(program.c_str(), program.c_str(), "serve", "--store", store_.c_str(), "--listen", listen.c_str(),
            "--links-an-address", "1000", "--json", nullptr);
    ::_exit(1);
  }
  ::close(out[1]);
  char letter = '\0';
  while (::read(out[0], &letter, 1) == 1 && letter != '\n') {
  }
  ::close(out[0]);
}

ServerProcess::~ServerProcess() {
  if (process_ < 0) return;
  ::kill(process_, SIGTERM);
  ::waitpid(process_, nullptr, 0);
}

void ServerProcess::kill() {
  ::kill(process_, SIGKILL);
  ::waitpid(process_, nullptr, 0);
  process_ = -1;
}

DesignAddress ServerProcess::invite(const std::string& design) const {
  const StoreFolder folder = demand(StoreFolder::open(store_));
  const ServedAddress served = *demand(folder.address());
  SqliteOpLog log = demand(SqliteOpLog::open(folder.designs()));
  if (!demand(log.find(design))) demand(log.create(design));
  const TokenSigner signer = demand(TokenSigner::open(folder.token_key()));
  constexpr std::int64_t kHour = 3'600'000;
  std::string token =
      demand(signer.sign({demand(make_invitation_id()), design, Role::Own, wall_milliseconds() + kHour}));
  return {served.host, served.port, design, std::move(token), served.fingerprint};
}

double ServerProcess::used() const {
  std::ifstream stat(fmt::format("/proc/{}/stat", process_));
  std::string text((std::istreambuf_iterator<char>(stat)), {});
  std::istringstream fields(text.substr(text.rfind(')') + 2));
  std::string field;
  double ticks = 0.0;
  for (int i = 0; i < 13 && fields >> field; ++i)
    if (i >= 11) ticks += std::stod(field);
  return ticks / double(::sysconf(_SC_CLK_TCK));
}

double ServerProcess::memory() const {
  std::ifstream status(fmt::format("/proc/{}/status", process_));
  for (std::string line; std::getline(status, line);)
    if (line.starts_with("VmRSS:")) return std::stod(line.substr(6));
  return 0.0;
}

}  // namespace icome::benchmarks
