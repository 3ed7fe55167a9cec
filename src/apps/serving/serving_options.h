#pragma once
#include <filesystem>
#include <string>
#include <vector>

namespace icome::apps {

/// The options of `icome serve`, `invite`, `revoke` and `store`, as the command line gives them.
struct ServingOptions {
  std::string task;   // "serve", "invite", "revoke", "store list", "store check" and so on
  std::string store;  // a folder or the address of a database; empty: the usual folder
  // serve
  std::string listen;                 // HOST:PORT; empty: as before, or the usual port of this machine
  std::filesystem::path certificate;  // PEM, with `key`; empty: the store's own
  std::filesystem::path key;
  std::filesystem::path files;  // of a server before a database; empty: the usual folder
  std::string bus;              // nats://HOST:PORT; empty: none
  bool insecure = false;
  std::string health;                // HOST:PORT for /health and /metrics; empty: none
  std::vector<std::string> origins;  // of browsers
  int links_an_address = 200;
  // invite, revoke, store
  std::string design;
  std::string role = "edit";
  std::string lasts = "8h";
  std::string server;  // HOST:PORT; empty: where the store is served
  std::string link;    // to revoke, or the id of an invitation
  std::filesystem::path file;
  bool force = false;
  bool json = false;
};

}  // namespace icome::apps
