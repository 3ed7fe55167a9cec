#pragma once

namespace icome::apps {

// The words of the --help of what is shared that do not stand beside an option.

constexpr const char* kServeSummary = "Serve designs to several people, who shape them together";
constexpr const char* kServeNotes =
    "Examples:\n"
    "  icome serve                                 a store and a certificate are made; prints a link to "
    "paste\n"
    "  icome serve --listen 0.0.0.0:4263           for other computers, too\n"
    "  icome serve --store /srv/designs --health 127.0.0.1:9100 --json\n"
    "\n"
    "Then, in another terminal:\n"
    "  icome invite table --role own               makes the design \"table\", prints a link to it\n"
    "  icome info 'icome://127.0.0.1:4263/table#token=...'\n"
    "                                              a link stands wherever a file does, in quotes\n"
    "\n"
    "The certificate is the server's own: links carry its fingerprint, so it is safe without an authority.\n"
    "What was acknowledged is on the disk. Ctrl-C or SIGTERM ends it in good order; a folder is served by "
    "one\n"
    "server at a time.\n"
    "\n"
    "Any number of servers, with one certificate, before one database; a design is one's at a time, and\n"
    "taken over where that dies:\n"
    "  icome serve --store postgresql://db/icome --bus nats://bus:4222 --certificate c.pem --key k.pem\n"
    "\n"
    "JSON, one line as soon as it listens: listening (HOST:PORT), fingerprint, store (and health).";

constexpr const char* kInviteSummary = "Print a link that lets somebody work on a design";
constexpr const char* kInviteNotes =
    "Examples:\n"
    "  icome invite table --role edit --for 8h     a link for the working day\n"
    "  icome invite table --role own               makes the design if there is none\n"
    "\n"
    "view: look and touch. edit: also change. own: also take things away from others who hold them.\n"
    "Whoever has the link gets in until it expires or icome revoke ends it. --for takes 90s, 30m, 8h or 7d.";

constexpr const char* kRevokeSummary = "End a link, also for who is connected by it";

constexpr const char* kStoreSummary = "Look after a store: list, check, backup, restore, export";
constexpr const char* kStoreNotes =
    "Examples:\n"
    "  icome store list\n"
    "  icome store check                           exit code 1 when something is wrong\n"
    "  icome store backup designs.backup           also while it is served\n"
    "  icome store restore designs.backup          while it is not\n"
    "  icome store export table table.wrl          a design as a file of any format that convert writes";

constexpr const char* kAddressHelp = "The link of a design on a server (icome invite prints it), in quotes";

}  // namespace icome::apps
