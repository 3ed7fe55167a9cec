// Measures a server with many clients who drag, and how many edits a second the store of designs makes
// durable.
#include <CLI/CLI.hpp>
#include <filesystem>

#include "crowd_figures.h"
#include "join_figures.h"
#include "peer_figures.h"
#include "store_figures.h"

int main(int argc, char** argv) {
  CLI::App app("Measures the server and the stores of designs. Takes five minutes.");
  bool is_quick = false, has_stores = true, has_joins = true, has_peers = true;
  std::string folder = std::filesystem::temp_directory_path().string();
  app.add_flag("--quick", is_quick, "A short run: does it work at all?");
  std::vector<int> clients;
  app.add_option("--clients", clients, "Only crowds of so many clients, as 50,100")->delimiter(',');
  app.add_flag("!--no-peers", has_peers,
               "Leave ws, y-websocket, Colyseus and Socket.IO out, which npm fetches.");
  app.add_flag("!--no-joins", has_joins, "Leave joining and restarting out.");
  app.add_flag("!--no-stores", has_stores, "Leave the stores out.");
  app.add_option("--folder", folder, "On which disk; by default that of temporary files")
      ->check(CLI::ExistingDirectory);
  CLI11_PARSE(app, argc, argv);
  using namespace icome::benchmarks;
  StoreExtent extent;
  CrowdExtent crowd;
  JoinExtent joins;
  if (is_quick) {
    extent.seconds = 0.1;
    crowd = {.seconds = 0.2, .clients = {3}, .grants = 5};
    joins = {.frequency = 5, .objects = 100, .clients = 2, .times = 1};
  }
  if (!clients.empty()) crowd.clients = clients;
  // Built beside this program.
  const auto program = std::filesystem::canonical("/proc/self/exe").parent_path() / "icome-server";
  print_table(crowd_figures(program, folder, crowd), crowd);
  if (has_peers && !is_quick) print_peers(ICOME_PEERS_FOLDER, folder, crowd);
  if (has_joins) print_table(join_figures(program, folder, joins));
  if (has_stores) print_table(store_figures(folder, extent), extent, folder);
}
