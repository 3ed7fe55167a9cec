// icome-server: the commands of icome that serve designs, in a program that needs no display and no device.
#include <CLI/CLI.hpp>
#include <exception>

#include "apps/serving/serving_command.h"
#include "apps/terminal.h"
#include "base/version.h"

int main(int argc, char** argv) {
  constexpr int kBadUsage = 2;
  CLI::App app("Serves designs to several people, who shape them together with icome.", "icome-server");
  app.set_version_flag("--version", std::string("icome-server ") + icome::base::kVersion);
  app.require_subcommand(1);
  icome::apps::ServingOptions options;
  icome::apps::add_serving_commands(app, options);
  try {
    app.parse(argc, argv);
    return icome::apps::run_serving(options);
  } catch (const CLI::Success& success) {  // help or version
    return app.exit(success);
  } catch (const CLI::ParseError& error) {
    icome::apps::tell(std::string(error.what()) + "\nSee icome-server --help.");
    return kBadUsage;
  } catch (const std::exception& error) {
    icome::apps::tell(error.what());
  }
  return icome::apps::kFailed;
}
