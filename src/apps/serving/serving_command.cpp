#include "apps/serving/serving_command.h"

#include <CLI/CLI.hpp>

#include "apps/option_checks.h"
#include "apps/serving/invite_command.h"
#include "apps/serving/serve_command.h"
#include "apps/serving/serving_help.h"
#include "apps/serving/store_command.h"

namespace icome::apps {
namespace {

void add_store_folder(CLI::App& command, ServingOptions& options) {
  command
      .add_option("--store", options.store,
                  "Folder with the designs (default: icome/store in $XDG_DATA_HOME or ~/.local/share), or a "
                  "database: postgresql://HOST/DATABASE")
      ->type_name("STORE");
}

void add_serve(CLI::App& app, ServingOptions& options) {
  CLI::App& serve = *app.add_subcommand("serve", kServeSummary);
  serve.footer(kServeNotes);
  add_store_folder(serve, options);
  serve
      .add_option("--listen", options.listen,
                  "Where to listen; port 0 takes a free one (default 127.0.0.1:4263, this machine only)")
      ->type_name("HOST:PORT");
  serve.add_option("--certificate", options.certificate, "A certificate of your own, with its chain")
      ->type_name("PEM");
  serve.add_option("--key", options.key, "The key of that certificate")->type_name("PEM");
  serve
      .add_option("--bus", options.bus,
                  "NATS, by which several servers of one database pass clients on to each other: "
                  "nats://HOST:4222")
      ->type_name("URL");
  serve
      .add_option("--files", options.files,
                  "With a database: folder of this server's own, for its certificate and audit log (default: "
                  "icome/server beside the usual store)")
      ->type_name("FOLDER");
  serve.add_flag("--insecure", options.insecure, "Without TLS; only on this machine");
  serve
      .add_option("--health", options.health,
                  "Where /health and /metrics (Prometheus) are answered, without TLS (default: nowhere)")
      ->type_name("HOST:PORT");
  serve
      .add_option("--origin", options.origins,
                  "A web page that browsers may connect from, such as https://example.org; may be repeated")
      ->type_name("URL");
  serve
      .add_option("--links-an-address", options.links_an_address,
                  "Connections that one network address may have (default 200)")
      ->type_name("N")
      ->check(number_range(1.0, 100'000.0));
  serve.add_flag("--json", options.json, "Say as JSON where it listens (fields below)");
  serve.callback([&options] { options.task = "serve"; });
}

void add_invite(CLI::App& app, ServingOptions& options) {
  CLI::App& invite = *app.add_subcommand("invite", kInviteSummary);
  invite.footer(kInviteNotes);
  invite.add_option("DESIGN", options.design, "The name of the design")->required()->type_name("");
  invite.add_option("--role", options.role, "What its owner may do (default edit)")
      ->type_name("view|edit|own")
      ->check(CLI::IsMember({"view", "edit", "own"}));
  invite.add_option("--for", options.lasts, "How long the link lasts (default 8h)")->type_name("TIME");
  invite
      .add_option("--server", options.server,
                  "Where people reach the server (default: where the store is served)")
      ->type_name("HOST:PORT");
  add_store_folder(invite, options);
  invite.callback([&options] { options.task = "invite"; });

  CLI::App& revoke = *app.add_subcommand("revoke", kRevokeSummary);
  revoke.add_option("LINK", options.link, "The link, or the id of its invitation from the audit log")
      ->required()
      ->type_name("");
  add_store_folder(revoke, options);
  revoke.callback([&options] { options.task = "revoke"; });
}

/// A command of `icome store`.
CLI::App& add_store_task(CLI::App& store, ServingOptions& options, const std::string& task,
                         const std::string& summary) {
  CLI::App& command = *store.add_subcommand(task, summary);
  add_store_folder(command, options);
  command.callback([&options, task] { options.task = "store " + task; });
  return command;
}

void add_store(CLI::App& app, ServingOptions& options) {
  CLI::App& store = *app.add_subcommand("store", kStoreSummary);
  store.footer(kStoreNotes);
  store.require_subcommand(1);
  CLI::App& list = add_store_task(store, options, "list", "List the designs");
  list.add_flag("--json", options.json, "As JSON: store, designs (name, sequence, snapshot_sequence, bytes)");
  CLI::App& check = add_store_task(store, options, "check", "Find what is damaged");
  check.add_flag("--json", options.json, "As JSON: store, findings (sentences)");
  CLI::App& backup =
      add_store_task(store, options, "backup", "Copy the store into one file, also while it is served");
  backup.add_option("FILE", options.file, "The file to write")->required()->type_name("");
  backup.add_flag("--force", options.force, "Replace the file if it is there");
  CLI::App& restore = add_store_task(store, options, "restore", "Put a backup in the place of the store");
  restore.add_option("FILE", options.file, "The backup")->required()->type_name("");
  CLI::App& out = add_store_task(store, options, "export", "Write a design as a file");
  out.add_option("DESIGN", options.design, "The name of the design")->required()->type_name("");
  out.add_option("FILE", options.file, "The file to write, of any format that icome convert writes")
      ->required()
      ->type_name("");
}

}  // namespace

void add_serving_commands(CLI::App& app, ServingOptions& options) {
  add_serve(app, options);
  add_invite(app, options);
  add_store(app, options);
}

int run_serving(const ServingOptions& options) {
  if (options.task == "serve") return run_serve_designs(options);
  if (options.task == "invite") return run_invite(options);
  if (options.task == "revoke") return run_revoke(options);
  return run_store(options);
}

}  // namespace icome::apps
